#include "ephyra/base/patterns.h"

#include "temporary_folder.h"

#include <boost/test/unit_test.hpp>

#include <stdexcept>

using namespace ephyra;
using namespace ephyra::patterns;

BOOST_AUTO_TEST_SUITE(patterns_of_entries)

BOOST_AUTO_TEST_CASE(real_numbers)
{
  const Double length("m", 0, 1);
  BOOST_TEST(length.error("30 mm") == "");
  BOOST_TEST(length.error("0.5") == "");
  BOOST_TEST(length.error("0") == "");
  BOOST_TEST(length.error("1") == "");
  BOOST_TEST(length.error("1.1 m") == "\"1.1 m\" is out of range");
  BOOST_TEST(length.error("-1 um") == "\"-1 um\" is out of range");
  BOOST_TEST(length.error("30 kg") ==
             "\"30 kg\" is a mass, but a length is needed");
  BOOST_TEST(length.error("5 %") ==
             "\"5 %\" is a number, but a length is needed");
  BOOST_TEST(length.error("wide") == "\"wide\" is not a number");
  BOOST_TEST(length.unit() == "m");

  BOOST_TEST(Positive("s").error("0") == "\"0\" is out of range");
  BOOST_TEST(Double().error("5 %") == "");
  BOOST_TEST(Double().error("5 m") ==
             "\"5 m\" is a length, but a number is needed");
  BOOST_TEST(Double("rad").error("90 deg") == "");

  BOOST_TEST(length.description() == "a length between 0 and 1 m");
  BOOST_TEST(Positive("Pa").description() == "a positive pressure in Pa");
  BOOST_TEST(Positive().description() == "a positive number");
  BOOST_TEST(Double("V").description() == "a voltage in V");
  BOOST_TEST(Double("m", 0).description() == "a length of at least 0 m");
  BOOST_TEST(
    Double(
      "", -std::numeric_limits<double>::infinity(), 2, Double::Bounds::open)
      .description() == "a number below 2");
  BOOST_TEST(Double("", 1, 2, Double::Bounds::open).description() ==
             "a number between 1 and 2, both excluded");
  BOOST_CHECK_THROW(Double("mm"), std::logic_error);
}

BOOST_AUTO_TEST_CASE(integers_and_words)
{
  BOOST_TEST(Integer().error("-12") == "");
  BOOST_TEST(Integer().error("1.5") == "\"1.5\" is not an integer");
  BOOST_TEST(Integer().error("1e3") == "\"1e3\" is not an integer");
  BOOST_TEST(Integer().error("") == "\"\" is not an integer");
  BOOST_TEST(Integer().error("99999999999") ==
             "\"99999999999\" is out of range");
  BOOST_TEST(Integer(1, 4).error("5") == "\"5\" is out of range");
  BOOST_TEST(Integer(1).description() == "an integer of at least 1");

  BOOST_TEST(Bool().error("yes") == "");
  BOOST_TEST(Bool().error("True") == "\"True\" is neither true nor false");

  const Selection motion("fixed|prescribed motion|free");
  BOOST_TEST(motion.error("prescribed motion") == "");
  BOOST_TEST(motion.error("fixd") ==
             "\"fixd\" is not among the choices (did you mean \"fixed\"?)");
  BOOST_TEST(motion.error("elastic") == "\"elastic\" is not among the choices");
  BOOST_TEST(motion.description() ==
             "one of \"fixed\", \"prescribed motion\", \"free\"");
}

BOOST_AUTO_TEST_CASE(lists)
{
  const List lengths(Positive("m"), 1, 3);
  BOOST_TEST(lengths.error("1, 2, 3") == "");
  BOOST_TEST(lengths.error("1 mm, 2 cm") == "");
  BOOST_TEST(lengths.error("") == "the list has 0 items");
  BOOST_TEST(lengths.error("1, 2, 3, 4") == "the list has 4 items");
  BOOST_TEST(lengths.error("1 mm, -2 mm") ==
             "item 2: \"-2 mm\" is out of range");
  BOOST_TEST(lengths.error("1,,2") == "item 2: \"\" is not a number");
  BOOST_TEST(lengths.error("1, 2, 3 mm") ==
             "some items have a unit and some have none, give each item its "
             "unit");
  BOOST_TEST(List(Double("m")).error("0, 3 mm") == "");
  BOOST_TEST(List(Double("m")).error("") == "");
  BOOST_TEST(List(Selection("a|b")).error("a, c") ==
             "item 2: \"c\" is not among the choices");
  BOOST_TEST(List(Expression({"r", "y"})).error("max(r, y), y") == "");
  BOOST_TEST(lengths.description() ==
             "a list of 1 to 3 items separated by commas, each a positive "
             "length in m");
  BOOST_TEST(List(Integer(), 2, 2).description() ==
             "a list of 2 items separated by commas, each an integer");
  BOOST_TEST(lengths.unit() == "m");
}

BOOST_AUTO_TEST_CASE(formulas)
{
  const Expression speed({"r", "t"}, "m/s");
  BOOST_TEST(speed.error("r*sin(t)") == "");
  BOOST_TEST(speed.error("x") ==
             "the formula \"x\" has the unknown name \"x\" (position 1), its "
             "variables are \"r\", \"t\"");
  BOOST_TEST(speed.error("3 m") ==
             "\"3 m\" is a length, but a velocity is needed");
  BOOST_TEST(speed.resolve("30 mm/s", "") == "0.03");
  BOOST_TEST(speed.resolve("30 mm", "") == "30 mm");
  BOOST_TEST(speed.resolve("3*r", "") == "3*r");
  BOOST_TEST(speed.description() ==
             "a formula in \"r\", \"t\" giving a velocity in m/s");
}

BOOST_AUTO_TEST_CASE(input_files)
{
  const testing::TemporaryFolder folder;
  const std::string              file = folder.write("points.csv", "");
  const InputFile                pattern;
  BOOST_TEST(pattern.resolve("points.csv", folder.path) == file);
  BOOST_TEST(pattern.resolve("./points.csv", folder.path) == file);
  BOOST_TEST(pattern.resolve(file, "/elsewhere") == file);
  BOOST_TEST(pattern.error(file) == "");
  BOOST_TEST(pattern.error("") == "");
  BOOST_TEST(pattern.error(folder.file("none.csv")) ==
             "there is no file \"" + folder.file("none.csv") + "\"");
}

BOOST_AUTO_TEST_SUITE_END()
