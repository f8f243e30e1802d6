#include "ephyra/splines/nurbs_patch.h"

#include "ephyra/base/exceptions.h"
#include "test_patches.h"

#include <boost/test/unit_test.hpp>

using namespace ephyra;
using namespace ephyra::splines;
using namespace ephyra::tests;

namespace
{
  double
  difference(const NurbsPatch<1> &a, const NurbsPatch<1> &b)
  {
    double worst = 0;
    for (int k = 0; k <= 200; ++k)
      {
        const Point x = a.point({{k / 200.}}), y = b.point({{k / 200.}});
        worst = std::max({worst, std::abs(x.r - y.r), std::abs(x.y - y.y)});
      }
    return worst;
  }

  double
  difference(const NurbsPatch<2> &a, const NurbsPatch<2> &b)
  {
    double worst = 0;
    for (int k = 0; k <= 40; ++k)
      for (int l = 0; l <= 40; ++l)
        {
          const Point x = a.point({{k / 40., l / 40.}}),
                      y = b.point({{k / 40., l / 40.}});
          worst = std::max({worst, std::abs(x.r - y.r), std::abs(x.y - y.y)});
        }
    return worst;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(nurbs_patch)

BOOST_AUTO_TEST_CASE(circle_is_exact)
{
  const NurbsPatch<1> arc = quarter_circle();
  for (int k = 0; k <= 100; ++k)
    {
      const Point x = arc.point({{k / 100.}});
      BOOST_TEST(std::abs(std::hypot(x.r, x.y) - 1) < 1e-15);
    }
}

BOOST_AUTO_TEST_CASE(basis_is_a_partition_of_unity)
{
  const NurbsPatch<2> patch = annulus();
  BasisValues<2>      basis;
  for (int k = 0; k <= 10; ++k)
    for (int l = 0; l <= 10; ++l)
      {
        patch.evaluate_basis({{k / 10., l / 10.}}, basis, true);
        double sum[6] = {0, 0, 0, 0, 0, 0};
        for (std::size_t a = 0; a < basis.index.size(); ++a)
          {
            sum[0] += basis.value[a];
            sum[1] += basis.derivative[0][a];
            sum[2] += basis.derivative[1][a];
            for (int s = 0; s < 3; ++s)
              sum[3 + s] += basis.second[s][a];
          }
        BOOST_TEST(std::abs(sum[0] - 1) < 1e-15);
        for (int s = 1; s < 6; ++s)
          BOOST_TEST(std::abs(sum[s]) < 1e-12);
      }
}

BOOST_AUTO_TEST_CASE(derivatives_by_finite_differences)
{
  const NurbsPatch<2> patch = annulus().with_elevated_degree(0, 1);
  const double        h     = 1e-5;
  BasisValues<2>      b, lower, upper;
  for (const double x : {0.2, 0.71})
    for (const double y : {0.13, 0.58})
      for (int k = 0; k < 2; ++k)
        {
          patch.evaluate_basis({{x, y}}, b, true);
          std::array<double, 2> below{{x, y}}, above{{x, y}};
          below[k] -= h;
          above[k] += h;
          patch.evaluate_basis(below, lower, true);
          patch.evaluate_basis(above, upper, true);
          for (std::size_t a = 0; a < b.index.size(); ++a)
            {
              const auto slope = [&](const double u, const double l) {
                return (u - l) / (2 * h);
              };
              BOOST_TEST(std::abs(slope(upper.value[a], lower.value[a]) -
                                  b.derivative[k][a]) < 1e-8);
              BOOST_TEST(
                std::abs(slope(upper.derivative[k][a], lower.derivative[k][a]) -
                         b.second[k][a]) < 1e-7);
              BOOST_TEST(std::abs(slope(upper.derivative[1 - k][a],
                                        lower.derivative[1 - k][a]) -
                                  b.second[2][a]) < 1e-7);
            }
        }
}

BOOST_AUTO_TEST_CASE(univariate_second_derivatives)
{
  const NurbsPatch<1> curve = wavy_curve();
  const double        h     = 1e-5;
  BasisValues<1>      b, lower, upper;
  for (const double x : {0.1, 0.4, 0.7})
    {
      curve.evaluate_basis({{x}}, b, true);
      curve.evaluate_basis({{x - h}}, lower);
      curve.evaluate_basis({{x + h}}, upper);
      for (int a = 0; a < 4; ++a)
        {
          BOOST_TEST(std::abs((upper.value[a] - lower.value[a]) / (2 * h) -
                              b.derivative[0][a]) < 1e-7);
          BOOST_TEST(
            std::abs((upper.derivative[0][a] - lower.derivative[0][a]) /
                       (2 * h) -
                     b.second[0][a]) < 1e-6);
        }
    }
}

BOOST_AUTO_TEST_CASE(refinement_keeps_curves)
{
  for (const NurbsPatch<1> &curve : {quarter_circle(), wavy_curve()})
    {
      const double inserted =
        difference(curve, curve.with_inserted_knots(0, {0.9, 0.1, 0.1}));
      BOOST_TEST(inserted < 3e-15);
      const double split = difference(curve, curve.with_split_elements(0, 34));
      BOOST_TEST(split < 3e-15);
      for (int times = 1; times <= 4; ++times)
        {
          const NurbsPatch<1> raised = curve.with_elevated_degree(0, times);
          BOOST_TEST(raised.degree(0) == curve.degree(0) + times);
          BOOST_TEST(raised.n_elements() == curve.n_elements());
          const double elevated = difference(curve, raised);
          BOOST_TEST(elevated < 1e-14);
          const double both =
            difference(curve, raised.with_split_elements(0, 7));
          BOOST_TEST(both < 1e-14);
        }
    }
}

BOOST_AUTO_TEST_CASE(elevation_of_many_elements)
{
  const NurbsPatch<1> fine =
    quarter_circle().with_inserted_knots(0, {0.001, 0.01, 0.02, 0.5, 0.97});
  BOOST_TEST(difference(fine, fine.with_elevated_degree(0, 2)) < 1e-14);
}

BOOST_AUTO_TEST_CASE(refinement_keeps_surfaces)
{
  const NurbsPatch<2> patch = annulus();
  for (int d = 0; d < 2; ++d)
    {
      const NurbsPatch<2> fine =
        patch.with_elevated_degree(d, 2).with_split_elements(d, 9);
      BOOST_TEST(fine.degree(d) == 4);
      BOOST_TEST(fine.degree(1 - d) == 2);
      BOOST_TEST(difference(patch, fine) < 1e-14);
    }
}

BOOST_AUTO_TEST_CASE(sides_are_those_of_the_patch)
{
  const NurbsPatch<2> patch = annulus();
  const auto          inner = patch.side(Side::theta2_0),
             top            = patch.side(Side::theta1_1);
  for (int k = 0; k <= 10; ++k)
    {
      const double x = k / 10.;
      const Point  a = inner.point({{x}}), b = patch.point({{x, 0.}});
      BOOST_TEST(std::hypot(a.r - b.r, a.y - b.y) < 1e-15);
      const Point c = top.point({{x}}), d = patch.point({{1., x}});
      BOOST_TEST(std::hypot(c.r - d.r, c.y - d.y) < 1e-15);
    }
  const std::vector<int> outer{3, 7, 11}, start{0, 1, 2, 3};
  BOOST_TEST(patch.side_control_points(Side::theta2_1) == outer);
  BOOST_TEST(patch.side_control_points(Side::theta1_0) == start);
}

BOOST_AUTO_TEST_CASE(bad_patches_are_refused)
{
  const KnotVector line(1, {0, 0, 1, 1});
  BOOST_CHECK_THROW(NurbsPatch<1>({line}, {{0, 0}}, {1}), InputError);
  BOOST_CHECK_THROW(NurbsPatch<1>({line}, {{0, 0}, {1, 0}}, {1, 0}),
                    InputError);
  BOOST_CHECK_THROW(NurbsPatch<1>({line}, {{0, 0}, {1, std::nan("")}}, {1, 1}),
                    InputError);
  BOOST_CHECK_THROW(NurbsPatch<2>({line}, {{0, 0}, {1, 0}}, {1, 1}),
                    InputError);
  BOOST_CHECK_THROW(quarter_circle().with_inserted_knots(0, {1.}), InputError);
  BOOST_CHECK_THROW(quarter_circle().with_inserted_knots(0, {.5, .5, .5}),
                    InputError);
}

BOOST_AUTO_TEST_SUITE_END()
