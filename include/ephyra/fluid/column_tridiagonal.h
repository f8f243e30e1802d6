#pragma once

#include "ephyra/fluid/aligned_vector.h"

#include <vector>

namespace ephyra::fluid
{
  /// One tridiagonal matrix along y for many right-hand sides, each contiguous:
  ///   lower_j x_(j-1) + diagonal_j x_j + upper_j x_(j+1) = f_j,
  /// cyclic on request. Eight rows are solved at a time, interleaved in a
  /// buffer, so that the recurrence along y is vectorised across them.
  class ColumnTridiagonal
  {
  public:
    static constexpr int block = 8;

    ColumnTridiagonal(std::vector<double> lower,
                      std::vector<double> diagonal,
                      std::vector<double> upper,
                      bool                cyclic);

    int
    size() const
    {
      return static_cast<int>(inverse.size());
    }
    /// Solves in place for @p n_rows <= block rows.
    void
    solve(double *const *rows, int n_rows);

  private:
    std::vector<double> lower, inverse, upper;
    // Cyclic: A = A' + u v^T, Sherman-Morrison.
    bool                cyclic;
    std::vector<double> response;   ///< A'^-1 u / (1 + v . A'^-1 u)
    double              weight = 0; ///< v = (1, 0, ..., 0, weight)
    AlignedVector       buffer;
  };
} // namespace ephyra::fluid
