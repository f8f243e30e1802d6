#include "ephyra/base/parameter_handler.h"

#include "ephyra/base/exceptions.h"
#include "example_parameters.h"
#include "temporary_folder.h"

#include <boost/test/unit_test.hpp>

#include <sstream>

using namespace ephyra;
using namespace ephyra::testing;

BOOST_AUTO_TEST_SUITE(parameter_handler)

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
  BOOST_TEST(prm.any_is_set("Fluid"));
  BOOST_TEST(!prm.any_is_set("Solid"));
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


BOOST_AUTO_TEST_CASE(names_that_are_not_known)
{
  // No name is near: all are listed.
  BOOST_TEST(errors_of("subsection Fluid\n set Colour = red\nend\n") ==
             one + "2: Fluid/Colour = \"red\": there is no such entry, valid "
                   "entries are \"Density\", \"Viscosity\", \"Convection\"");
  BOOST_TEST(errors_of("subsection Heat\nset Density = 1\nend\n") ==
             one + "1: there is no subsection \"Heat\", valid subsections are "
                   "\"Fluid\", \"Body NAME\"");
  // The name exists elsewhere.
  BOOST_TEST(errors_of("set Viscosity = 1\n") ==
             one + "1: Viscosity = \"1\": there is no such entry here, but in "
                   "subsection \"Fluid\"");
  // Letters of the other case are another name.
  BOOST_TEST(errors_of("subsection fluid\nend\n") ==
             one + "1: there is no subsection \"fluid\", did you mean "
                   "\"Fluid\"?");
}

BOOST_AUTO_TEST_CASE(lines_that_are_not_understood)
{
  BOOST_TEST(errors_of("subsecton Fluid\n") ==
             one + "1: \"subsecton Fluid\" is not understood, did you mean "
                   "\"subsection\"?");
  BOOST_TEST(errors_of("Fluid:\n") ==
             one + "1: \"Fluid:\" is not understood, a line is \"subsection "
                   "NAME\", \"set ENTRY = VALUE\", \"end\" or \"include "
                   "FILE\"");
  BOOST_TEST(errors_of("set End time 3\n") ==
             one + "1: \"set End time 3\" is not of the form \"set ENTRY = "
                   "VALUE\"");
  BOOST_TEST(errors_of("set = 3\n") ==
             one + "1: \"set = 3\" is not of the form \"set ENTRY = VALUE\"");
  BOOST_TEST(errors_of("set End time =\n") ==
             one + "1: End time = \"\": the value is missing; allowed is a "
                   "positive time in s");
  BOOST_TEST(errors_of("include\n") ==
             one + "1: a file name must follow \"include\"");
  BOOST_TEST(errors_of("set End time = \\\n") ==
             one + "1: the file ends after a backslash, which announces a "
                   "further line");
  BOOST_TEST(errors_of(std::string("\0\x01\x02", 3)) ==
             one + "1: this is not a text file");
}

BOOST_AUTO_TEST_CASE(subsections_must_balance)
{
  BOOST_TEST(errors_of("subsection Fluid\n  subsection Grid\n  end\n") ==
             one + "1: subsection \"Fluid\" is not closed by an \"end\"");
  BOOST_TEST(errors_of("subsection Fluid\nend\nend\n") ==
             one + "3: there is no subsection open that this \"end\" could "
                   "close");
  BOOST_TEST(errors_of("subsection Fluid\nend Fluid\nend\n") ==
             one + "2: nothing may follow \"end\", but there is \"Fluid\"");
  BOOST_TEST(errors_of("subsection\nend\n") ==
             one + "1: a name must follow \"subsection\"");
  // What lies in an unknown subsection is skipped up to its end.
  BOOST_TEST(errors_of("subsection Heat\n"
                       "  subsection Fluid\n"
                       "    set x = 1\n"
                       "  end\n"
                       "end\n"
                       "set End time = 1 m\n") ==
             "2 errors in the parameters:\n"
             "  a.prm:1: there is no subsection \"Heat\", valid subsections "
             "are \"Fluid\", \"Body NAME\"\n"
             "  a.prm:6: End time = \"1 m\": \"1 m\" is a length, but a time "
             "is needed; allowed is a positive time in s");
}

BOOST_AUTO_TEST_CASE(an_entry_is_set_once_in_a_file)
{
  BOOST_TEST(errors_of("set End time = 1\n"
                       "subsection Fluid\n"
                       "end\n"
                       "set End  time = 2\n") ==
             one + "4: End time = \"2\": it is already set at a.prm:1, remove "
                   "one of the two");
  // Also where the first value was wrong, and where the subsection was closed
  // in between.
  BOOST_TEST(errors_of("subsection Fluid\n"
                       "  set Density = 1 m\n"
                       "end\n"
                       "subsection Fluid\n"
                       "  set Density = 2\n"
                       "end\n") ==
             "2 errors in the parameters:\n"
             "  a.prm:2: Fluid/Density = \"1 m\": \"1 m\" is a length, but a "
             "density is needed; allowed is a positive density in kg/m^3\n"
             "  a.prm:5: Fluid/Density = \"2\": it is already set at a.prm:2, "
             "remove one of the two");
}

