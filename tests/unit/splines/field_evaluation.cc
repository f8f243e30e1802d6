#include "ephyra/splines/field_evaluation.h"

#include "ephyra/base/exceptions.h"
#include "test_patches.h"

#include <boost/test/unit_test.hpp>

using namespace ephyra;
using namespace ephyra::splines;
using namespace ephyra::tests;

namespace
{
  std::vector<double>
  coordinates(const NurbsPatch<2> &patch)
  {
    std::vector<double> x;
    for (const Point &point : patch.control_points())
      x.insert(x.end(), {point.r, point.y});
    return x;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(field_evaluation)

BOOST_AUTO_TEST_CASE(coordinates_are_reproduced)
{
  const NurbsPatch<2> patch = annulus().with_split_elements(0, 3);
  const std::vector<std::array<double, 2>> points{
    {{0., 0.}}, {{0.3, 0.7}}, {{1., 0.4}}, {{0.99, 1.}}};
  const EvaluationMatrix matrix(patch, points);
  std::vector<double>    x, g;
  matrix.apply(coordinates(patch), x, 2);
  BOOST_TEST(matrix.n_points() == 4);
  BOOST_TEST(matrix.n_directions() == 2);
  for (std::size_t p = 0; p < points.size(); ++p)
    {
      const Point expected = patch.point(points[p]);
      BOOST_TEST(std::abs(x[2 * p] - expected.r) < 1e-15);
      BOOST_TEST(std::abs(x[2 * p + 1] - expected.y) < 1e-15);
    }
  for (int k = 0; k < 2; ++k)
    {
      matrix.apply_derivative(k, coordinates(patch), g, 2);
      for (std::size_t p = 0; p < points.size(); ++p)
        {
          const Point expected = patch.tangents(points[p])[k];
          BOOST_TEST(std::abs(g[2 * p] - expected.r) < 1e-14);
          BOOST_TEST(std::abs(g[2 * p + 1] - expected.y) < 1e-14);
        }
    }
}

BOOST_AUTO_TEST_CASE(sides_joined_to_a_chain)
{
  const NurbsPatch<2> patch = annulus();
  EvaluationMatrix    chain;
  chain.append(EvaluationMatrix::on_side(patch, Side::theta2_0, {0.1, 0.5}));
  chain.append(EvaluationMatrix::on_side(patch, Side::theta1_1, {0.3}));
  BOOST_TEST(chain.n_points() == 3);
  BOOST_TEST(chain.n_control_points() == 12);
  std::vector<double> x;
  chain.apply(coordinates(patch), x, 2);
  const Point a = patch.point({{0.5, 0.}}), b = patch.point({{1., 0.3}});
  BOOST_TEST(std::hypot(x[2] - a.r, x[3] - a.y) < 1e-15);
  BOOST_TEST(std::hypot(x[4] - b.r, x[5] - b.y) < 1e-15);
  BOOST_CHECK_THROW(chain.append(EvaluationMatrix(patch, {{{0.1, 0.2}}})),
                    InputError);
}

BOOST_AUTO_TEST_CASE(transposed_is_the_adjoint)
{
  const NurbsPatch<2>                patch = annulus();
  std::vector<std::array<double, 2>> points;
  for (int p = 0; p < 7; ++p)
    points.push_back({{p / 6., std::fmod(0.3 * p, 1.)}});
  const EvaluationMatrix    matrix(patch, points);
  const std::vector<double> x = coordinates(patch);
  std::vector<double>       ax, load(14), aty(x.size(), 0.);
  for (int i = 0; i < 14; ++i)
    load[i] = std::sin(i + 1.);
  matrix.apply(x, ax, 2);
  matrix.apply_transposed_add(load, aty, 2);
  matrix.apply_transposed_add(load, aty, 2); // adds
  double left = 0, right = 0, total = 0, resultant = 0;
  for (int i = 0; i < 14; ++i)
    left += ax[i] * load[i];
  for (std::size_t i = 0; i < x.size(); ++i)
    right += x[i] * aty[i];
  for (int i = 0; i < 14; i += 2)
    total += load[i];
  for (std::size_t i = 0; i < x.size(); i += 2)
    resultant += aty[i];
  BOOST_TEST(std::abs(2 * left - right) < 1e-13);
  BOOST_TEST(std::abs(2 * total - resultant) < 1e-13);
}

BOOST_AUTO_TEST_SUITE_END()
