#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace ephyra::fluid
{
  /// Memory that starts on a cache line, so that rows of a multiple of eight
  /// doubles are aligned for vector instructions.
  template <typename T>
  struct AlignedAllocator
  {
    using value_type                       = T;
    static constexpr std::size_t alignment = 64;

    AlignedAllocator() = default;
    template <typename U>
    AlignedAllocator(const AlignedAllocator<U> &)
    {
    }

    T *
    allocate(const std::size_t n)
    {
      return static_cast<T *>(
        ::operator new(n * sizeof(T), std::align_val_t(alignment)));
    }
    void
    deallocate(T *const p, std::size_t)
    {
      ::operator delete(p, std::align_val_t(alignment));
    }
    template <typename U>
    bool
    operator==(const AlignedAllocator<U> &) const
    {
      return true;
    }
    template <typename U>
    bool
    operator!=(const AlignedAllocator<U> &) const
    {
      return false;
    }
  };

  using AlignedVector = std::vector<double, AlignedAllocator<double>>;
} // namespace ephyra::fluid
