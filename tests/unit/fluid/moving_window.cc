#include "ephyra/fluid/moving_window.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/memory_archive.h"
#include "ephyra/fluid/flow_diagnostics.h"
#include "ephyra/fluid/flow_solver.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

using namespace ephyra;
using namespace ephyra::fluid;

namespace
{
  const double no_side = std::numeric_limits<double>::infinity();

  /// A vortex ring in the middle of a closed pipe, so long that its potential
  /// flow, which falls by exp(3.83 / R) over the radius R, is below round-off at
  /// the ends.
  FlowParameters
  ring(const TimeScheme scheme)
  {
    FlowParameters parameters;
    parameters.density            = 1.;
    parameters.viscosity          = 0.002;
    parameters.scheme             = scheme;
    parameters.grid.r.breakpoints = {0., 0.25};
    parameters.grid.r.spacings    = {1. / 64};
    parameters.grid.y.breakpoints = {-3., 3.};
    parameters.grid.y.spacings    = {1. / 64};
    parameters.initial_axial_velocity =
      "abs(y) < 0.25 && r < 0.2 ? cos(2*pi*y)^4*cos(2.5*pi*r)^4 : 0";
    parameters.window.follow = "ring";
    return parameters;
  }

  /// Largest difference of velocity and pressure (without its constant) at the
  /// same places, over cells that both have.
  double
  difference(const FlowSolver &a, const FlowSolver &b)
  {
    const int shift = b.grid().shift() - a.grid().shift();
    const int first = std::max(0, shift);
    const int last  = std::min(0, shift) + a.grid().y.n_cells;
    const int i0    = a.grid().first_row;
    double constant = a.pressure()(i0, first) - b.pressure()(i0, first - shift);
    mpi::broadcast(&constant, 1, a.grid().communicator());
    double largest = 0;
    for (int i = i0; i < a.grid().end_row(); ++i)
      for (int j = first; j < last; ++j)
        largest = std::max(
          {largest,
           std::abs(a.velocity().r(i, j) - b.velocity().r(i, j - shift)),
           std::abs(a.velocity().y(i, j) - b.velocity().y(i, j - shift)),
           std::abs(a.pressure()(i, j) - b.pressure()(i, j - shift) -
                    constant)});
    return mpi::max(largest, a.grid().communicator());
  }

  double
  largest_pressure(const FlowSolver &flow)
  {
    const StaggeredGrid &grid = flow.grid();
    double               low = no_side, high = -no_side;
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      for (int j = 0; j < grid.y.n_cells; ++j)
        {
          low  = std::min(low, flow.pressure()(i, j));
          high = std::max(high, flow.pressure()(i, j));
        }
    return mpi::max(high, grid.communicator()) -
           mpi::min(low, grid.communicator());
  }
} // namespace

BOOST_AUTO_TEST_SUITE(moving_window)

