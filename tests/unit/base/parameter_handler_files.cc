#include "ephyra/base/parameter_handler.h"

#include "ephyra/base/exceptions.h"
#include "example_parameters.h"
#include "temporary_folder.h"

#include <boost/test/unit_test.hpp>

#include <random>
#include <sstream>
#include <stdexcept>

using namespace ephyra;
using namespace ephyra::testing;

BOOST_AUTO_TEST_SUITE(parameter_handler_files)

BOOST_AUTO_TEST_CASE(files_include_files)
{
  const testing::TemporaryFolder folder;
  folder.write("common/water.prm",
               "subsection Fluid\n"
               "  set Density = 998\n"
               "  include grid.prm\n"
               "end\n");
  folder.write("common/grid.prm", "subsection Grid\n set Cells = 5\nend\n");
  const std::string scene = folder.write("scenes/a.prm",
                                         "include ../common/water.prm\n"
                                         "subsection Fluid\n"
                                         "  set Density = 1025\n"
                                         "end\n");
  Handler           prm;
  prm.read_file(scene);
  BOOST_TEST(prm.errors() == "");
  ParameterHandler::Section fluid(prm, "Fluid");
  BOOST_TEST(prm.get_double("Density") == 1025.);
  BOOST_TEST(prm.origin("Density") == scene + ":3");
  ParameterHandler::Section grid(prm, "Grid");
  BOOST_TEST(prm.get_integer("Cells") == 5);
  BOOST_TEST(prm.origin("Cells") == folder.file("common/grid.prm") + ":2");
}

BOOST_AUTO_TEST_CASE(errors_of_included_files)
{
  const testing::TemporaryFolder folder;
  const auto                     error = [](const std::string &file) {
    Handler prm;
    prm.read_file(file);
    return prm.errors();
  };
  const std::string none  = folder.file("none.prm"),
                    begin = "1 error in the parameters:\n  ";
  BOOST_TEST(error(none) ==
             begin + "the parameter file \"" + none + "\" does not exist");
  BOOST_TEST(error(folder.path) ==
             begin + "the parameter file \"" + folder.path + "\" is a folder");
  const std::string missing = folder.write("missing.prm", "\ninclude none.prm");
  BOOST_TEST(error(missing) == begin + missing +
                                 ":2: include: the parameter file \"" + none +
                                 "\" does not exist");
  const std::string self = folder.write("self.prm", "include ./self.prm\n");
  BOOST_TEST(error(self) ==
             begin + self + ":1: include: \"" + self + "\" includes itself");
  const std::string a = folder.write("a.prm", "include b.prm\n"),
                    b = folder.write("b.prm", "include a.prm\n");
  BOOST_TEST(error(a) == begin + b + ":1: include: \"" + a +
                           "\" includes itself by way of \"" + b + "\"");
  // An included file may not silently undo what stands before the include,
  // nor close subsections of the other file.
  const std::string late =
    folder.write("late.prm", "set End time = 1\ninclude time.prm\n");
  const std::string time = folder.write("time.prm", "set End time = 2\nend\n");
  BOOST_TEST(error(late) ==
             "2 errors in the parameters:\n  " + time +
               ":1: End time = \"2\": it is already set at " + late +
               ":1, set it after the include to change it\n  " + time +
               ":2: there is no subsection open that this \"end\" could close");
}

BOOST_AUTO_TEST_CASE(cross_checks_point_at_entries)
{
  Handler prm;
  prm.read_text("subsection Fluid\n\n  set Density = 5\nend\n", "a.prm");
  prm.add_error("Fluid/Density", "it must exceed that of the body");
  prm.add_error("End time", "it is too short");
  prm.add_error("End time", "it is too short"); // shown once
  prm.add_error("Body", "a scene needs one");
  BOOST_TEST(prm.errors() ==
             "3 errors in the parameters:\n"
             "  a.prm:3: Fluid/Density = \"5\": it must exceed that of the "
             "body\n"
             "  default: End time = \"1 s\": it is too short\n"
             "  Body: a scene needs one");
}

BOOST_AUTO_TEST_CASE(mistakes_of_the_program_are_noticed)
{
  Handler prm;
  BOOST_CHECK_THROW(prm.get("Beginn"), std::logic_error);
  BOOST_CHECK_THROW(prm.leave_subsection(), std::logic_error);
  BOOST_CHECK_THROW(
    prm.declare_entry("End time", "1", patterns::Double("s"), ""),
    std::logic_error);
  BOOST_CHECK_THROW(prm.declare_entry("x", "1 m", patterns::Double("s"), ""),
                    std::logic_error);
  BOOST_CHECK_THROW(prm.declare_entry("a/b", "1", patterns::Double(), ""),
                    std::logic_error);
  BOOST_CHECK_THROW(prm.declare_repeated_subsection("Body", declare_body, ""),
                    std::logic_error);
}

