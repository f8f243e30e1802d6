#include "ephyra/splines/nested_patch.h"

#include "ephyra/base/exceptions.h"
#include "test_patches.h"

#include <boost/test/unit_test.hpp>

using namespace ephyra;
using namespace ephyra::splines;
using namespace ephyra::tests;

BOOST_AUTO_TEST_SUITE(nested_patch)

BOOST_AUTO_TEST_CASE(geometry_and_parametrisation_are_those_of_the_side)
{
  const NurbsPatch<2> parent =
    annulus().with_elevated_degree(0, 1).with_split_elements(0, 5);
  for (const int degree : {3, 4})
    {
      const NestedPatch nested(parent, Side::theta2_0, 34, degree);
      BOOST_TEST(nested.patch().n_elements() == 5 * 34);
      BOOST_TEST(nested.patch().degree(0) == degree);
      double worst = 0;
      for (int k = 0; k <= 1000; ++k)
        {
          const Point a = nested.patch().point({{k / 1000.}}),
                      b = parent.point({{k / 1000., 0.}});
          worst         = std::max(worst, std::hypot(a.r - b.r, a.y - b.y));
        }
      BOOST_TEST(worst < 1e-14);
    }
  BOOST_CHECK_THROW(NestedPatch(parent, Side::theta2_0, 34, 2), InputError);
}

BOOST_AUTO_TEST_CASE(displacement_at_the_nested_points)
{
  const NurbsPatch<2> parent =
    annulus().with_elevated_degree(0, 1).with_split_elements(0, 3);
  const NestedPatch        nested(parent, Side::theta2_1, 4, 3);
  const PatchQuadrature<1> points(nested.patch(), {{4}});
  const EvaluationMatrix   transfer = nested.parent_field(points);
  BOOST_TEST(transfer.n_points() == 12 * 4);
  BOOST_TEST(transfer.n_control_points() == parent.n_control_points());

  std::vector<double> u, at, slope;
  for (int i = 0; i < 2 * parent.n_control_points(); ++i)
    u.push_back(std::sin(3. * i));
  transfer.apply(u, at, 2);
  transfer.apply_derivative(0, u, slope, 2);
  BasisValues<2> basis;
  for (int e = 0; e < points.n_elements(); ++e)
    for (int q = 0; q < points.n_points(); ++q)
      {
        parent.evaluate_basis({{points.theta(e, q)[0], 1.}}, basis);
        for (int c = 0; c < 2; ++c)
          {
            double value = 0, derivative = 0;
            for (std::size_t a = 0; a < basis.index.size(); ++a)
              {
                value += basis.value[a] * u[2 * basis.index[a] + c];
                derivative +=
                  basis.derivative[0][a] * u[2 * basis.index[a] + c];
              }
            const int row = 2 * points.point_index(e, q) + c;
            BOOST_TEST(std::abs(at[row] - value) < 1e-14);
            BOOST_TEST(std::abs(slope[row] - derivative) < 1e-12);
          }
      }
}

BOOST_AUTO_TEST_CASE(activation_at_the_parent_points)
{
  const NurbsPatch<2> parent = annulus().with_split_elements(0, 3);
  const NestedPatch   nested(parent, Side::theta2_0, 5, 2);
  // Coefficients whose function is known: the radius along the side.
  std::vector<double> radius;
  for (const Point &x : nested.patch().control_points())
    radius.push_back(x.r);
  const PatchQuadrature<2> points(parent, {{3, 3}});
  const EvaluationMatrix   transfer = nested.nested_field(points);
  std::vector<double>      values;
  transfer.apply(radius, values, 1);
  BOOST_REQUIRE(static_cast<int>(values.size()) ==
                points.n_elements() * points.n_points());
  for (int e = 0; e < points.n_elements(); ++e)
    for (int q = 0; q < points.n_points(); ++q)
      BOOST_TEST(std::abs(values[points.point_index(e, q)] -
                          parent.point({{points.theta(e, q)[0], 0.}}).r) <
                 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()
