#pragma once

#include <string>
#include <vector>

namespace ephyra::linear_algebra
{
  /// A square matrix with few diagonals on both sides of the main one, as
  /// splines on a line give. Stored by diagonals, so that products stream.
  class NarrowBandMatrix
  {
  public:
    NarrowBandMatrix(int n_rows = 0, int half_bandwidth = 0);

    int
    n_rows() const
    {
      return n;
    }
    int
    half_bandwidth() const
    {
      return width;
    }
    double &
    operator()(const int row, const int column)
    {
      return diagonals[static_cast<std::size_t>(column - row + width) * n +
                       row];
    }
    double
    operator()(const int row, const int column) const
    {
      return diagonals[static_cast<std::size_t>(column - row + width) * n +
                       row];
    }
    void
    set_zero();

    /// y = factor A x; x and y must not overlap.
    void
    multiply(const double *x, double *y, double factor = 1.) const;
    /// y += factor A x.
    void
    add_multiply(const double *x, double *y, double factor = 1.) const;

  private:
    int                 n;
    int                 width;
    std::vector<double> diagonals;
  };

  /// LU factors of a NarrowBandMatrix *without pivoting*: for symmetric
  /// positive definite and totally positive matrices (spline mass, stiffness
  /// and collocation matrices), where that is stable. A solve costs about
  /// 2 ns a row for up to four diagonals on each side.
  class NarrowBandSolver
  {
  public:
    /// Throws DivergedError, naming @p what the matrix is, on a pivot that is
    /// zero or not finite.
    void
    factorize(const NarrowBandMatrix &matrix, const std::string &what);
    /// Overwrites the right-hand side with the solution.
    void
    solve(double *x) const;

  private:
    template <int fixed_width>
    void
    solve_fixed(double *x) const;

    int n     = 0;
    int width = 0;
    /// Row i of L: multipliers of x[i-width] ... x[i-1].
    std::vector<double> lower;
    /// Row i of U over its pivot: multipliers of x[i+1] ... x[i+width].
    std::vector<double> upper;
    std::vector<double> inverse_pivot;
  };
} // namespace ephyra::linear_algebra
