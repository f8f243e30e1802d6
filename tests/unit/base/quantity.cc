#include "ephyra/base/quantity.h"

#include "ephyra/base/exceptions.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

using namespace ephyra;

BOOST_AUTO_TEST_SUITE(quantity)

namespace
{
  double
  si(const std::string &text)
  {
    return parse_quantity(text).value;
  }

  std::string
  kind(const std::string &text)
  {
    return parse_quantity(text).dimension.description();
  }

  std::string
  error(const std::string &text)
  {
    try
      {
        parse_quantity(text);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace

BOOST_AUTO_TEST_CASE(values_are_converted_and_rounded_once)
{
  // Exact comparisons: the literal on the right is the nearest double.
  BOOST_TEST(si("30 mm") == 0.03);
  BOOST_TEST(si("30mm") == 0.03);
  BOOST_TEST(si("0.7 um") == 0.7e-6);
  BOOST_TEST(si("5 us") == 5e-6);
  BOOST_TEST(si("5 \xC2\xB5s") == 5e-6); // micro sign
  BOOST_TEST(si("5 \xCE\xBCs") == 5e-6); // Greek letter
  BOOST_TEST(si("0.5 Hz") == 0.5);
  BOOST_TEST(si("1.1e3 kg/m^3") == 1100.);
  BOOST_TEST(si("1.1 g/cm^3") == 1100.);
  BOOST_TEST(si("400 Pa") == 400.);
  BOOST_TEST(si("1 mPa s") == 1e-3);
  BOOST_TEST(si("1 mPa*s") == 1e-3);
  BOOST_TEST(si("0.1 nA/mm^3") == 0.1);
  BOOST_TEST(si("25 %") == 0.25);
  BOOST_TEST(si("1 L") == 1e-3);
  BOOST_TEST(si("2 mL/min") == 2e-6 / 60, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(si("-3.5e2") == -350.);
  BOOST_TEST(si("+3") == 3.);
  BOOST_TEST(si(".5") == .5);
  BOOST_TEST(si("4 1/s") == 4.);
  BOOST_TEST(si("180 deg") == std::acos(-1.),
             boost::test_tools::tolerance(1e-15));
  // nA/(mm mV) = 1e-9 A / (1e-3 m 1e-3 V) = 1e-3 S/m
  BOOST_TEST(si("1.3745e-5 nA/(mm mV)") == 1.3745e-8,
             boost::test_tools::tolerance(1e-15));
  BOOST_TEST(si("3 (m/s)^2") == 3.);
  BOOST_TEST(si("9.81 m/s/s") == 9.81);
  BOOST_TEST(si("2 s^-1") == 2.);
}

BOOST_AUTO_TEST_CASE(dimensions_have_names)
{
  BOOST_TEST(kind("1") == "a number");
  BOOST_TEST(kind("1 rad") == "a number");
  BOOST_TEST(kind("1 mm") == "a length");
  BOOST_TEST(kind("1 N/mm^2") == "a pressure");
  BOOST_TEST(kind("1 kHz") == "a frequency");
  BOOST_TEST(kind("1 nA/(mm mV)") == "an electric conductivity");
  BOOST_TEST(kind("1 nF/mm^3") == "an electric capacitance per volume");
  BOOST_TEST(kind("1 Ohm S") == "a number");
  BOOST_TEST(kind("1 W/(m K)") == "a quantity in kg m/(s^3 K)");
  BOOST_TEST(!parse_quantity("1").has_unit);
  BOOST_TEST(parse_quantity("1 %").has_unit);
  // Consistency of the derived units.
  const auto same = [](const char *a, const char *b) {
    return parse_unit(a).dimension == parse_unit(b).dimension &&
           parse_unit(a).to_si(3.) == parse_unit(b).to_si(3.);
  };
  BOOST_TEST(same("J", "N m"));
  BOOST_TEST(same("W", "V A"));
  BOOST_TEST(same("S", "A/V"));
  BOOST_TEST(same("F", "C/V"));
  BOOST_TEST(same("Ohm", "1/S"));
  BOOST_TEST(same("Pa", "N/m^2"));
  BOOST_TEST(same("N", "kg m s^-2"));
  BOOST_TEST(same("L", "dm^3"));
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_said)
{
  BOOST_TEST(error("") == "\"\" is not a number");
  BOOST_TEST(error("mm") == "\"mm\" is not a number");
  BOOST_TEST(error("nan") == "\"nan\" is not a number");
  BOOST_TEST(error("-inf m") == "\"-inf m\" is not a number");
  BOOST_TEST(error("1e999") == "\"1e999\" is too large or too small a number");
  BOOST_TEST(error("1e300 Tm^5") == "\"1e300 Tm^5\" is too large a number");
  BOOST_TEST(error("3 parsec") == "the unit \"parsec\" is not understood: "
                                  "there is no unit \"parsec\"");
  BOOST_TEST(error("3 W/m K") ==
             "the unit \"W/m K\" is not understood: a product after a division "
             "is ambiguous, use parentheses");
  BOOST_TEST(error("3 A/(mm mV") == "the unit \"A/(mm mV\" is not understood: "
                                    "a closing parenthesis is missing");
  BOOST_TEST(error("3 m)") == "the unit \"m)\" is not understood: there is an "
                              "unexpected \")\"");
  BOOST_TEST(error("3 m^x") == "the unit \"m^x\" is not understood: an integer "
                               "between -9 and 9 must follow \"^\"");
  BOOST_TEST(error("3 m/") ==
             "the unit \"m/\" is not understood: a unit is missing");
  BOOST_TEST(error("2*pi rad") ==
             "the unit \"*pi rad\" is not understood: a unit is missing");
  BOOST_TEST(error("1 ((((((m))))))") ==
             "the unit \"((((((m))))))\" is not understood: it has too many "
             "parentheses");
}

BOOST_AUTO_TEST_CASE(random_texts_never_crash)
{
  const std::vector<std::string> pieces{
    "1", ".5", "e3", "-", "+", " ", "m",        "kg",  "s", "/",
    "*", "^",  "(",  ")", "2", "%", "\xC2\xB5", "deg", "x", ","};
  std::mt19937 random(3);
  int          n_read = 0;
  for (int i = 0; i < 20000; ++i)
    {
      std::string text = "1 ";
      for (unsigned int j = random() % 10; j > 0; --j)
        text += pieces[random() % pieces.size()];
      if (error(text).empty())
        {
          ++n_read;
          BOOST_REQUIRE(std::isfinite(si(text)));
        }
    }
  BOOST_TEST(n_read > 1000);
}

BOOST_AUTO_TEST_SUITE_END()
