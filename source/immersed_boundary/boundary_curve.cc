#include "ephyra/immersed_boundary/boundary_curve.h"

#include "ephyra/base/exceptions.h"

#include <cmath>
#include <numeric>

namespace ephyra::immersed_boundary
{
  using splines::NurbsPatch;
  using splines::Point;
  using splines::Side;

  BoundaryCurve
  side_curve(const NurbsPatch<2> &patch,
             const Side           side,
             const std::string   &name,
             const int            first_control_point)
  {
    const bool along_theta2 = side == Side::theta1_0 || side == Side::theta1_1;
    const bool at_end       = side == Side::theta1_1 || side == Side::theta2_1;
    const double end        = at_end ? 1. : 0.;
    const auto   g =
      patch.tangents(along_theta2 ? std::array<double, 2>{end, 0.5}
                                  : std::array<double, 2>{0.5, end});
    const Point  tangent = g[along_theta2 ? 1 : 0];
    const Point  across  = g[along_theta2 ? 0 : 1];
    const double to_the_right =
      (tangent.y * across.r - tangent.r * across.y) * (at_end ? 1. : -1.);
    std::vector<int> index = patch.side_control_points(side);
    for (int &i : index)
      i += first_control_point;
    return {patch.side(side), index, to_the_right > 0 ? 1 : -1, name};
  }

  Outline
  patch_outline(const NurbsPatch<2>     &patch,
                const std::vector<Side> &sides,
                const std::string       &name)
  {
    Outline outline{{}, patch.control_points()};
    for (const Side side : sides)
      outline.curves.push_back(side_curve(patch, side, name));
    return outline;
  }

  Outline
  body_outline(const geometry::BodyPatch &body, const std::string &name)
  {
    std::vector<Side> sides;
    for (const geometry::WetSide &wet : body.wet_sides)
      sides.push_back(wet.side);
    return patch_outline(body.patch, sides, name);
  }

  Outline
  curve_outline(const geometry::BodyCurve &curve, const std::string &name)
  {
    std::vector<int> index(curve.curve.n_control_points());
    std::iota(index.begin(), index.end(), 0);
    return {{{curve.curve, index, curve.reversed ? -1 : 1, name}},
            curve.curve.control_points()};
  }

  std::vector<double>
  control_vector(const Outline &outline, const double shift)
  {
    std::vector<double> x;
    x.reserve(2 * outline.control_points.size());
    for (const Point &p : outline.control_points)
      x.insert(x.end(), {p.r, p.y + shift});
    return x;
  }

  Enclosed
  enclosed(const std::vector<BoundaryCurve> &curves,
           const std::vector<double>        &x)
  {
    // Ten Gauss points on [0, 1] in each of four parts of a knot span.
    constexpr int           n_parts   = 4;
    constexpr double        gauss[5]  = {0.1488743389816312,
                                         0.4333953941292472,
                                         0.6794095682990244,
                                         0.8650633666889845,
                                         0.9739065285171717};
    constexpr double        weight[5] = {0.2955242247147529,
                                         0.2692667193099963,
                                         0.2190863625159821,
                                         0.1494513491505806,
                                         0.0666713443086881};
    double                  volume = 0, moment = 0;
    splines::BasisValues<1> basis;
    for (const BoundaryCurve &c : curves)
      {
        const std::vector<double> &breaks = c.curve.knot_vector(0).breaks();
        for (std::size_t e = 0; e + 1 < breaks.size(); ++e)
          for (int part = 0; part < n_parts; ++part)
            for (int q = 0; q < 10; ++q)
              {
                const double half = 0.5 * (breaks[e + 1] - breaks[e]) / n_parts;
                const double middle = breaks[e] + (2 * part + 1) * half;
                const double side   = q < 5 ? -1. : 1.;
                c.curve.evaluate_basis({middle + side * half * gauss[q % 5]},
                                       basis);
                double r = 0, y = 0, dy = 0;
                for (std::size_t a = 0; a < basis.index.size(); ++a)
                  {
                    const int i = c.control_points[basis.index[a]];
                    r += basis.value[a] * x[2 * i];
                    y += basis.value[a] * x[2 * i + 1];
                    dy += basis.derivative[0][a] * x[2 * i + 1];
                  }
                const double dv =
                  c.orientation * M_PI * r * r * dy * half * weight[q % 5];
                volume += dv;
                moment += dv * y;
              }
      }
    EphyraThrowIf(!(volume > 0),
                  InputError,
                  "The surface of body '"
                    << (curves.empty() ? "" : curves.front().name)
                    << "' holds the volume " << volume
                    << " m^3: give all of its wetted sides, without overlap.");
    return {volume, moment / volume};
  }
} // namespace ephyra::immersed_boundary
