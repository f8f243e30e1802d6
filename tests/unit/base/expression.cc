#include "ephyra/base/expression.h"

#include "ephyra/base/exceptions.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>
#include <utility>

using namespace ephyra;

BOOST_AUTO_TEST_SUITE(expression)

namespace
{
  std::string
  error(const std::string &formula, const std::vector<std::string> &variables)
  {
    try
      {
        Expression(formula, variables);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace

BOOST_AUTO_TEST_CASE(values)
{
  const auto       tolerance = boost::test_tools::tolerance(1e-15);
  const Expression ramp("0.5*(1 - cos(pi*t))", {"t"});
  BOOST_TEST(ramp(0.) == 0.);
  BOOST_TEST(ramp(1. / 3.) == 0.25, tolerance);
  BOOST_TEST(ramp({1.}) == 1., tolerance);
  BOOST_TEST(ramp.formula() == "0.5*(1 - cos(pi*t))");
  const Expression field("r^2 - 3*y", {"r", "y"});
  BOOST_TEST(field({2., 1.}) == 1.);
  const Expression pulse("step(t - 1)*(t <= 2 ? 1 : 0)", {"t"});
  BOOST_TEST(pulse(0.999) == 0.);
  BOOST_TEST(pulse(1.) == 1.);
  BOOST_TEST(pulse(2.1) == 0.);
}

BOOST_AUTO_TEST_CASE(special_functions)
{
  // Values from tables: Abramowitz & Stegun, 7.1, 9.1 and 9.8.
  const auto tolerance  = boost::test_tools::tolerance(1e-12);
  const auto at_minus_1 = [](const std::string &name) {
    return Expression(name + "(x)", {"x"})(-1.);
  };
  BOOST_TEST(at_minus_1("bessel_j0") == 0.765197686557967, tolerance);
  BOOST_TEST(at_minus_1("bessel_j1") == -0.440050585744934, tolerance);
  BOOST_TEST(at_minus_1("bessel_i0") == 1.266065877752008, tolerance);
  BOOST_TEST(at_minus_1("bessel_i1") == -0.565159103992485, tolerance);
  BOOST_TEST(Expression("bessel_j1(x)", {"x"})(0.) == 0.);
  BOOST_TEST(at_minus_1("erf") == -0.842700792949715, tolerance);
}

BOOST_AUTO_TEST_CASE(copies_are_independent)
{
  const Expression square("t^2", {"t"});
  Expression       copy(square);
  BOOST_TEST(copy(3.) == 9.);
  BOOST_TEST(square(2.) == 4.);
  copy = Expression("-t", {"t"});
  BOOST_TEST(copy(3.) == -3.);
  copy = square;
  const Expression moved(std::move(copy));
  BOOST_TEST(moved(4.) == 16.);
}

BOOST_AUTO_TEST_CASE(zero_is_recognized)
{
  BOOST_TEST(Expression("0", {"t"}).is_zero());
  BOOST_TEST(Expression("0.0", {"t"}).is_zero());
  BOOST_TEST(!Expression("t", {"t"}).is_zero());
  BOOST_TEST(!Expression("1", {"t"}).is_zero());
}

BOOST_AUTO_TEST_CASE(bad_formulas_are_refused)
{
  BOOST_TEST(error("sin(x)", {"t"}) ==
             "the formula \"sin(x)\" has the unknown name \"x\" (position 5), "
             "its variables are \"t\"");
  BOOST_TEST(error("a", {}) == "the formula \"a\" has the unknown name \"a\" "
                               "(position 1), it has no variables");
  BOOST_TEST(error("", {"t"}) == "the formula is empty");
  BOOST_TEST(error("1, 2", {"t"}) ==
             "the formula \"1, 2\" has more than one value");
  BOOST_TEST(error("t = 1", {"t"}) == "the formula \"t = 1\" holds an "
                                      "assignment, which is not allowed");
  for (const char *formula :
       {"2*(t", "t)", "2 t", "*", "sin()", "1 +", "\"text\"", "t ? 1"})
    BOOST_TEST(error(formula, {"t"}).find("is not understood: ") !=
                 std::string::npos,
               "\"" << formula << "\" gives " << error(formula, {"t"}));
}

BOOST_AUTO_TEST_CASE(results_that_are_not_finite_are_refused)
{
  const Expression inverse("1/t", {"t"});
  BOOST_TEST(inverse(2.) == 0.5);
  BOOST_CHECK_EXCEPTION(inverse(0.), InputError, [](const InputError &error) {
    return std::string(error.what()) ==
           "The formula \"1/t\" gives inf at t = 0; change it so that it is "
           "finite there.";
  });
  BOOST_CHECK_THROW(Expression("sqrt(t)", {"t"})(-1.), InputError);
}

BOOST_AUTO_TEST_CASE(random_texts_never_crash)
{
  const std::vector<std::string> pieces{
    "1",  ".5", "e3",  "-",    "+", " ",  "t", "pi", "sin",
    "/",  "*",  "^",   "(",    ")", "?",  ":", ",",  "<",
    "==", "=",  "min", "step", "x", "&&", "!", "\"", "_"};
  std::mt19937 random(4);
  int          n_read = 0;
  for (int i = 0; i < 3000; ++i)
    {
      std::string text;
      for (unsigned int j = random() % 9; j > 0; --j)
        text += pieces[random() % pieces.size()];
      n_read += error(text, {"t"}).empty() ? 1 : 0;
    }
  BOOST_TEST(n_read > 20);
}

BOOST_AUTO_TEST_SUITE_END()
