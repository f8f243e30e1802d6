#include "ephyra/linear_algebra/narrow_band.h"

#include "ephyra/base/exceptions.h"

#include <algorithm>
#include <cmath>

namespace ephyra::linear_algebra
{
  NarrowBandMatrix::NarrowBandMatrix(const int n_rows, const int half_bandwidth)
    : n(n_rows)
    , width(half_bandwidth)
    , diagonals(static_cast<std::size_t>(2 * half_bandwidth + 1) * n_rows, 0.)
  {
  }

  void
  NarrowBandMatrix::set_zero()
  {
    std::fill(diagonals.begin(), diagonals.end(), 0.);
  }

  void
  NarrowBandMatrix::multiply(const double *x,
                             double       *y,
                             const double  factor) const
  {
    std::fill(y, y + n, 0.);
    add_multiply(x, y, factor);
  }

  namespace
  {
    /// Rows [first, last) of y += factor A x, all of whose diagonals exist, in
    /// one pass.
    template <int width>
    void
    add_inner_rows(const double *__restrict__ diagonals,
                   const int n,
                   const int first,
                   const int last,
                   const double *__restrict__ x,
                   double *__restrict__ y,
                   const double factor)
    {
      for (int i = first; i < last; ++i)
        {
          double sum = 0;
          for (int k = 0; k <= 2 * width; ++k)
            sum +=
              diagonals[static_cast<std::size_t>(k) * n + i] * x[i + k - width];
          y[i] += factor * sum;
        }
    }
  } // namespace

  void
  NarrowBandMatrix::add_multiply(const double *x,
                                 double       *y,
                                 const double  factor) const
  {
    const int  first = std::min(n, width), last = std::max(first, n - width);
    const bool fixed = width >= 1 && width <= 4;
    const auto row   = [&](const int i) {
      double sum = 0;
      for (int j = std::max(0, i - width); j <= std::min(n - 1, i + width); ++j)
        sum += (*this)(i, j) * x[j];
      y[i] += factor * sum;
    };
    for (int i = 0; i < (fixed ? first : n); ++i)
      row(i);
    if (!fixed)
      return;
    const auto inner = width == 1   ? add_inner_rows<1>
                       : width == 2 ? add_inner_rows<2>
                       : width == 3 ? add_inner_rows<3>
                                    : add_inner_rows<4>;
    inner(diagonals.data(), n, first, last, x, y, factor);
    for (int i = last; i < n; ++i)
      row(i);
  }

  void
  NarrowBandSolver::factorize(const NarrowBandMatrix &matrix,
                              const std::string      &what)
  {
    n                    = matrix.n_rows();
    width                = matrix.half_bandwidth();
    const int row_length = 2 * width + 1;
    // Rows with column j of row i at i * row_length + j - i + width.
    std::vector<double> rows(static_cast<std::size_t>(n) * row_length, 0.);
    const auto          at = [&](const int i, const int j) -> double          &{
      return rows[static_cast<std::size_t>(i) * row_length + j - i + width];
    };
    for (int i = 0; i < n; ++i)
      for (int j = std::max(0, i - width); j <= std::min(n - 1, i + width); ++j)
        at(i, j) = matrix(i, j);

    lower.assign(static_cast<std::size_t>(n) * width, 0.);
    upper.assign(static_cast<std::size_t>(n) * width, 0.);
    inverse_pivot.assign(n, 0.);
    for (int i = 0; i < n; ++i)
      {
        const double pivot = at(i, i);
        EphyraThrowIf(pivot == 0. || !std::isfinite(pivot),
                      DivergedError,
                      "The "
                        << what << " cannot be factorised: its pivot in row "
                        << i << " of " << n << " is " << pivot
                        << "; check geometry, coefficients and time step.");
        inverse_pivot[i] = 1. / pivot;
        const int last   = std::min(n - 1, i + width);
        for (int r = i + 1; r <= last; ++r)
          {
            const double factor = at(r, i) * inverse_pivot[i];
            lower[static_cast<std::size_t>(r) * width + i - r + width] = factor;
            for (int j = i + 1; j <= last; ++j)
              at(r, j) -= factor * at(i, j);
          }
        for (int j = i + 1; j <= last; ++j)
          upper[static_cast<std::size_t>(i) * width + j - i - 1] =
            at(i, j) * inverse_pivot[i];
      }
  }

  template <int fixed_width>
  void
  NarrowBandSolver::solve_fixed(double *x) const
  {
    // A negative template argument stands for a width known at run time.
    const int b    = fixed_width >= 0 ? fixed_width : width;
    const int head = std::min(b, n);
    for (int i = 0; i < head; ++i)
      for (int k = std::max(0, b - i); k < b; ++k)
        x[i] -= lower[static_cast<std::size_t>(i) * b + k] * x[i - b + k];
    const double *l = &lower[static_cast<std::size_t>(head) * b];
    for (int i = head; i < n; ++i, l += b)
      {
        // The newest value last: it alone is on the critical path.
        double sum = x[i];
        for (int k = 0; k < b; ++k)
          sum -= l[k] * x[i - b + k];
        x[i] = sum;
      }
    for (int i = 0; i < n; ++i)
      x[i] *= inverse_pivot[i];
    for (int i = n - 1; i >= std::max(0, n - b); --i)
      for (int k = 0; i + 1 + k < n; ++k)
        x[i] -= upper[static_cast<std::size_t>(i) * b + k] * x[i + 1 + k];
    for (int i = n - b - 1; i >= 0; --i)
      {
        const double *u   = &upper[static_cast<std::size_t>(i) * b];
        double        sum = x[i];
        for (int k = b - 1; k >= 0; --k)
          sum -= u[k] * x[i + 1 + k];
        x[i] = sum;
      }
  }

  void
  NarrowBandSolver::solve(double *x) const
  {
    switch (width)
      {
      case 0:
        for (int i = 0; i < n; ++i)
          x[i] *= inverse_pivot[i];
        return;
      case 1:
        return solve_fixed<1>(x);
      case 2:
        return solve_fixed<2>(x);
      case 3:
        return solve_fixed<3>(x);
      case 4:
        return solve_fixed<4>(x);
      default:
        return solve_fixed<-1>(x);
      }
  }
} // namespace ephyra::linear_algebra
