#include "ephyra/fluid/column_tridiagonal.h"

#include "ephyra/base/exceptions.h"

#include <cstddef>

namespace ephyra::fluid
{
  ColumnTridiagonal::ColumnTridiagonal(std::vector<double> lower_,
                                       std::vector<double> diagonal,
                                       std::vector<double> upper_,
                                       const bool          cyclic)
    : lower(std::move(lower_))
    , inverse(diagonal.size())
    , upper(std::move(upper_))
    , cyclic(cyclic)
    , buffer(diagonal.size() * block)
  {
    const std::size_t n = diagonal.size();
    EphyraAssert(n > 2, "a line along y needs more than two unknowns");
    // Corner entries beta = lower_0 (to the last) and alpha = upper_(n-1) (to
    // the first): u = (gamma, 0, ..., alpha), v = (1, 0, ..., beta / gamma).
    const double gamma = -diagonal[0], alpha = upper[n - 1];
    if (cyclic)
      {
        weight = lower[0] / gamma;
        diagonal[0] -= gamma;
        diagonal[n - 1] -= alpha * weight;
      }
    inverse[0] = 1. / diagonal[0];
    for (std::size_t j = 1; j < n; ++j)
      inverse[j] =
        1. / (diagonal[j] - lower[j] * upper[j - 1] * inverse[j - 1]);
    if (!cyclic)
      return;

    std::vector<double> u(n, 0.);
    u[0]                = gamma;
    u[n - 1]            = alpha;
    double *const row[] = {u.data()};
    solve(row, 1); // response is still empty
    const double scale = 1. / (1. + u[0] + weight * u[n - 1]);
    for (double &x : u)
      x *= scale;
    response = std::move(u);
  }

  void
  ColumnTridiagonal::solve(double *const *rows, const int n_rows)
  {
    const int     n = size();
    double *const x = buffer.data();
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n_rows; ++k)
        x[j * block + k] = rows[k][j];

    for (int k = 0; k < block; ++k)
      x[k] *= inverse[0];
    for (int j = 1; j < n; ++j)
      for (int k = 0; k < block; ++k)
        x[j * block + k] =
          (x[j * block + k] - lower[j] * x[(j - 1) * block + k]) * inverse[j];
    for (int j = n - 2; j >= 0; --j)
      {
        const double factor = upper[j] * inverse[j];
        for (int k = 0; k < block; ++k)
          x[j * block + k] -= factor * x[(j + 1) * block + k];
      }
    if (!response.empty())
      {
        double sum[block];
        for (int k = 0; k < block; ++k)
          sum[k] = x[k] + weight * x[(n - 1) * block + k];
        for (int j = 0; j < n; ++j)
          for (int k = 0; k < block; ++k)
            x[j * block + k] -= response[j] * sum[k];
      }

    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n_rows; ++k)
        rows[k][j] = x[j * block + k];
  }
} // namespace ephyra::fluid
