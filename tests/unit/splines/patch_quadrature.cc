#include "ephyra/splines/patch_quadrature.h"

#include "test_patches.h"

#include <boost/test/unit_test.hpp>

using namespace ephyra::splines;
using namespace ephyra::tests;

BOOST_AUTO_TEST_SUITE(patch_quadrature)

BOOST_AUTO_TEST_CASE(area_of_a_quarter_annulus)
{
  const NurbsPatch<2>      patch = annulus().with_split_elements(0, 3);
  const PatchQuadrature<2> table(patch, {{8, 9}});
  BOOST_TEST(table.n_elements() == 6);
  BOOST_TEST(table.n_points() == 72);
  BOOST_TEST(table.n_local() == 9);
  double area = 0, parametric = 0;
  for (int e = 0; e < table.n_elements(); ++e)
    for (int q = 0; q < table.n_points(); ++q)
      {
        Point g1, g2;
        for (int a = 0; a < table.n_local(); ++a)
          {
            const Point &x = patch.control_points()[table.control_points(e)[a]];
            g1.r += table.derivatives(e, q, 0)[a] * x.r;
            g1.y += table.derivatives(e, q, 0)[a] * x.y;
            g2.r += table.derivatives(e, q, 1)[a] * x.r;
            g2.y += table.derivatives(e, q, 1)[a] * x.y;
          }
        area += table.weight(e, q) * std::abs(g1.r * g2.y - g1.y * g2.r);
        parametric += table.weight(e, q);
      }
  BOOST_TEST(std::abs(parametric - 1) < 1e-14);
  BOOST_TEST(std::abs(area - 0.75 * std::acos(-1.)) < 1e-8);
}

BOOST_AUTO_TEST_CASE(tables_agree_with_direct_evaluation)
{
  const NurbsPatch<2>      patch = annulus().with_split_elements(1, 2);
  const PatchQuadrature<2> table(patch, {{2, 3}});
  BasisValues<2>           basis;
  for (int e = 0; e < table.n_elements(); ++e)
    for (int q = 0; q < table.n_points(); ++q)
      {
        patch.evaluate_basis(table.theta(e, q), basis);
        for (int a = 0; a < table.n_local(); ++a)
          {
            BOOST_TEST(table.control_points(e)[a] == basis.index[a]);
            BOOST_TEST(table.values(e, q)[a] == basis.value[a]);
            for (int k = 0; k < 2; ++k)
              BOOST_TEST(table.derivatives(e, q, k)[a] ==
                         basis.derivative[k][a]);
          }
      }
}

BOOST_AUTO_TEST_CASE(length_of_a_quarter_circle)
{
  const NurbsPatch<1>      arc = quarter_circle().with_split_elements(0, 4);
  const PatchQuadrature<1> table(arc, {{8}});
  double                   length = 0;
  for (int e = 0; e < table.n_elements(); ++e)
    for (int q = 0; q < table.n_points(); ++q)
      {
        const Point g = arc.tangents(table.theta(e, q))[0];
        length += table.weight(e, q) * std::hypot(g.r, g.y);
      }
  BOOST_TEST(std::abs(length - std::acos(-1.) / 2) < 1e-13);
}

BOOST_AUTO_TEST_SUITE_END()
