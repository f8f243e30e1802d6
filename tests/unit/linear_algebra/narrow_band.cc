#include "ephyra/linear_algebra/narrow_band.h"

#include "ephyra/base/exceptions.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra::linear_algebra;

namespace
{
  /// A diagonally dominant, unsymmetric matrix.
  NarrowBandMatrix
  example(const int n, const int width)
  {
    NarrowBandMatrix matrix(n, width);
    for (int i = 0; i < n; ++i)
      for (int j = std::max(0, i - width); j <= std::min(n - 1, i + width); ++j)
        matrix(i, j) = i == j ? 3. * width + 1. : std::sin(1. + 3. * i + j);
    return matrix;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(narrow_band)

BOOST_AUTO_TEST_CASE(solve_inverts_multiply_for_every_width)
{
  for (int width = 0; width <= 6; ++width)
    for (const int n : {1, 2, width + 1, 50})
      {
        if (n <= width && n > 2)
          continue;
        const int              b      = std::min(width, n - 1);
        const NarrowBandMatrix matrix = example(n, b);
        std::vector<double>    exact(n), x(n);
        for (int i = 0; i < n; ++i)
          exact[i] = std::cos(0.7 * i);
        matrix.multiply(exact.data(), x.data());
        NarrowBandSolver solver;
        solver.factorize(matrix, "test matrix");
        solver.solve(x.data());
        for (int i = 0; i < n; ++i)
          BOOST_TEST(std::abs(x[i] - exact[i]) < 1e-13);
      }
}

BOOST_AUTO_TEST_CASE(multiply_agrees_with_the_definition)
{
  const int              n = 7, width = 2;
  const NarrowBandMatrix matrix = example(n, width);
  std::vector<double>    x(n), y(n, 1.);
  for (int i = 0; i < n; ++i)
    x[i] = 1. + i * i;
  matrix.add_multiply(x.data(), y.data(), -2.);
  for (int i = 0; i < n; ++i)
    {
      double sum = 1;
      for (int j = 0; j < n; ++j)
        if (std::abs(i - j) <= width)
          sum -= 2. * matrix(i, j) * x[j];
      BOOST_TEST(y[i] == sum, boost::test_tools::tolerance(1e-12));
    }
}

BOOST_AUTO_TEST_CASE(a_singular_matrix_is_named)
{
  NarrowBandMatrix matrix = example(5, 1);
  for (int j = 1; j <= 3; ++j)
    matrix(2, j) = 0;
  NarrowBandSolver solver;
  BOOST_CHECK_EXCEPTION(
    solver.factorize(matrix, "mass matrix"),
    ephyra::DivergedError,
    [](const ephyra::DivergedError &error) {
      return std::string(error.what()).find("mass matrix") != std::string::npos;
    });
}

BOOST_AUTO_TEST_SUITE_END()
