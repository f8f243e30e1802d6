#include "ephyra/immersed_boundary/boundary_curve.h"

#include "ephyra/base/exceptions.h"

#include <cmath>
#include <numeric>

namespace ephyra::immersed_boundary
{
  using splines::KnotVector;
  using splines::NurbsPatch;
  using splines::Point;
  using splines::Side;

  namespace
  {
    /// A chain of quadratic rational segments, each given by its middle
    /// control point (with weight) and its end.
    class Chain
    {
    public:
      explicit Chain(const Point start)
        : points{start}
        , weights{1.}
      {
      }

      void
      line_to(const Point end)
      {
        const Point a = points.back();
        add({0.5 * (a.r + end.r), 0.5 * (a.y + end.y)}, 1., end);
      }

      /// Quarter of an ellipse with the tangents meeting at the corner.
      void
      quarter_to(const Point corner, const Point end)
      {
        add(corner, std::sqrt(0.5), end);
      }

      Outline
      outline(const std::string &name) const
      {
        const int           n_segments = static_cast<int>(points.size()) / 2;
        std::vector<double> knots(3, 0.);
        for (int s = 1; s < n_segments; ++s)
          knots.insert(knots.end(), 2, static_cast<double>(s) / n_segments);
        knots.insert(knots.end(), 3, 1.);
        std::vector<int> index(points.size());
        std::iota(index.begin(), index.end(), 0);
        return {{{NurbsPatch<1>({KnotVector(2, knots)}, points, weights),
                  index,
                  1,
                  name}},
                points};
      }

    private:
      void
      add(const Point middle, const double weight, const Point end)
      {
        points.insert(points.end(), {middle, end});
        weights.insert(weights.end(), {weight, 1.});
      }

      std::vector<Point>  points;
      std::vector<double> weights;
    };
  } // namespace

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
  spheroid_outline(const double       radius,
                   const double       half_length,
                   const std::string &name)
  {
    EphyraThrowIf(!(radius > 0) || !(half_length > 0),
                  InputError,
                  "Body '" << name << "' has the radius " << radius
                           << " m and the half length " << half_length
                           << " m; both must be positive.");
    Chain chain({0., -half_length});
    chain.quarter_to({radius, -half_length}, {radius, 0.});
    chain.quarter_to({radius, half_length}, {0., half_length});
    return chain.outline(name);
  }

  Outline
  torus_outline(const double       centre_line_radius,
                const double       core_radius,
                const std::string &name)
  {
    const double R = centre_line_radius, a = core_radius;
    EphyraThrowIf(!(a > 0) || !(R > a),
                  InputError,
                  "Torus '" << name << "' has the core radius " << a
                            << " m and the centre line radius " << R
                            << " m; the core radius must be positive and "
                               "smaller than the centre line radius.");
    Chain chain({R + a, 0.});
    chain.quarter_to({R + a, a}, {R, a});
    chain.quarter_to({R - a, a}, {R - a, 0.});
    chain.quarter_to({R - a, -a}, {R, -a});
    chain.quarter_to({R + a, -a}, {R + a, 0.});
    return chain.outline(name);
  }

  Outline
  disk_outline(const double       radius,
               const double       thickness,
               const std::string &name)
  {
    const double h = 0.5 * thickness, inner = radius - h;
    EphyraThrowIf(!(h > 0) || !(inner > 0),
                  InputError,
                  "Disk '" << name << "' has the radius " << radius
                           << " m and the thickness " << thickness
                           << " m; the thickness must be positive and smaller "
                              "than twice the radius.");
    Chain chain({0., -h});
    chain.line_to({inner, -h});
    chain.quarter_to({radius, -h}, {radius, 0.});
    chain.quarter_to({radius, h}, {inner, h});
    chain.line_to({0., h});
    return chain.outline(name);
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
