#include "ephyra/splines/knot_vector.h"

#include "ephyra/base/exceptions.h"

#include <algorithm>
#include <array>

namespace ephyra::splines
{
  KnotVector::KnotVector(const int degree, std::vector<double> knots)
    : p(degree)
    , all_knots(std::move(knots))
  {
    EphyraThrowIf(p < 1 || p > max_degree,
                  InputError,
                  "A knot vector of degree "
                    << p << " was asked for; use a degree from 1 to "
                    << max_degree << ".");
    const int n = static_cast<int>(all_knots.size());
    EphyraThrowIf(n < 2 * (p + 1),
                  InputError,
                  "A knot vector of degree " << p << " needs at least "
                                             << 2 * (p + 1) << " knots, not "
                                             << n << ".");
    for (int i = 1; i < n; ++i)
      EphyraThrowIf(!(all_knots[i] >= all_knots[i - 1]),
                    InputError,
                    "Knots must not decrease, but knot "
                      << i << " is " << all_knots[i] << " after "
                      << all_knots[i - 1] << ".");
    EphyraThrowIf(all_knots[0] != 0. || all_knots[p] != 0. ||
                    all_knots[n - 1] != 1. || all_knots[n - p - 1] != 1.,
                  InputError,
                  "A knot vector of degree " << p << " must start with "
                                             << p + 1 << " zeros and end with "
                                             << p + 1 << " ones.");

    for (int i = p; i < n - p; ++i)
      if (distinct.empty() || all_knots[i] > distinct.back())
        {
          distinct.push_back(all_knots[i]);
          if (i > p)
            {
              EphyraThrowIf(all_knots[i] < 1. &&
                              all_knots[i + p] == all_knots[i],
                            InputError,
                            "The interior knot "
                              << all_knots[i] << " occurs more than " << p
                              << " times: the basis would be discontinuous.");
            }
        }
    // The span of element e ends where the next distinct knot begins.
    for (int i = p; i < n - p - 1; ++i)
      if (all_knots[i] < all_knots[i + 1])
        first_of_element.push_back(i - p);
  }

  KnotVector
  KnotVector::uniform(const int degree, const int n_elements)
  {
    EphyraThrowIf(n_elements < 1,
                  InputError,
                  "A knot vector needs at least one element, not " << n_elements
                                                                   << ".");
    std::vector<double> knots(degree + 1, 0.);
    for (int e = 1; e < n_elements; ++e)
      knots.push_back(static_cast<double>(e) / n_elements);
    knots.insert(knots.end(), degree + 1, 1.);
    return KnotVector(degree, std::move(knots));
  }

  int
  KnotVector::element_of(const double x) const
  {
    EphyraThrowIf(!(x >= 0. && x <= 1.),
                  InputError,
                  "A spline was evaluated at the parameter "
                    << x << "; parameters run from 0 to 1.");
    const auto next = std::upper_bound(distinct.begin(), distinct.end(), x);
    return std::min(static_cast<int>(next - distinct.begin()),
                    static_cast<int>(distinct.size()) - 1) -
           1;
  }

  int
  KnotVector::evaluate(const double x,
                       const int    n_derivatives,
                       double      *values) const
  {
    const int first = first_of_element[element_of(x)];
    const int span  = first + p;
    using Row       = std::array<double, max_degree + 1>;
    // Table of A2.3: basis functions of all degrees above the diagonal, knot
    // differences below it.
    std::array<Row, max_degree + 1> ndu;
    Row                             left, right;
    ndu[0][0] = 1.;
    for (int j = 1; j <= p; ++j)
      {
        left[j]      = x - all_knots[span + 1 - j];
        right[j]     = all_knots[span + j] - x;
        double saved = 0.;
        for (int r = 0; r < j; ++r)
          {
            ndu[j][r]          = right[r + 1] + left[j - r];
            const double ratio = ndu[r][j - 1] / ndu[j][r];
            ndu[r][j]          = saved + right[r + 1] * ratio;
            saved              = left[j - r] * ratio;
          }
        ndu[j][j] = saved;
      }
    for (int a = 0; a <= p; ++a)
      values[a] = ndu[a][p];

    const int n = std::min(n_derivatives, p);
    for (int a = 0; a <= p; ++a)
      {
        std::array<Row, 2> coefficient;
        int                now = 0, next = 1;
        coefficient[0][0] = 1.;
        for (int k = 1; k <= n; ++k)
          {
            double    d  = 0.;
            const int rk = a - k, pk = p - k;
            if (a >= k)
              {
                coefficient[next][0] = coefficient[now][0] / ndu[pk + 1][rk];
                d                    = coefficient[next][0] * ndu[rk][pk];
              }
            const int j1 = rk >= -1 ? 1 : -rk;
            const int j2 = a - 1 <= pk ? k - 1 : p - a;
            for (int j = j1; j <= j2; ++j)
              {
                coefficient[next][j] =
                  (coefficient[now][j] - coefficient[now][j - 1]) /
                  ndu[pk + 1][rk + j];
                d += coefficient[next][j] * ndu[rk + j][pk];
              }
            if (a <= pk)
              {
                coefficient[next][k] =
                  -coefficient[now][k - 1] / ndu[pk + 1][a];
                d += coefficient[next][k] * ndu[a][pk];
              }
            values[k * (p + 1) + a] = d;
            std::swap(now, next);
          }
      }
    double factor = p;
    for (int k = 1; k <= n; ++k)
      {
        for (int a = 0; a <= p; ++a)
          values[k * (p + 1) + a] *= factor;
        factor *= p - k;
      }
    for (int k = n + 1; k <= n_derivatives; ++k)
      std::fill_n(values + k * (p + 1), p + 1, 0.);
    return first;
  }

  std::vector<double>
  KnotVector::greville() const
  {
    std::vector<double> result(n_basis());
    for (int i = 0; i < n_basis(); ++i)
      {
        double sum = 0.;
        for (int j = 1; j <= p; ++j)
          sum += all_knots[i + j];
        result[i] = std::min(sum / p, 1.);
      }
    return result;
  }
} // namespace ephyra::splines
