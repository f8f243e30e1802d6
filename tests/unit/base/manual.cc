// What docs/manual/parameter_file.md shows is what the program does.
#include "ephyra/base/exceptions.h"
#include "ephyra/base/parameter_file.h"
#include "ephyra/base/parameter_handler.h"

#include "temporary_folder.h"

#include <boost/test/unit_test.hpp>

using namespace ephyra;

BOOST_AUTO_TEST_SUITE(manual)

namespace
{
  /// The blocks of the page in a language.
  std::vector<std::string>
  blocks(const std::string &language)
  {
    const std::string page = testing::read_whole_file(
      EPHYRA_SOURCE_DIR "/docs/manual/parameter_file.md");
    const std::string        begin = "\n```" + language + "\n";
    std::vector<std::string> result;
    for (std::size_t at = 0; (at = page.find(begin, at)) != std::string::npos;)
      {
        at += begin.size();
        result.push_back(page.substr(at, page.find("```", at) - at));
      }
    return result;
  }
} // namespace

BOOST_AUTO_TEST_CASE(examples_follow_the_syntax)
{
  BOOST_TEST(blocks("prm").size() == 4u);
  for (const std::string &block : blocks("prm"))
    for (const ParameterStatement &statement : parse_parameter_text(block))
      BOOST_TEST((statement.kind != ParameterStatement::Kind::invalid),
                 statement.value);
}

BOOST_AUTO_TEST_CASE(the_error_messages_are_these)
{
  ParameterHandler prm;
  prm.declare_entry("End time", "1", patterns::Positive("s"), "");
  {
    ParameterHandler::Section fluid(prm, "Fluid");
    prm.declare_entry("Density", "1", patterns::Positive("kg/m^3"), "");
    prm.declare_entry("Viscosity", "1", patterns::Double("Pa s", 0), "");
  }
  prm.read_text(blocks("prm").back(), "scene.prm");
  BOOST_TEST(testing::message_of<InputError>([&prm] { prm.throw_errors(); }) +
               "\n" ==
             blocks("text").at(0));
}

BOOST_AUTO_TEST_SUITE_END()