BOOST_AUTO_TEST_CASE(the_resolved_file_reproduces_the_run)
{
  Handler prm;
  prm.read_text("subsection Body left\n"
                "  set Density = 1050 kg/m^3\n"
                "end\n"
                "subsection Fluid\n"
                "  set Convection = no\n"
                "end\n",
                "a.prm");
  prm.set_override("Fluid/Grid/Sizes = 3 mm");
  std::ostringstream first;
  prm.write_resolved(first);
  BOOST_TEST(first.str() == "set End time = 1 s  # default\n"
                            "subsection Fluid\n"
                            "  set Density = 1000  # default\n"
                            "  set Viscosity = 1 mPa s  # default\n"
                            "  set Convection = no\n"
                            "  subsection Grid\n"
                            "    set Cells = 16  # default\n"
                            "    set Sizes = 3 mm\n"
                            "  end\n"
                            "end\n"
                            "subsection Body left\n"
                            "  set Density = 1050 kg/m^3\n"
                            "  subsection Motion\n"
                            "    set Type = fixed  # default\n"
                            "  end\n"
                            "end\n");
  Handler again;
  again.read_text(first.str(), "resolved.prm");
  BOOST_TEST(again.errors() == "");
  std::ostringstream second;
  again.write_resolved(second);
  BOOST_TEST(second.str() == first.str());
  // What the resolved file sets to its default does not count as set.
  BOOST_TEST(!again.is_set("End time"));
}

BOOST_AUTO_TEST_CASE(declarations_are_written_as_text)
{
  Handler            prm;
  std::ostringstream text;
  prm.write_declarations(text, ParameterHandler::Format::text);
  BOOST_TEST(text.str().find("# When to end.\n"
                             "# Allowed: a positive time in s.\n"
                             "set End time = 1 s\n\n"
                             "subsection Fluid\n"
                             "  # Allowed: a positive density in kg/m^3.\n"
                             "  set Density = 1000 kg/m^3\n") == 0u);
  BOOST_TEST(
    text.str().find("# A body. (any number of these, each with a NAME)\n"
                    "subsection Body NAME\n"
                    "  # Mass density of the body.\n") != std::string::npos);
  // It is a parameter file itself.
  Handler again;
  again.read_text(text.str(), "declared.prm");
  BOOST_TEST(again.errors() == "");
  BOOST_TEST(again.instances("Body").size() == 1u);
}

BOOST_AUTO_TEST_CASE(declarations_are_written_as_markdown)
{
  Handler            prm;
  std::ostringstream text;
  prm.write_declarations(text, ParameterHandler::Format::markdown);
  for (const char *part :
       {"## Outside of subsections\n\n"
        "| Entry | Default | Unit | Allowed | Meaning |\n"
        "|---|---|---|---|---|\n"
        "| End time | `1 s` | s | a positive time in s | When to end. |\n\n"
        "## Fluid\n\n",
        "## Fluid/Grid\n\n",
        "## Body NAME\n\n",
        "| Density | `1100` | kg/m^3 | a positive density in kg/m^3 | Mass "
        "density of the body. |\n",
        "## Body NAME/Motion\n\n"})
    BOOST_TEST(text.str().find(part) != std::string::npos, part);
}

BOOST_AUTO_TEST_CASE(damaged_files_never_crash)
{
  const std::string text = "subsection Body left\n"
                           "  set Density = 1050 kg/m^3 # water\n"
                           "  subsection Motion\n"
                           "    set Type = free\n"
                           "  end\n"
                           "end\n"
                           "subsection Fluid\n"
                           "  set Viscosity = 1 mPa s\n"
                           "  subsection Grid\n"
                           "    set Sizes = 1 mm, \\\n"
                           "      2 (mm)^1, 3e-3 m\n"
                           "  end\n"
                           "end";
  BOOST_TEST(errors_of(text) == "");
  // Cut off in the second subsection: never accepted.
  for (std::size_t size = text.find("subsection Fluid") + 1; size < text.size();
       ++size)
    BOOST_TEST(errors_of(text.substr(0, size)) != "", text.substr(0, size));
  // Cut off, overwritten, and doubled pieces: accepted or refused, values stay
  // valid.
  std::mt19937 random(5);
  const auto   below = [&random](const std::size_t n) { return random() % n; };
  for (int i = 0; i < 3000; ++i)
    {
      std::string damaged = text;
      for (std::size_t j = below(4); j > 0; --j)
        switch (below(3))
          {
          case 0:
            damaged.resize(below(damaged.size() + 1));
            break;
          case 1:
            if (!damaged.empty())
              damaged[below(damaged.size())] = static_cast<char>(random());
            break;
          default:
            const std::size_t at = below(damaged.size() + 1);
            damaged.insert(at, damaged.substr(below(at + 1), below(40)));
          }
      Handler prm;
      prm.read_text(damaged, "a.prm");
      prm.errors();
      ParameterHandler::Section fluid(prm, "Fluid");
      BOOST_REQUIRE(prm.get_double("Viscosity") >= 0.);
      ParameterHandler::Section grid(prm, "Grid");
      BOOST_REQUIRE(prm.get_double_list("Sizes").size() <= 3u);
    }
}

BOOST_AUTO_TEST_SUITE_END()
