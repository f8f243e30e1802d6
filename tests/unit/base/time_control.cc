#include "ephyra/base/time_control.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/log.h"
#include "ephyra/base/memory_archive.h"

#include "temporary_folder.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <vector>

using namespace ephyra;

namespace
{
  /// Cut-backs are announced in the log, but not in that of the tests.
  struct QuietLog
  {
    QuietLog()
    {
      log().initialize(MPI_COMM_WORLD, true);
    }
    ~QuietLog()
    {
      log().initialize(MPI_COMM_WORLD);
    }
  };

  TimeControl::Parameters
  parameters(const double end_time, const double time_step)
  {
    TimeControl::Parameters result;
    result.end_time  = end_time;
    result.time_step = time_step;
    return result;
  }

  std::vector<std::int64_t>
  steps_when_due(TimeControl control, const Interval &interval)
  {
    std::vector<std::int64_t> steps;
    while (true)
      {
        if (interval.due(control))
          steps.push_back(control.n_steps());
        if (control.finished())
          return steps;
        control.accept_step();
      }
  }
} // namespace

BOOST_FIXTURE_TEST_SUITE(time_control, QuietLog)

BOOST_AUTO_TEST_CASE(equal_steps_end_at_the_end_time)
{
  // 0.1 + 0.1 + ... would drift: a million steps of 1e-6 sum to 1 + 8e-12.
  TimeControl control(parameters(1., 1e-6));
  while (!control.finished())
    {
      BOOST_REQUIRE(std::abs(control.step_size() - 1e-6) < 1e-15);
      control.accept_step();
    }
  BOOST_TEST(control.n_steps() == 1000000);
  BOOST_TEST(std::abs(control.time() - 1.) < 1e-15);
}

