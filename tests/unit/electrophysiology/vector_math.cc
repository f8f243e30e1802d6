#include "ephyra/electrophysiology/vector_math.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

namespace vector_math = ephyra::electrophysiology::vector_math;

BOOST_AUTO_TEST_SUITE(vector_math_functions)

BOOST_AUTO_TEST_CASE(exponential_agrees_with_the_standard_library)
{
  double worst = 0;
  for (int i = -690000; i <= 690000; i += 7)
    {
      const double x = 1e-3 * i;
      worst = std::max(worst, std::abs(vector_math::exp(x) / std::exp(x) - 1.));
    }
  BOOST_TEST(worst < 5e-16);
  BOOST_TEST(vector_math::exp(0.) == 1.);
  BOOST_TEST(vector_math::exp(-1e5) < 1e-300);
  BOOST_TEST(
    std::isnan(vector_math::exp(std::numeric_limits<double>::quiet_NaN())));
}

BOOST_AUTO_TEST_CASE(products_of_powers_are_exact_to_2e_11)
{
  double worst = 0;
  for (int i = 0; i < 4000; ++i)
    {
      const double a     = std::exp(-20. + 0.005 * i),
                   b     = std::exp(-3e-3 * (i % 997));
      const double exact = std::pow(a, 8.64) * std::pow(b, 2.51);
      worst              = std::max(
        worst,
        std::abs(vector_math::power_product(a, 8.64, b, 2.51) / exact - 1.));
    }
  BOOST_TEST(worst < 2e-11);
  BOOST_TEST(vector_math::power_product(1., 1.77, 1., 4.82) == 1.);
  BOOST_TEST(vector_math::power_product(0., 8.64, 1., 1.) < 1e-300);
  BOOST_TEST(std::isnan(vector_math::power_product(
    1., 1.77, std::numeric_limits<double>::quiet_NaN(), 4.82)));
}

BOOST_AUTO_TEST_SUITE_END()