BOOST_AUTO_TEST_CASE(repeated_subsections)
{
  Handler prm;
  prm.read_text("subsection Body right\n"
                "  set Density = 1 g/cm^3\n"
                "end\n"
                "subsection Body far left\n"
                "  subsection Motion\n"
                "    set Type = free\n"
                "  end\n"
                "end\n"
                "subsection Body right\n"
                "  subsection Motion\n"
                "    set Type = fixed\n"
                "  end\n"
                "end\n",
                "a.prm");
  BOOST_TEST(prm.errors() == "");
  BOOST_TEST(prm.instances("Body") ==
               (std::vector<std::string>{"right", "far left"}),
             boost::test_tools::per_element());
  {
    ParameterHandler::Section body(prm, "Body right");
    BOOST_TEST(prm.get_double("Density") == 1000.);
  }
  ParameterHandler::Section body(prm, "Body far left");
  BOOST_TEST(prm.get_double("Density") == 1100.);
  BOOST_TEST(!prm.is_set("Density"));
  ParameterHandler::Section motion(prm, "Motion");
  BOOST_TEST(prm.get("Type") == "free");
  BOOST_TEST(Handler().instances("Body").empty());
}

BOOST_AUTO_TEST_CASE(errors_in_repeated_subsections)
{
  BOOST_TEST(errors_of("subsection Body\nset Density = 1\nend\n") ==
             one + "1: subsection \"Body\" needs a name of its own, such as "
                   "\"Body one\"");
  BOOST_TEST(errors_of("subsection Bodie left\nend\n") ==
             one + "1: there is no subsection \"Bodie left\", did you mean "
                   "\"Body left\"?");
  BOOST_TEST(errors_of("subsection Body a/b\nend\n") ==
             one + "1: subsection \"Body a/b\" must not have \"/\" or \"=\" in "
                   "its name");
  BOOST_TEST(errors_of("subsection Body left\n"
                       "  subsection Motion\n"
                       "    set Type = fre\n"
                       "  end\n"
                       "end\n") ==
             one + "3: Body left/Motion/Type = \"fre\": \"fre\" is not among "
                   "the choices (did you mean \"free\"?); allowed is one of "
                   "\"fixed\", \"free\"");
}

BOOST_AUTO_TEST_CASE(overrides)
{
  Handler prm;
  prm.read_text("subsection Fluid\n"
                "  set Density = 1\n"
                "end\n"
                "subsection Body left\n"
                "end\n",
                "a.prm");
  prm.set_override("Fluid/Density = 2 g/cm^3");
  prm.set_override("  Fluid / Grid /Cells=7");
  prm.set_override("Body left/Density = 900");
  prm.set_override("End time = 5");
  prm.set_override("End time = 6"); // the last one counts
  BOOST_TEST(prm.errors() == "");
  BOOST_TEST(prm.get_double("End time") == 6.);
  {
    ParameterHandler::Section fluid(prm, "Fluid");
    BOOST_TEST(prm.get_double("Density") == 2000.);
    BOOST_TEST(prm.origin("Density") == "--set");
    ParameterHandler::Section grid(prm, "Grid");
    BOOST_TEST(prm.get_integer("Cells") == 7);
  }
  prm.set_override("Fluid/Densty = 3");
  prm.set_override("Flud/Density = 3");
  prm.set_override("Body right/Density = 3");
  prm.set_override("Fluid/Density");
  prm.set_override("Fluid/Density = -3");
  prm.set_override("Fluid/Density = 3 # comment");
  BOOST_TEST(
    prm.errors() ==
    "6 errors in the parameters:\n"
    "  --set \"Fluid/Densty = 3\": there is no such entry, did you mean "
    "\"Density\"?\n"
    "  --set \"Flud/Density = 3\": there is no subsection \"Flud\", did you "
    "mean \"Fluid\"?\n"
    "  --set \"Body right/Density = 3\": there is no subsection \"Body "
    "right\", valid subsections are \"Fluid\", \"Body left\"\n"
    "  --set \"Fluid/Density\": it is not of the form \"Section/Entry = "
    "value\"\n"
    "  --set \"Fluid/Density = -3\": \"-3\" is out of range; allowed is a "
    "positive density in kg/m^3\n"
    "  --set \"Fluid/Density = 3 # comment\": the unit \"# comment\" is not "
    "understood: there is no unit \"#\"; allowed is a positive density in "
    "kg/m^3");
}

BOOST_AUTO_TEST_SUITE_END()
