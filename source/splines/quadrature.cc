#include "ephyra/splines/quadrature.h"

#include "ephyra/base/exceptions.h"

#include <cmath>

namespace ephyra::splines
{
  Quadrature
  gauss_legendre(const int n)
  {
    EphyraThrowIf(n < 1,
                  InputError,
                  "A Gauss rule needs at least one point, not " << n << ".");
    Quadrature rule;
    rule.points.resize(n);
    rule.weights.resize(n);
    const long double pi = std::acos(-1.0L);
    for (int i = 0; i < n; ++i)
      {
        // Newton on the Legendre polynomial, by its three-term recurrence.
        long double x     = std::cos(pi * (i + 0.75L) / (n + 0.5L));
        long double slope = 0;
        for (int iteration = 0; iteration < 100; ++iteration)
          {
            long double previous = 1, value = x;
            for (int k = 2; k <= n; ++k)
              {
                const long double next =
                  ((2 * k - 1) * x * value - (k - 1) * previous) / k;
                previous = value;
                value    = next;
              }
            slope                  = n * (x * value - previous) / (x * x - 1);
            const long double step = value / slope;
            x -= step;
            if (std::abs(step) < 1e-18L)
              break;
          }
        rule.points[n - 1 - i] = static_cast<double>((1 + x) / 2);
        rule.weights[n - 1 - i] =
          static_cast<double>(1 / ((1 - x * x) * slope * slope));
      }
    return rule;
  }
} // namespace ephyra::splines
