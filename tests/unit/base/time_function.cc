#include "ephyra/base/time_function.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/parameter_handler.h"

#include "temporary_folder.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra;
using testing::message_of;

BOOST_AUTO_TEST_SUITE(time_function)

BOOST_AUTO_TEST_CASE(formulas_and_constants)
{
  const TimeFunction ramp("0.5*(1 - cos(pi*t))");
  BOOST_TEST(ramp(0.5) == 0.5, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(!ramp.is_zero());
  BOOST_TEST(TimeFunction()(3.) == 0.);
  BOOST_TEST(TimeFunction().is_zero());
  const TimeFunction speed("30 mm/s", "m/s"), copy(speed);
  BOOST_TEST(copy(7.) == 0.03);
  BOOST_CHECK_THROW(TimeFunction("30 mm", "m/s"), InputError);
}

BOOST_AUTO_TEST_CASE(tables_are_interpolated)
{
  const testing::TemporaryFolder folder;
  const std::string              file = folder.write("wall speed.csv",
                                        "time [ms],speed [mm/s]\n"
                                                     "1000,0\n1500,2\n3000,-4\n");
  const TimeFunction             speed("table " + file, "m/s");
  const auto tolerance = boost::test_tools::tolerance(1e-14);
  BOOST_TEST(speed(0.) == 0.);
  BOOST_TEST(speed(1.25) == 1e-3, tolerance);
  BOOST_TEST(speed(1.5) == 2e-3, tolerance);
  BOOST_TEST(speed(2.) == 0., tolerance);
  BOOST_TEST(speed(3.) == -4e-3, tolerance);
  BOOST_TEST(speed(9.) == -4e-3, tolerance);
  BOOST_TEST(!speed.is_zero());
  BOOST_TEST(
    message_of<InputError>([&] { TimeFunction("table " + file, "Pa"); }) ==
    "The table \"" + file +
      "\" has a velocity in column 2, but a pressure is needed.");
}

BOOST_AUTO_TEST_CASE(tables_repeat)
{
  const testing::TemporaryFolder folder;
  const std::string  file = folder.write("saw.csv", "1,5\n2,7\n5,5\n");
  const TimeFunction saw("table " + file + " periodic");
  for (const double t : {1.0, 1.25, 1.75, 2.0, 3.3, 4.75})
    for (const int cycle : {-2, -1, 0, 1, 1000})
      BOOST_TEST(saw(t + 4. * cycle) == saw(t),
                 boost::test_tools::tolerance(1e-12));
  BOOST_TEST(saw(1.5) == 6., boost::test_tools::tolerance(1e-14));
  BOOST_TEST(saw(3.5) == 6., boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(bad_tables_are_refused)
{
  const testing::TemporaryFolder folder;
  const auto                     error = [&folder](const std::string &content,
                               const std::string &option) {
    const std::string file = folder.write("bad.csv", content);
    const std::string message =
      message_of<InputError>([&] { TimeFunction("table " + file + option); });
    MPI_Barrier(MPI_COMM_WORLD);
    return message;
  };
  const std::string where = "The table \"" + folder.file("bad.csv") + "\" ";
  BOOST_TEST(error("0,1\n", "") ==
             where + "must have two columns (time, value) and at least two "
                     "rows, it has 2 and 1.");
  BOOST_TEST(error("", "") ==
             where + "must have two columns (time, value) and at least two "
                     "rows, it has 0 and 0.");
  BOOST_TEST(error("0,1\n1,2\n1,3\n", "") ==
             where + "has the time 1 s after 1 s; times must grow.");
  BOOST_TEST(error("0,1\n1,2\n", " periodic") ==
             where + "is periodic, but begins with 1 and ends with 2; the two "
                     "must be equal.");
  BOOST_TEST(error("0,1\n1,nan\n", "") ==
             where + "holds nan, which is not finite.");
  BOOST_TEST(error("time [kg],x\n0,1\n1,2\n", "") ==
             where + "has a mass in column 1, but a time is needed.");
  BOOST_TEST(message_of<InputError>([] { TimeFunction("table"); }) ==
             "a file name must follow \"table\"");
}

BOOST_AUTO_TEST_CASE(files_are_relative_to_the_parameter_file)
{
  const testing::TemporaryFolder folder;
  folder.write("scene/wall.csv", "0,1\n2,3\n");
  const std::string file =
    folder.write("scene/a.prm", "set Wall speed = table wall.csv\n");
  ParameterHandler prm;
  prm.declare_entry("Wall speed", "0", patterns::TimeFunction("m/s"), "");
  BOOST_TEST(TimeFunction(prm.get("Wall speed"), "m/s").is_zero());
  prm.read_file(file);
  prm.throw_errors();
  // The absolute name also works from the output folder.
  BOOST_TEST(prm.get("Wall speed") == "table " + folder.file("scene/wall.csv"));
  BOOST_TEST(TimeFunction(prm.get("Wall speed"), "m/s")(1.) == 2.);

  prm.set_override("Wall speed = table none.csv");
  prm.set_override("Wall speed = 3 kg");
  prm.set_override("Wall speed = 30 mm/s");
  BOOST_TEST(prm.get("Wall speed") == "0.03");
  const std::string errors =
    message_of<InputError>([&prm] { prm.throw_errors(); });
  BOOST_TEST(errors.find("none.csv\" cannot be read") != std::string::npos);
  BOOST_TEST(
    errors.find("\"3 kg\" is a mass, but a velocity is needed; allowed "
                "is a formula in \"t\" giving a velocity in m/s, or "
                "\"table FILE\", or \"table FILE periodic\"") !=
    std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