BOOST_AUTO_TEST_CASE(the_last_two_steps_share_what_remains)
{
  TimeControl         control(parameters(1.01, 0.1));
  std::vector<double> lengths;
  for (; !control.finished(); control.accept_step())
    lengths.push_back(control.step_size());
  BOOST_REQUIRE(lengths.size() == 11u);
  BOOST_TEST(lengths[8] == 0.1);
  BOOST_TEST(lengths[9] == 0.055, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(lengths[10] == 0.055, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(control.time() == 1.01, boost::test_tools::tolerance(1e-15));

  // One step that is longer than the run.
  TimeControl single(parameters(0.5, 2.));
  BOOST_TEST(single.step_size() == 0.5);
  single.accept_step();
  BOOST_TEST(single.finished());
}

BOOST_AUTO_TEST_CASE(a_number_of_steps_ends_the_run)
{
  auto limited    = parameters(1., 0.01);
  limited.n_steps = 4;
  TimeControl control(limited);
  while (!control.finished())
    control.accept_step();
  BOOST_TEST(control.n_steps() == 4);
  BOOST_TEST(control.time() == 0.04);
  BOOST_TEST(control.previous_time() == 0.03);
  BOOST_TEST(control.progress() == 1.);
}

BOOST_AUTO_TEST_CASE(a_failed_step_is_cut_and_grows_back)
{
  TimeControl control(parameters(100., 1.));
  control.accept_step();
  control.cut_step("the flow is not finite");
  BOOST_TEST(control.time() == 1.);
  BOOST_TEST(control.step_size() == 0.5);
  control.cut_step("the flow is not finite");
  BOOST_TEST(control.step_size() == 0.25);
  BOOST_TEST(control.n_cuts() == 2);
  for (int i = 0; i < 4; ++i)
    {
      BOOST_TEST(control.step_size() == 0.25);
      control.accept_step();
    }
  BOOST_TEST(control.time() == 2.);
  BOOST_TEST(control.step_size() == 0.25);
  control.accept_step();
  BOOST_TEST(control.step_size() == 0.3, boost::test_tools::tolerance(1e-15));
  for (int i = 0; i < 20; ++i)
    control.accept_step();
  BOOST_TEST(control.step_size() == 1.);
}

BOOST_AUTO_TEST_CASE(below_the_smallest_step_the_run_ends)
{
  auto small               = parameters(1., 0.1);
  small.smallest_time_step = 0.05;
  TimeControl control(small);
  control.accept_step();
  control.cut_step("reason A");
  BOOST_TEST(
    testing::message_of<DivergedError>([&control] {
      control.cut_step("the load does not converge");
    }) == "Step 2 at time 0.1 s failed with a time step of 0.05 s, and half "
          "of it is below the Smallest time step (0.05 s): the load does not "
          "converge");
  BOOST_TEST(testing::message_of<DivergedError>([&control] {
               control.limit_step_size(0.01, "the flow is fast");
             }) ==
             "Step 2 at time 0.1 s needs a time step of 0.01 s, which is below "
             "the smallest allowed (0.05 s): the flow is fast");
  BOOST_CHECK_THROW(control.limit_step_size(std::nan(""), ""), DivergedError);
  // Where none is given it is a thousandth of the step.
  TimeControl other(parameters(1., 0.1));
  for (int i = 0; i < 9; ++i)
    other.cut_step("again");
  BOOST_CHECK_THROW(other.cut_step("again"), DivergedError);
}

BOOST_AUTO_TEST_CASE(solvers_shorten_steps)
{
  TimeControl control(parameters(100., 1.));
  control.limit_step_size(0.3, "");
  control.limit_step_size(0.5, "");
  BOOST_TEST(control.step_size() == 0.3);
  control.accept_step();
  BOOST_TEST(control.step_size() == 0.36, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(control.time() == 0.3);
  control.limit_step_size(7., "");
  BOOST_TEST(control.step_size() == 0.36, boost::test_tools::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(adaptive_steps_stay_on_a_ladder)
{
  auto adaptive     = parameters(1000., 1.);
  adaptive.adaptive = true;
  TimeControl  control(adaptive);
  const double rung = std::exp2(-0.25);
  control.limit_step_size(0.5, "");
  BOOST_TEST(control.step_size() == 0.5);
  control.accept_step();
  // No growth without a margin, however often it is asked for.
  for (const double allowed : {0.501, 0.55, 0.5 / rung, 1.04 * 0.5 / rung})
    {
      control.limit_step_size(allowed, "");
      BOOST_TEST(control.step_size() == 0.5);
      control.accept_step();
    }
  // One rung a step, whatever is allowed, up to the largest step.
  for (const int k : {3, 2, 1, 0, 0})
    {
      control.limit_step_size(100., "");
      BOOST_TEST(control.step_size() == std::pow(rung, k),
                 boost::test_tools::tolerance(1e-12));
      control.accept_step();
    }
  // Shorter at once, on the rung below.
  control.limit_step_size(0.3, "");
  BOOST_TEST(control.step_size() == std::pow(rung, 7),
             boost::test_tools::tolerance(1e-12));
  // A step that failed is on the ladder too, and does not grow at once.
  control.cut_step("x");
  control.limit_step_size(100., "");
  BOOST_TEST(control.step_size() == std::pow(rung, 11),
             boost::test_tools::tolerance(1e-12));
  // A jittering limit makes few different steps.
  std::vector<double> lengths;
  for (int k = 0; k < 200; ++k, control.accept_step())
    {
      control.limit_step_size(0.4 * (1 + 0.02 * std::sin(1.7 * k)), "");
      if (lengths.empty() || lengths.back() != control.step_size())
        lengths.push_back(control.step_size());
    }
  BOOST_TEST(lengths.size() < 9u);
  BOOST_CHECK_THROW(control.limit_step_size(1e-4, "fast"), DivergedError);
}

BOOST_AUTO_TEST_CASE(state_is_restored)
{
  TimeControl control(parameters(10., 0.1));
  control.accept_step();
  control.cut_step("x");
  control.accept_step();
  MemoryArchive memory;
  memory.begin_writing();
  control.serialize(memory);
  TimeControl resumed(parameters(10., 0.1));
  memory.begin_reading();
  resumed.serialize(memory);
  for (int i = 0; i < 30; ++i)
    {
      BOOST_TEST(resumed.time() == control.time());
      BOOST_TEST(resumed.step_size() == control.step_size());
      BOOST_TEST(resumed.previous_time() == control.previous_time());
      control.accept_step();
      resumed.accept_step();
    }
  BOOST_TEST(resumed.n_cuts() == 1);
  TimeControl finer(parameters(10., 0.01));
  memory.begin_reading();
  finer.serialize(memory);
  BOOST_TEST(finer.step_size() == 0.01);
  BOOST_TEST(resumed.n_steps() == control.n_steps());
}

BOOST_AUTO_TEST_CASE(intervals)
{
  Interval          interval;
  const TimeControl tenths(parameters(1., 0.1));
  BOOST_TEST(steps_when_due(tenths, interval).empty());
  interval.steps = 4;
  BOOST_TEST(steps_when_due(tenths, interval) ==
               (std::vector<std::int64_t>{0, 4, 8}),
             boost::test_tools::per_element());
  interval.steps = 0;
  interval.time  = 0.3; // 3 * 0.1 is larger than 0.3, by round-off
  BOOST_TEST(steps_when_due(tenths, interval) ==
               (std::vector<std::int64_t>{0, 3, 6, 9}),
             boost::test_tools::per_element());
  interval.time = 0.25;
  BOOST_TEST(steps_when_due(tenths, interval) ==
               (std::vector<std::int64_t>{0, 3, 5, 8, 10}),
             boost::test_tools::per_element());
  interval.time = 0.03; // shorter than the steps
  BOOST_TEST(steps_when_due(tenths, interval).size() == 11u);

  interval.time  = 0.25;
  interval.start = 0.5; // which is five steps of 0.1, by round-off less
  BOOST_TEST(steps_when_due(tenths, interval) ==
               (std::vector<std::int64_t>{5, 8, 10}),
             boost::test_tools::per_element());
  interval.start = 0.;

  // Every millisecond of a run of 1e5 steps: exactly 1000 times, and at the
  // start.
  interval.time = 1e-3;
  BOOST_TEST(
    steps_when_due(TimeControl(parameters(1., 1e-5)), interval).size() ==
    1001u);
}

BOOST_AUTO_TEST_CASE(entries)
{
  ParameterHandler prm;
  TimeControl::Parameters::declare(prm);
  prm.read_text("set Time step = 2 ms\nset Smallest time step = 3 ms\n",
                "a.prm");
  TimeControl::Parameters result;
  result.parse(prm);
  BOOST_TEST(result.time_step == 2e-3);
  BOOST_TEST(testing::message_of<InputError>([&prm] { prm.throw_errors(); }) ==
             "1 error in the parameters:\n  a.prm:2: Smallest time step = \"3 "
             "ms\": it exceeds the time step, 2 ms");
}

BOOST_AUTO_TEST_SUITE_END()
