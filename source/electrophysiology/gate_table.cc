#include "ephyra/electrophysiology/gate_table.h"

#include "ephyra/electrophysiology/vector_math.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>

namespace ephyra::electrophysiology
{
  GateTable::GateTable(const Rates  rates,
                       const void  *model,
                       const double v_min,
                       const double v_max,
                       const double interval)
    : v_first(v_min)
    , per_interval(1. / interval)
    , n_rows(static_cast<int>(std::ceil((v_max - v_min) / interval)))
    , rows(static_cast<std::size_t>(n_rows) * row_length)
  {
    using Values = std::array<double, n_functions>;
    Values     value, slope, next_value, next_slope;
    const auto evaluate = [&](const double v, Values &f, Values &df) {
      // Fourth-order differences; 1/100 of an interval is far from round-off.
      const double h = 0.01 * interval;
      Values       around[4];
      const double at[4] = {v - 2 * h, v - h, v + h, v + 2 * h};
      for (int k = 0; k < 4; ++k)
        rates(model, at[k], &around[k][0], &around[k][n_lanes]);
      rates(model, v, &f[0], &f[n_lanes]);
      for (int j = 0; j < n_functions; ++j)
        df[j] =
          (around[0][j] - 8 * around[1][j] + 8 * around[2][j] - around[3][j]) /
          (12 * h) * interval;
    };
    evaluate(v_first, next_value, next_slope);
    for (int i = 0; i < n_rows; ++i)
      {
        value = next_value;
        slope = next_slope;
        evaluate(v_first + (i + 1) * interval, next_value, next_slope);
        double *row = &rows[static_cast<std::size_t>(i) * row_length];
        for (int j = 0; j < n_functions; ++j)
          {
            const double jump        = next_value[j] - value[j];
            row[j]                   = value[j];
            row[n_functions + j]     = slope[j];
            row[2 * n_functions + j] = 3 * jump - 2 * slope[j] - next_slope[j];
            row[3 * n_functions + j] = slope[j] + next_slope[j] - 2 * jump;
          }
      }
  }

  bool
  GateTable::contains(const int n, const double *v, const double scale) const
  {
    double low = n_rows > 0 ? v[0] : 0., high = low;
    bool   finite = true;
    for (int i = 0; i < n; ++i)
      {
        low  = std::min(low, v[i]);
        high = std::max(high, v[i]);
        finite &= v[i] == v[i];
      }
    return n_rows > 0 && finite && (scale * low - v_first) >= 0 &&
           (scale * high - v_first) * per_interval < n_rows - 1e-6;
  }

  void
  GateTable::coefficients(const int     n,
                          const double *v,
                          const double  scale,
                          const double  dt,
                          const bool    exact,
                          double *__restrict__ keep,
                          double *__restrict__ add) const
  {
    using Lanes = Eigen::Array<double, n_lanes, 1>;
    for (int i = 0; i < n; ++i)
      {
        const double  x     = (scale * v[i] - v_first) * per_interval;
        const int     r     = static_cast<int>(x);
        const double  s     = x - r;
        const double *row   = &rows[static_cast<std::size_t>(r) * row_length];
        const auto    cubic = [&](const int first) -> Lanes {
          const auto c = [&](const int k) {
            return Eigen::Map<const Lanes>(row + k * n_functions + first);
          };
          return c(0) + s * (c(1) + s * (c(2) + s * c(3)));
        };
        const Lanes steady = cubic(0);
        const Lanes z      = dt * cubic(n_lanes);
        Lanes       growth;
        if (exact)
          for (int j = 0; j < n_lanes; ++j)
            growth[j] = 1. - vector_math::exp(-z[j]);
        else
          growth =
            z *
            (1. - z * ((1. / 2.) * (1. - z * ((1. / 3.) * (1. - z * 0.25)))));
        Eigen::Map<Lanes>(keep + i * n_lanes) = 1. - growth;
        Eigen::Map<Lanes>(add + i * n_lanes)  = growth * steady;
      }
  }
} // namespace ephyra::electrophysiology
