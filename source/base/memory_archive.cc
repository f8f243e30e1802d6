#include "ephyra/base/memory_archive.h"

#include <cstring>
#include <stdexcept>

namespace ephyra
{
  MemoryArchive::MemoryArchive(const bool for_repeated_step)
    : for_repeated_step(for_repeated_step)
  {
  }

  void
  MemoryArchive::begin_writing()
  {
    buffer.clear();
    position   = 0;
    is_reading = false;
  }

  void
  MemoryArchive::begin_reading()
  {
    if (buffer.empty())
      throw std::logic_error("MemoryArchive: nothing was saved before.");
    position   = 0;
    is_reading = true;
  }

  bool
  MemoryArchive::empty() const
  {
    return buffer.empty();
  }

  bool
  MemoryArchive::reading() const
  {
    return is_reading;
  }

  bool
  MemoryArchive::repeats_step() const
  {
    return for_repeated_step;
  }

  void
  MemoryArchive::value(const std::string & /*name*/, double &x)
  {
    transfer(&x, sizeof(x));
  }

  void
  MemoryArchive::value(const std::string & /*name*/, std::int64_t &x)
  {
    transfer(&x, sizeof(x));
  }

  void
  MemoryArchive::values(const std::string &name, std::vector<double> &x)
  {
    std::int64_t size = static_cast<std::int64_t>(x.size());
    value(name, size);
    x.resize(size);
    transfer(x.data(), x.size() * sizeof(double));
  }

  void
  MemoryArchive::rows(const std::string &name,
                      double            *data,
                      const RowLayout   &layout)
  {
    const std::int64_t here = layout.n_rows * layout.n_columns;
    std::int64_t       size = here;
    value(name, size);
    if (size != here)
      throw std::logic_error("MemoryArchive: the field " + name +
                             " has changed its size since it was saved.");
    for (std::int64_t row = 0; row < layout.n_rows; ++row)
      transfer(data + row * layout.row_stride,
               layout.n_columns * sizeof(double));
  }

  void
  MemoryArchive::enter(const std::string & /*group*/)
  {
  }

  void
  MemoryArchive::leave()
  {
  }

  void
  MemoryArchive::transfer(void *data, const std::size_t n_bytes)
  {
    if (n_bytes == 0)
      return;
    if (is_reading)
      {
        if (n_bytes > buffer.size() - position)
          throw std::logic_error("MemoryArchive: more is read than was saved.");
        std::memcpy(data, buffer.data() + position, n_bytes);
        position += n_bytes;
      }
    else
      {
        const auto *bytes = static_cast<const unsigned char *>(data);
        buffer.insert(buffer.end(), bytes, bytes + n_bytes);
      }
  }
} // namespace ephyra
