#include "ephyra/geometry/conic.h"

#include "ephyra/base/exceptions.h"

#include <cmath>

namespace ephyra::geometry
{
  using splines::KnotVector;
  using splines::NurbsPatch;
  using splines::Point;

  NurbsPatch<1>
  ellipse_arc(const Point &center,
              const double a,
              const double b,
              const double from,
              const double to,
              const int    n_segments)
  {
    const double half   = (to - from) / n_segments / 2.;
    const double middle = std::cos(half);
    EphyraThrowIf(!(middle > 0.5),
                  InputError,
                  "A conic segment of " << 2. * half
                                        << " rad was asked for; use more "
                                           "segments.");
    std::vector<Point>  points;
    std::vector<double> weights, knots{0., 0., 0.};
    const auto          add = [&](const double phi, const double weight) {
      points.push_back({center.r + a * std::sin(phi) / weight,
                        center.y + b * std::cos(phi) / weight});
      weights.push_back(weight);
    };
    add(from, 1.);
    for (int s = 0; s < n_segments; ++s)
      {
        // Tangents of a circle meet at distance 1 / cos(half) of its centre.
        add(from + (2 * s + 1) * half, middle);
        add(from + (2 * s + 2) * half, 1.);
        const double knot = s + 1 == n_segments ? 1. : (s + 1.) / n_segments;
        knots.insert(knots.end(), 2, knot);
      }
    knots.push_back(1.);
    return NurbsPatch<1>(
      {KnotVector(2, std::move(knots))}, std::move(points), std::move(weights));
  }

  NurbsPatch<1>
  line(const Point &from, const Point &to)
  {
    return NurbsPatch<1>({KnotVector::uniform(1, 1)}, {from, to}, {1., 1.});
  }

  NurbsPatch<2>
  ruled_patch(const NurbsPatch<1> &from, const NurbsPatch<1> &to)
  {
    EphyraThrowIf(from.knot_vector(0).knots() != to.knot_vector(0).knots(),
                  InputError,
                  "Two curves with different knots cannot bound a ruled "
                  "patch.");
    std::vector<Point>  points;
    std::vector<double> weights;
    for (int i = 0; i < from.n_control_points(); ++i)
      for (const NurbsPatch<1> *curve : {&from, &to})
        {
          points.push_back(curve->control_points()[i]);
          weights.push_back(curve->weights()[i]);
        }
    return NurbsPatch<2>({from.knot_vector(0), KnotVector::uniform(1, 1)},
                         std::move(points),
                         std::move(weights));
  }
} // namespace ephyra::geometry
