#include "ephyra/base/parameter_handler.h"

#include "ephyra/base/exceptions.h"

#include <boost/test/unit_test.hpp>

#include <sstream>

using namespace ephyra;

BOOST_AUTO_TEST_SUITE(parameter_handler)

namespace
{
  void
  declare_body(ParameterHandler &prm)
  {
    prm.declare_entry("Density",
                      "1100",
                      patterns::Positive("kg/m^3"),
                      "Mass density of the body.");
    ParameterHandler::Section motion(prm, "Motion");
    prm.declare_entry("Type", "fixed", patterns::Selection("fixed|free"), "");
  }

  void
  declare(ParameterHandler &prm)
  {
    prm.declare_entry(
      "End time", "1 s", patterns::Positive("s"), "When to end.");
    {
      ParameterHandler::Section section(prm, "Fluid");
      prm.declare_entry("Density", "1000", patterns::Positive("kg/m^3"), "");
      prm.declare_entry(
        "Viscosity", "1 mPa s", patterns::Double("Pa s", 0), "");
      prm.declare_entry("Convection", "true", patterns::Bool(), "");
      ParameterHandler::Section grid(prm, "Grid");
      prm.declare_entry("Cells", "16", patterns::Integer(1, 1000), "");
      prm.declare_entry("Sizes",
                        "1 mm, 2 mm",
                        patterns::List(patterns::Positive("m"), 1, 3),
                        "");
    }
    prm.declare_repeated_subsection("Body", declare_body, "A body.");
  }

  struct Handler : ParameterHandler
  {
    Handler()
    {
      declare(*this);
    }

    /// The message for a text, or "".
    std::string
    errors() const
    {
      try
        {
          throw_errors();
        }
      catch (const InputError &error)
        {
          return error.what();
        }
      return "";
    }
  };

  std::string
  errors_of(const std::string &text)
  {
    Handler prm;
    prm.read_text(text, "a.prm");
    return prm.errors();
  }

  const std::string one = "1 error in the parameters:\n  a.prm:";
} // namespace

BOOST_AUTO_TEST_CASE(values_are_read_in_si)
{
  Handler prm;
  prm.read_text("# A scene\r\n"
                "set End time = 2500 ms  # trailing comment\n"
                "subsection   Fluid\n"
                "\tset Density=1.1 g/cm^3\n"
                "  subsection Grid\n"
                "    set Sizes = 1 mm, \\\n"
                "      3 cm\n"
                "  end\n"
                "  set Convection = no\n"
                "end\n",
                "a.prm");
  BOOST_TEST(prm.errors() == "");
  BOOST_TEST(prm.get_double("End time") == 2.5);
  BOOST_TEST(prm.get("End time") == "2500 ms");
  BOOST_TEST(prm.origin("End time") == "a.prm:2");
  ParameterHandler::Section fluid(prm, "Fluid");
  BOOST_TEST(prm.get_double("Density") == 1100.);
  BOOST_TEST(prm.get_double("Viscosity") == 1e-3);
  BOOST_TEST(!prm.get_bool("Convection"));
  BOOST_TEST(prm.is_set("Density"));
  BOOST_TEST(!prm.is_set("Viscosity"));
  BOOST_TEST(prm.origin("Viscosity") == "default");
  ParameterHandler::Section grid(prm, "Grid");
  BOOST_TEST(prm.get_integer("Cells") == 16);
  BOOST_TEST(prm.get_double_list("Sizes") == (std::vector<double>{1e-3, 0.03}),
             boost::test_tools::per_element());
  BOOST_TEST(prm.origin("Sizes") == "a.prm:6");
}

BOOST_AUTO_TEST_CASE(all_errors_are_reported_at_once)
{
  BOOST_TEST(errors_of("set End time = 30 kg\n"
                       "subsection Fluid\n"
                       "  set Densty = 1000\n"
                       "  set Viscosity = -1 Pa s\n"
                       "  set Convection = maybe\n"
                       "  subsection Grids\n"
                       "    set Cells = 3.5\n"
                       "  end\n"
                       "end\n") ==
             "6 errors in the parameters:\n"
             "  a.prm:1: End time = \"30 kg\": \"30 kg\" is a mass, but a time "
             "is needed; allowed is a positive time in s\n"
             "  a.prm:3: Fluid/Densty = \"1000\": there is no such entry, did "
             "you mean \"Density\"?\n"
             "  a.prm:4: Fluid/Viscosity = \"-1 Pa s\": \"-1 Pa s\" is out of "
             "range; allowed is a dynamic viscosity of at least 0 Pa s\n"
             "  a.prm:5: Fluid/Convection = \"maybe\": \"maybe\" is neither "
             "true nor false; allowed is true or false (or yes, no)\n"
             "  a.prm:6: there is no subsection \"Grids\" in \"Fluid\", did "
             "you mean \"Grid\"?\n"
             "  a.prm:7: Fluid/Grid/Cells = \"3.5\": \"3.5\" is not an "
             "integer; allowed is an integer between 1 and 1000");
}

BOOST_AUTO_TEST_SUITE_END()
