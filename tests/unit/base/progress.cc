#include "ephyra/base/progress.h"

#include <boost/test/unit_test.hpp>

#include <mpi.h>

using namespace ephyra;

BOOST_AUTO_TEST_SUITE(progress)

BOOST_AUTO_TEST_CASE(durations)
{
  BOOST_TEST(format_duration(0.4) == "0 s");
  BOOST_TEST(format_duration(99) == "99 s");
  BOOST_TEST(format_duration(100) == "2 min");
  BOOST_TEST(format_duration(59.4 * 60) == "59 min");
  BOOST_TEST(format_duration(59.9 * 60) == "1 h");
  BOOST_TEST(format_duration(3600 * 3.5) == "3 h 30 min");
  BOOST_TEST(format_duration(3600 * 53) == "2 d 5 h");
}

BOOST_AUTO_TEST_CASE(steady_progress_is_extrapolated)
{
  RemainingTime remaining;
  BOOST_TEST(remaining.seconds() < 0);
  remaining.update(1000., 0.);
  BOOST_TEST(remaining.seconds() < 0);
  for (int i = 1; i <= 10; ++i)
    {
      remaining.update(1000. + 5. * i, 0.01 * i);
      BOOST_TEST(remaining.seconds() == 500. - 5. * i,
                 boost::test_tools::tolerance(1e-10));
    }
}

BOOST_AUTO_TEST_CASE(a_slow_start_is_forgotten_and_one_slow_step_is_no_jump)
{
  RemainingTime remaining;
  remaining.update(0., 0.);
  remaining.update(50., 0.001); // setup
  double wall = 50., done = 0.001;
  for (; done < 0.5; done += 0.001)
    remaining.update(wall += 1., done);
  // 1 s for each thousandth.
  const double expected = (1. - done) * 1000;
  BOOST_TEST(remaining.seconds() == expected,
             boost::test_tools::tolerance(0.05));
  const double before = remaining.seconds();
  remaining.update(wall += 10., done += 0.001); // ten times slower
  BOOST_TEST(remaining.seconds() == before, boost::test_tools::tolerance(0.1));
}

BOOST_AUTO_TEST_CASE(lines)
{
  TimeControl::Parameters parameters;
  parameters.end_time  = 1.;
  parameters.time_step = 0.125;
  TimeControl control(parameters);
  Progress    progress(100);
  for (int i = 0; i < 2; ++i)
    {
      control.accept_step();
      progress.step(control, 0.3 - 0.1 * i, 2 + i);
    }
  std::string line = progress.line(control, MPI_Wtime() + 20.);
  // The wall time is that of this machine: 20 s and what the test took.
  BOOST_TEST(line.find("step       2  t = 0.25      s  dt = 0.125    s  "
                       "CFL 0.3     iterations 2.5   10") == 0u);
  BOOST_TEST(line.find(" s/step  remaining 2 min") != std::string::npos);
  while (!control.finished())
    control.accept_step();
  line = progress.line(control, MPI_Wtime());
  BOOST_TEST(line.substr(line.size() - 4) == "done");
  BOOST_TEST(line.find("CFL") == std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