BOOST_AUTO_TEST_CASE(faces_do_not_drift)
{
  GridDirection r, y;
  y.breakpoints = {0.1, 0.8};
  y.spacings    = {0.007};
  StaggeredGrid grid(
    r.generate("radial"), y.generate("axial"), false, MPI_COMM_WORLD);
  const StaggeredGrid start = grid;
  for (int k = 0; k < 1000; ++k)
    grid.shift_y(3);
  for (int k = 0; k < 100; ++k)
    grid.shift_y(-7);
  BOOST_TEST(grid.shift() == 2300);
  const double distance = 2300 * (0.7 / 100);
  for (int j = 0; j <= 100; ++j)
    BOOST_TEST(grid.y.face[j] == start.y.face[j] + distance,
               boost::test_tools::tolerance(1e-15));
  // Every place in the window is in the right cell.
  for (int j = 0; j < 100; ++j)
    BOOST_TEST(grid.y.cell_of(grid.y.centre[j]) == j);
  grid.shift_y(-2300);
  BOOST_TEST(grid.y.face == start.y.face, boost::test_tools::per_element());
  BOOST_TEST(grid.y.centre == start.y.centre, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(shifts_leave_the_flow_as_it_is)
{
  for (const TimeScheme scheme : {TimeScheme::rk3, TimeScheme::ab2})
    {
      FlowSolver still(ring(scheme), MPI_COMM_WORLD);
      FlowSolver moved(ring(scheme), MPI_COMM_WORLD);
      for (int step = 0; step < 12; ++step)
        {
          if (step % 4 == 1)
            moved.shift_window(5);
          if (step % 4 == 3)
            moved.shift_window(step == 11 ? -20 : -1);
          still.advance(step * 0.01, 0.01);
          moved.advance(step * 0.01, 0.01);
          BOOST_TEST(difference(still, moved) < 1e-13);
        }
      BOOST_TEST(still.grid().shift() == 0);
      BOOST_TEST(moved.grid().shift() == -7);
      // It is no test where nothing moves.
      BOOST_TEST(still.max_cfl(0.01) > 0.1);
    }
}

BOOST_AUTO_TEST_CASE(fresh_fluid_has_the_initial_velocity)
{
  // A uniform stream: anything else in the fresh fluid would disturb it.
  FlowParameters parameters         = ring(TimeScheme::ab2);
  parameters.viscosity              = 0.;
  parameters.outer.kind             = SideKind::free_slip;
  parameters.lower.kind             = SideKind::velocity;
  parameters.upper.kind             = SideKind::velocity;
  parameters.lower.axial_velocity   = "2";
  parameters.upper.axial_velocity   = "2";
  parameters.initial_axial_velocity = "2";
  FlowSolver flow(parameters, MPI_COMM_WORLD);
  flow.advance(0., 0.001);
  for (const int shift : {17, -40, 1000})
    {
      flow.shift_window(shift);
      flow.advance(0.001, 0.001);
      for (int i = flow.grid().first_row; i < flow.grid().end_row(); ++i)
        for (int j = 0; j < flow.grid().y.n_cells; ++j)
          {
            BOOST_TEST(std::abs(flow.velocity().y(i, j) - 2.) < 1e-12);
            BOOST_TEST(std::abs(flow.velocity().r(i, j)) < 1e-12);
          }
      BOOST_TEST(largest_pressure(flow) < 1e-10);
    }
}

BOOST_AUTO_TEST_CASE(what_leaves_does_not_break_the_mass_balance)
{
  // The end moves through the ring.
  for (const SideKind kind : {SideKind::no_slip,
                              SideKind::free_slip,
                              SideKind::pressure,
                              SideKind::outflow})
    {
      FlowParameters parameters = ring(TimeScheme::rk3);
      parameters.lower.kind     = kind;
      FlowSolver flow(parameters, MPI_COMM_WORLD);
      for (int step = 0; step < 5; ++step)
        flow.advance(step * 0.01, 0.01);
      flow.shift_window(3 * 64);
      BOOST_TEST(relative_divergence(flow.velocity()) < 1e-12);
      BOOST_TEST(flow.max_cfl(0.01) > 0.01);
      flow.advance(0.05, 0.01);
      BOOST_TEST(relative_divergence(flow.velocity()) < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE(a_shift_is_no_blow)
{
  // The wall meets fluid that moves. Were this left to the next step, its
  // pressure would grow like 1 / dt.
  double pressure[2];
  for (const int k : {0, 1})
    {
      const double dt = k == 0 ? 1e-3 : 1e-5;
      FlowSolver   flow(ring(TimeScheme::ab2), MPI_COMM_WORLD);
      flow.advance(0., dt);
      flow.shift_window(3 * 64);
      flow.advance(dt, dt);
      pressure[k] = largest_pressure(flow);
    }
  BOOST_TEST(pressure[0] > 1e-3);
  BOOST_TEST(pressure[1] == pressure[0], boost::test_tools::tolerance(0.1));
}

BOOST_AUTO_TEST_CASE(restart_and_cut_back)
{
  for (const TimeScheme scheme : {TimeScheme::rk3, TimeScheme::ab2})
    {
      FlowSolver whole(ring(scheme), MPI_COMM_WORLD);
      FlowSolver resumed(ring(scheme), MPI_COMM_WORLD);
      for (int step = 0; step < 2; ++step)
        whole.advance(step * 0.01, 0.01);
      whole.shift_window(9);
      MemoryArchive memory;
      memory.begin_writing();
      whole.serialize(memory);

      memory.begin_reading();
      resumed.serialize(memory);
      BOOST_TEST(resumed.grid().shift() == 9);
      BOOST_TEST(difference(whole, resumed) == 0.);
      whole.shift_window(-2);
      whole.advance(0.02, 0.01);
      const double energy = kinetic_energy(whole.velocity(), 1.);
      resumed.shift_window(-2);
      resumed.advance(0.02, 0.01);
      BOOST_TEST(difference(whole, resumed) == 0.);

      // Back to before the step that has moved the window.
      memory.begin_reading();
      whole.serialize(memory);
      BOOST_TEST(whole.grid().shift() == 9);
      BOOST_TEST(whole.grid().y.face.front() == -3. + 9. / 64,
                 boost::test_tools::tolerance(1e-15));
      whole.shift_window(-2);
      whole.advance(0.02, 0.01);
      BOOST_TEST(kinetic_energy(whole.velocity(), 1.) == energy);
    }
}

BOOST_AUTO_TEST_CASE(any_number_of_ranks)
{
  FlowSolver shared(ring(TimeScheme::ab2), MPI_COMM_WORLD);
  FlowSolver alone(ring(TimeScheme::ab2), MPI_COMM_SELF);
  for (FlowSolver *flow : {&shared, &alone})
    for (int step = 0; step < 6; ++step)
      {
        if (step % 2 == 1)
          flow->shift_window(40);
        flow->advance(step * 0.01, 0.01);
      }
  BOOST_TEST(kinetic_energy(shared.velocity(), 1.) ==
               kinetic_energy(alone.velocity(), 1.),
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(largest_pressure(shared) == largest_pressure(alone),
             boost::test_tools::tolerance(1e-11));
}

BOOST_AUTO_TEST_CASE(formulas_on_the_outer_side_follow)
{
  // A wall that moves along y with a speed that depends on the place.
  FlowParameters parameters         = ring(TimeScheme::rk3);
  parameters.outer.kind             = SideKind::velocity;
  parameters.outer.axial_velocity   = "s";
  parameters.initial_axial_velocity = "0";
  FlowSolver flow(parameters, MPI_COMM_WORLD);
  flow.shift_window(64);
  const StaggeredGrid &grid = flow.grid();
  if (grid.is_last_rank())
    for (const int j : {0, 100, grid.y.n_cells - 1})
      BOOST_TEST(0.5 * (flow.velocity().y(grid.r.n_cells, j) +
                        flow.velocity().y(grid.r.n_cells - 1, j)) ==
                   -2. + j / 64.,
                 boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(follows_in_both_directions)
{
  FlowParameters parameters        = ring(TimeScheme::rk3);
  parameters.window.cells          = 4;
  const double                  dy = 1. / 64;
  FlowSolver                    flow(parameters, MPI_COMM_WORLD);
  const MovingWindowParameters &window = parameters.window;
  MovingWindow                  follower(window, flow, 0.5);
  const auto                    shift_after = [&](const double y) {
    follower.follow(y);
    return flow.grid().shift();
  };
  BOOST_TEST(shift_after(0.5 + 3.9 * dy) == 0);
  BOOST_TEST(shift_after(0.5 - 3.9 * dy) == 0);
  BOOST_TEST(shift_after(0.5 + 4.1 * dy) == 4);
  BOOST_TEST(shift_after(0.5 + 0.2 * dy) == 4);
  BOOST_TEST(shift_after(0.5 - 0.1 * dy) == 0);
  BOOST_TEST(shift_after(0.5 - 400.5 * dy) == -400);
  BOOST_TEST(shift_after(std::nan("")) == -400);

  // Kept at another place than that of the start.
  FlowParameters other  = ring(TimeScheme::rk3);
  other.window.position = 0.25;
  FlowSolver   other_flow(other, MPI_COMM_WORLD);
  MovingWindow quarter(other.window, other_flow, 0.);
  quarter.follow(0.);
  BOOST_TEST(other_flow.grid().shift() == 96);
}

BOOST_AUTO_TEST_CASE(contradictions_are_refused)
{
  FlowParameters parameters = ring(TimeScheme::rk3);
  FlowSolver     flow(parameters, MPI_COMM_WORLD);
  BOOST_CHECK_THROW(MovingWindow(parameters.window, flow, 2.95), InputError);
  parameters.grid.y.breakpoints = {-3., 0., 3.};
  parameters.grid.y.spacings    = {0.01, 0.02, 0.02};
  BOOST_CHECK_THROW(FlowSolver(parameters, MPI_COMM_WORLD), InputError);
  parameters            = ring(TimeScheme::rk3);
  parameters.lower.kind = parameters.upper.kind = SideKind::periodic;
  BOOST_CHECK_THROW(FlowSolver(parameters, MPI_COMM_WORLD), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
