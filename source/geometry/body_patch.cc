#include "ephyra/geometry/body_patch.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/splines/patch_quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ephyra::geometry
{
  namespace
  {
    bool
    contains(const std::vector<Side> &sides, const Side s)
    {
      return std::find(sides.begin(), sides.end(), s) != sides.end();
    }

    /// Largest extent of the control net, a length to compare with.
    double
    size_of(const NurbsPatch<2> &patch)
    {
      double r = 0., low = patch.control_points()[0].y, high = low;
      for (const Point &x : patch.control_points())
        {
          r    = std::max(r, std::abs(x.r));
          low  = std::min(low, x.y);
          high = std::max(high, x.y);
        }
      return std::max(r, high - low);
    }

    std::vector<Side>
    find_axis_sides(const NurbsPatch<2> &patch, const double tolerance)
    {
      std::vector<Side> result;
      for (const Side s :
           {Side::theta1_0, Side::theta1_1, Side::theta2_0, Side::theta2_1})
        {
          bool on_axis = true;
          for (const int c : patch.side_control_points(s))
            on_axis =
              on_axis && std::abs(patch.control_points()[c].r) <= tolerance;
          if (on_axis)
            result.push_back(s);
        }
      return result;
    }

    void
    check_map(const std::string &shape, const NurbsPatch<2> &patch)
    {
      const splines::PatchQuadrature<2> quadrature(
        patch, {{patch.degree(0) + 1, patch.degree(1) + 1}});
      for (int e = 0; e < quadrature.n_elements(); ++e)
        for (int q = 0; q < quadrature.n_points(); ++q)
          {
            const auto  &theta = quadrature.theta(e, q);
            const Point  x     = patch.point(theta);
            const auto   g     = patch.tangents(theta);
            const double j     = g[0].r * g[1].y - g[0].y * g[1].r;
            EphyraThrowIf(x.r <= 0.,
                          InputError,
                          "The shape '"
                            << shape << "' reaches the radius " << x.r
                            << " m at theta = (" << theta[0] << ", " << theta[1]
                            << "); radii inside a body are positive.");
            EphyraThrowIf(
              j <= 0.,
              InputError,
              "The shape '"
                << shape
                << "' is folded or wound the wrong way: its Jacobian is " << j
                << " m^2 at theta = (" << theta[0] << ", " << theta[1]
                << "); theta2 must point to the left of theta1, check the "
                   "dimensions.");
          }
    }
  } // namespace

  Point
  outward_normal(const Point &tangent, const bool reversed)
  {
    const double scale =
      (reversed ? -1. : 1.) / std::hypot(tangent.r, tangent.y);
    return {tangent.y * scale, -tangent.r * scale};
  }

  BodyPatch
  make_body(const std::string       &shape,
            NurbsPatch<2>            patch,
            const std::vector<Side> &dry)
  {
    const std::vector<Side> axis_sides =
      find_axis_sides(patch, 1e-12 * size_of(patch));
    if (!axis_sides.empty())
      {
        std::vector<Point> points = patch.control_points();
        for (const Side s : axis_sides)
          for (const int c : patch.side_control_points(s))
            points[c].r = 0.;
        patch = NurbsPatch<2>({patch.knot_vector(0), patch.knot_vector(1)},
                              std::move(points),
                              patch.weights());
      }
    check_map(shape, patch);

    // Anticlockwise round the patch.
    const std::array<WetSide, 4> walk{{{Side::theta2_0, false},
                                       {Side::theta1_1, false},
                                       {Side::theta2_1, true},
                                       {Side::theta1_0, true}}};
    const auto                   is_wet = [&](const WetSide &s) {
      return !contains(axis_sides, s.side) && !contains(dry, s.side);
    };
    int start = 0;
    for (int k = 0; k < 4; ++k)
      if (!is_wet(walk[(k + 3) % 4]) && is_wet(walk[k]))
        {
          start = k;
          break;
        }
    std::vector<WetSide> wet_sides;
    for (int k = 0; k < 4; ++k)
      if (is_wet(walk[(start + k) % 4]))
        wet_sides.push_back(walk[(start + k) % 4]);
    return {shape, std::move(patch), axis_sides, std::move(wet_sides)};
  }
} // namespace ephyra::geometry
