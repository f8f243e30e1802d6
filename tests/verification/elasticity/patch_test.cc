// Patch tests: states of constant strain that axisymmetry permits, u_r = a r,
// u_y = b y + c, on distorted, non-orthogonal elements, some of them at the axis.
#include "elasticity_patches.h"
#include "field_errors.h"

#include "ephyra/elasticity/statics.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <sstream>

using namespace ephyra;
using namespace ephyra::elasticity;
using splines::Side;

namespace
{
  const double a = 0.15, b = -0.2;

  Expression
  formula(const double factor, const std::string &text = "1")
  {
    std::ostringstream out;
    out.precision(17);
    out << factor << "*(" << text << ")";
    return Expression(out.str(), SideCondition::variables);
  }

  /// Four by three bilinear elements of different shapes between the straight
  /// sides of a quadrilateral, the side theta1 = 0 on the axis or not.
  splines::NurbsPatch<2>
  distorted(const int degree, const bool at_axis)
  {
    const double                inside = at_axis ? 0. : 0.3;
    std::vector<splines::Point> points;
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; j <= 3; ++j)
        {
          // Uneven along the sides, and moved at random inside.
          const bool   free = i > 0 && i < 4 && j > 0 && j < 3;
          const double s    = i / 4. +
                           (i > 0 && i < 4 ? 0.06 * std::sin(5. * i + j) : 0.),
                       t = j / 3. +
                           (j > 0 && j < 3 ? 0.08 * std::cos(3. * j + i) : 0.);
          const double turn = free ? 0.06 * std::sin(7. * i + 4. * j) : 0.;
          points.push_back({inside + s * (0.9 - inside + 0.2 * t) + turn,
                            -0.1 + 0.3 * s + t * (1. - 0.25 * s) - turn});
          if (i == 0)
            points.back().r = inside;
        }
    const std::vector<double> weights(points.size(), 1.);
    splines::NurbsPatch<2>    patch(
      {splines::KnotVector::uniform(1, 4), splines::KnotVector::uniform(1, 3)},
      points,
      weights);
    for (int d = 0; d < 2; ++d)
      if (degree > 1)
        patch = patch.with_elevated_degree(d, degree - 1);
    return patch;
  }

  /// A rational patch with curved elements inside of straight sides.
  splines::NurbsPatch<2>
  curved(const int degree)
  {
    auto patch = test::refined(
      {{splines::KnotVector::uniform(1, 1), splines::KnotVector::uniform(1, 1)},
       {{0., -0.1}, {0., 0.9}, {0.9, 0.2}, {1.1, 0.95}},
       {1., 0.9, 1.2, 1.1}},
      degree,
      {4, 3});
    auto      moved = patch.control_points();
    const int n2 = patch.n_basis(1), n1 = patch.n_basis(0);
    for (int i = 1; i + 1 < n1; ++i)
      for (int j = 1; j + 1 < n2; ++j)
        {
          moved[i * n2 + j].r += 0.02 * std::sin(7. * i + 4. * j);
          moved[i * n2 + j].y += 0.02 * std::cos(3. * i + 5. * j);
        }
    return {
      {patch.knot_vector(0), patch.knot_vector(1)}, moved, patch.weights()};
  }

  /// Largest error of the displacement over its largest value, and that of J:
  /// two sides move as the exact state does, the others carry its tractions.
  double
  largest_error(const splines::NurbsPatch<2> &patch,
                const bool                    small_strain,
                const int                     extra_points)
  {
    StaticsSolver::Parameters prm;
    prm.body.material     = {400., 5000., small_strain};
    prm.body.extra_points = extra_points;
    prm.newton.tolerance  = 1e-13;
    const AxisymmetricTensor F{1. + a, 0., 0., 1. + b, 1. + a};
    const auto               P = evaluate(prm.body.material, F).stress;
    for (const Side side : {Side::theta2_0, Side::theta1_0})
      {
        auto &condition        = prm.body.sides[static_cast<int>(side)];
        condition.fixed        = {{true, true}};
        condition.displacement = {{formula(a, "r"), formula(b, "y")}};
      }
    for (const Side side : {Side::theta1_1, Side::theta2_1})
      {
        // Outward normal of a straight side.
        const auto   ends = patch.side(side);
        const auto   p0 = ends.point({{0.}}), p1 = ends.point({{1.}});
        const double length    = std::hypot(p1.r - p0.r, p1.y - p0.y);
        const double sign      = side == Side::theta1_1 ? 1. : -1.;
        auto        &condition = prm.body.sides[static_cast<int>(side)];
        condition.traction = {{formula(sign * P[0] * (p1.y - p0.y) / length),
                               formula(-sign * P[3] * (p1.r - p0.r) / length)}};
      }
    StaticsSolver solver(prm, patch, MPI_COMM_WORLD);
    const auto    result = solver.run();
    BOOST_TEST(result.success, result.reason);
    double error = 0., largest = 0.;
    for (std::size_t i = 0; i < patch.control_points().size(); ++i)
      {
        const splines::Point &x = patch.control_points()[i];
        error =
          std::max({error,
                    std::abs(solver.displacement()[2 * i] - a * x.r),
                    std::abs(solver.displacement()[2 * i + 1] - b * x.y)});
        largest = std::max({largest, std::abs(a * x.r), std::abs(b * x.y)});
      }
    return error / largest;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(patch_test)

BOOST_AUTO_TEST_CASE(distorted_elements)
{
  for (const bool small_strain : {false, true})
    for (const bool at_axis : {true, false})
      for (int degree = 1; degree <= 4; ++degree)
        {
          const double error =
            largest_error(distorted(degree, at_axis), small_strain, 0);
          BOOST_TEST_MESSAGE(
            (small_strain ? "small" : "finite")
            << " strain, " << (at_axis ? "at the axis" : "off the axis")
            << ", degree " << degree << ": relative error of the displacement "
            << error);
          BOOST_TEST(error < 1e-11);
        }
}

BOOST_AUTO_TEST_CASE(curved_rational_elements)
{
  // Gauss' rule is not exact for a curved or rational map: what it misses is
  // the only error, and is gone with two more points.
  for (int degree = 2; degree <= 4; ++degree)
    {
      const double error   = largest_error(curved(degree), false, 0);
      const double refined = largest_error(curved(degree), false, 2);
      BOOST_TEST_MESSAGE("curved, degree " << degree << ": relative error "
                                           << error << " with " << degree + 1
                                           << " Gauss points, " << refined
                                           << " with two more");
      BOOST_TEST(error < 1e-5);
      BOOST_TEST(refined < 1e-11);
    }
}

BOOST_AUTO_TEST_SUITE_END()
