#include "ephyra/base/text.h"

#include <boost/test/unit_test.hpp>

using namespace ephyra;

BOOST_AUTO_TEST_SUITE(text_helpers)

BOOST_AUTO_TEST_CASE(blanks_are_normalized)
{
  BOOST_TEST(text::normalize("  a \t b\r\n") == "a b");
  BOOST_TEST(text::normalize("30\xC2\xA0mm") == "30 mm");
  BOOST_TEST(text::normalize(" ") == "");
}

BOOST_AUTO_TEST_CASE(lists_are_split_outside_of_parentheses)
{
  const std::vector<std::string> items{"1", "max(a, b)", ""};
  BOOST_TEST(text::split_list("1 , max(a, b),") == items,
             boost::test_tools::per_element());
  BOOST_TEST(text::split_list(" ").empty());
}

BOOST_AUTO_TEST_CASE(numbers_read_back_exactly)
{
  BOOST_TEST(text::number(0.1) == "0.1");
  BOOST_TEST(text::number(1e-6) == "1e-06");
  for (const double x : {1. / 3., 6.02e23, -2.3e-308, 0.1 + 0.2})
    BOOST_TEST(std::stod(text::number(x)) == x);
}

BOOST_AUTO_TEST_CASE(edit_distances)
{
  BOOST_TEST(text::edit_distance("Density", "Density") == 0u);
  BOOST_TEST(text::edit_distance("density", "Density") == 0u);
  BOOST_TEST(text::edit_distance("Densty", "Density") == 1u);
  BOOST_TEST(text::edit_distance("Dnesity", "Density") == 1u);
  BOOST_TEST(text::edit_distance("Denxity", "Density") == 1u);
  BOOST_TEST(text::edit_distance("kitten", "sitting") == 3u);
  BOOST_TEST(text::edit_distance("", "abc") == 3u);
  BOOST_TEST(text::edit_distance("ca", "abc") == 3u); // restricted form
}

BOOST_AUTO_TEST_CASE(suggestions)
{
  BOOST_TEST(text::suggestion("Densty", {"Viscosity", "Density"}, "entries") ==
             "did you mean \"Density\"?");
  BOOST_TEST(text::suggestion("Colour", {"Viscosity", "Density"}, "entries") ==
             "valid entries are \"Viscosity\", \"Density\"");
  BOOST_TEST(text::suggestion("a", {}, "entries") ==
             "there are no entries here");
}

BOOST_AUTO_TEST_SUITE_END()
