#include "ephyra/simulation/flow_status.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace ephyra;
using simulation::FlowStatus;

namespace
{
  fluid::FlowParameters
  box()
  {
    fluid::FlowParameters parameters;
    parameters.grid.r.spacings = {1. / 16};
    parameters.grid.y.spacings = {1. / 16};
    return parameters;
  }

  /// Sets v_y on both faces of a cell.
  void
  set(fluid::FlowSolver &flow, const int i, const int j, const double value)
  {
    if (flow.grid().owns_row(i))
      flow.velocity().y(i, j) = flow.velocity().y(i, j + 1) = value;
  }

  bool
  contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(flow_status)

BOOST_AUTO_TEST_CASE(a_value_that_is_not_finite)
{
  for (const double bad :
       {std::nan(""), std::numeric_limits<double>::infinity()})
    {
      fluid::FlowSolver flow(box(), MPI_COMM_WORLD);
      FlowStatus        status;
      set(flow, 9, 3, 2.);
      set(flow, 3, 9, 2.);
      BOOST_TEST(status.check(flow, 0.01).success);
      BOOST_TEST(status.cfl() == 0.32, boost::test_tools::tolerance(1e-14));
      // Two cells on each side of a face.
      set(flow, 12, 4, bad);
      set(flow, 11, 6, bad);
      const StepStatus failed = status.check(flow, 0.01);
      BOOST_TEST(!failed.success);
      // The place is in the cell below the face; of equal speeds the lowest.
      BOOST_TEST(failed.reason ==
                 "The flow has become unstable: its velocity is not finite in "
                 "6 of 256 cells, first at (r, y) = (0.71875, 0.34375) m; in "
                 "the step before, the largest was (v_r, v_y) = (0, 2) m/s at "
                 "(r, y) = (0.21875, 0.59375) m, CFL number 0.32: run the "
                 "scene with a smaller Time/Time step.");
    }
}

BOOST_AUTO_TEST_CASE(beyond_the_limit_of_the_scheme)
{
  for (const fluid::TimeScheme scheme :
       {fluid::TimeScheme::rk3, fluid::TimeScheme::ab2})
    {
      fluid::FlowParameters parameters = box();
      parameters.scheme                = scheme;
      fluid::FlowSolver flow(parameters, MPI_COMM_WORLD);
      FlowStatus        status;
      const double      limit = flow.unstable_cfl();
      set(flow, 15, 7, 0.99 * limit / 16);
      BOOST_TEST(status.check(flow, 1.).success);
      set(flow, 15, 7, 1.01 * limit / 16);
      const std::string reason = status.check(flow, 1.).reason;
      BOOST_TEST(
        contains(reason, "at (r, y) = (0.96875, 0.46875) m has the CFL"));
      BOOST_TEST(contains(reason,
                          scheme == fluid::TimeScheme::rk3 ? ", beyond 2.8"
                                                           : ", beyond 1;"));
      // A shorter step can carry it.
      BOOST_TEST(status.check(flow, 0.5).success);

      parameters.convection = false;
      fluid::FlowSolver stokes(parameters, MPI_COMM_WORLD);
      FlowStatus        of_stokes;
      set(stokes, 2, 2, 1000.);
      BOOST_TEST(of_stokes.check(stokes, 1.).success);
    }
}

BOOST_AUTO_TEST_CASE(growth_from_step_to_step)
{
  fluid::FlowSolver flow(box(), MPI_COMM_WORLD);
  const auto steps_until_failure = [&](const auto &speed, const double dt) {
    FlowStatus status;
    for (int step = 0; step < 40; ++step)
      {
        set(flow, 5, 5, speed(step));
        const StepStatus now = status.check(flow, dt);
        if (!now.success)
          {
            BOOST_TEST(contains(now.reason, "-fold in 5 steps"));
            return step;
          }
      }
    return -1;
  };
  // Threefold each time from round-off: noticed at a tenth of a cell a step.
  const double dt = 1. / 16;
  BOOST_TEST(steps_until_failure(
               [](const int k) { return 1e-12 * std::pow(3., k); }, dt) == 24);
  // Motions that the steps resolve: sudden, and from rest by a power of time.
  BOOST_TEST(steps_until_failure([](const int k) { return k > 3 ? 1. : 1e-9; },
                                 dt) == -1);
  BOOST_TEST(
    steps_until_failure(
      [](const int k) { return std::min(1., std::pow(k / 6., 4)); }, dt) == -1);
}

BOOST_AUTO_TEST_SUITE_END()
