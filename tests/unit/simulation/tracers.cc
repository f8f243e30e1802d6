// Tracers in Hill's vortex, radius 1 and speed 1: in the frame that moves with it
//   psi = 3/4 r^2 (1 - r^2 - y^2),  v_r = 3/2 r y,  v_y = 3/2 (1 - 2 r^2 - y^2)
// inside, so that tracers go around on lines of constant psi.
#include "ephyra/simulation/tracers.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/memory_archive.h"
#include "ephyra/fluid/flow_solver.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra;
using namespace ephyra::simulation;

namespace
{
  using Point = std::array<double, 2>;

  /// Of the moving frame, or, with the vortex at `place`, of the fluid at rest.
  Point
  hill(const double r, const double y, const double frame)
  {
    return {{1.5 * r * y, 1.5 * (1 - 2 * r * r - y * y) + frame}};
  }

  double
  stream_function(const Point &x)
  {
    return 0.75 * x[0] * x[0] * (1 - x[0] * x[0] - x[1] * x[1]);
  }

  fluid::FlowParameters
  box(const int n)
  {
    fluid::FlowParameters p;
    p.density = p.viscosity = 1.;
    p.grid.r.breakpoints    = {0., 0.5, 1.};
    p.grid.r.spacings       = {1.2 / n, 0.8 / n, 1. / n};
    p.grid.y.breakpoints    = {-1., 0.1, 2.};
    p.grid.y.spacings       = {1. / n, 0.8 / n, 1.1 / n};
    p.lower.kind = p.upper.kind = p.outer.kind = fluid::SideKind::free_slip;
    return p;
  }

  /// The velocity of Hill's vortex with its centre at y = place.
  void
  set_hill(fluid::FlowSolver &flow, const double place, const double frame)
  {
    const fluid::StaggeredGrid &grid = flow.grid();
    using fluid::DistributedArray;
    for (int i = grid.first_row - (grid.is_first_rank() ? 0 : 2);
         i < grid.end_row() + 1;
         ++i)
      for (int j = -1; j < grid.y.n_cells + 1; ++j)
        {
          const auto mirrored = [](const fluid::GridLine &line, const int k) {
            return k < 0 ? 2 * line.face[0] - line.centre[0]
                   : k < line.n_cells
                     ? line.centre[k]
                     : 2 * line.face.back() - line.centre.back();
          };
          const double y          = mirrored(grid.y, j) - place;
          flow.velocity().r(i, j) = hill(grid.r.face[i], y, frame)[0];
          if (j >= 0)
            flow.velocity().y(i, j) =
              hill(mirrored(grid.r, i), grid.y.face[j] - place, frame)[1];
        }
  }

  /// The place of a tracer in the moving frame by a Runge-Kutta method of
  /// fourth order with small steps.
  Point
  exact_place(Point x, const double time)
  {
    constexpr int n  = 2000;
    const double  dt = time / n;
    for (int step = 0; step < n; ++step)
      {
        const Point a = hill(x[0], x[1], 0);
        const Point b = hill(x[0] + dt / 2 * a[0], x[1] + dt / 2 * a[1], 0);
        const Point c = hill(x[0] + dt / 2 * b[0], x[1] + dt / 2 * b[1], 0);
        const Point d = hill(x[0] + dt * c[0], x[1] + dt * c[1], 0);
        for (int k = 0; k < 2; ++k)
          x[k] += dt / 6 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]);
      }
    return x;
  }

  TracerParameters
  line(const Point &start, const Point &end, const int n)
  {
    TracerParameters p;
    p.name    = "dye";
    p.start   = start;
    p.end     = end;
    p.numbers = {{n, 1}};
    return p;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(tracers)

BOOST_AUTO_TEST_CASE(order_in_space_and_time)
{
  // In the steady field of the moving frame for more than a turn, and in that
  // of the fluid at rest, which changes with time, for half a length.
  for (const bool steady : {true, false})
    {
      const double end      = steady ? 5. : 0.5;
      double       previous = 0;
      for (const int n : {16, 32, 64})
        {
          const fluid::FlowParameters parameters = box(n);
          fluid::FlowSolver           flow(parameters, MPI_COMM_WORLD);
          const double                frame = steady ? 0. : 1.;
          set_hill(flow, 0., frame);
          Tracers dye(
            line({{0., -0.3}}, {{0.6, -0.3}}, 4), parameters, flow.velocity());
          const int    n_steps = static_cast<int>(end * n);
          const double dt      = end / n_steps;
          for (int step = 0; step < n_steps; ++step)
            {
              set_hill(flow, frame * (step + 1) * dt, frame);
              dye.advance(step * dt, dt, flow.velocity());
            }
          BOOST_REQUIRE(dye.all().size() == 4u);
          double error = 0, drift = 0;
          for (int k = 0; k < 4; ++k)
            {
              const Point start{{0.2 * k, -0.3}},
                exact = exact_place(start, end);
              Point x = dye.all()[k].x;
              x[1] -= frame * end;
              error =
                std::max(error, std::hypot(x[0] - exact[0], x[1] - exact[1]));
              drift = std::max(
                drift, std::abs(stream_function(x) - stream_function(start)));
            }
          BOOST_TEST_MESSAGE((steady ? "steady" : "moving")
                             << ", n = " << n << ": error " << error
                             << ", drift of psi " << drift << ", order "
                             << std::log2(previous / error));
          if (previous > 0)
            BOOST_TEST(std::log2(previous / error) > 1.8);
          previous = error;
          BOOST_TEST(dye.all()[0].x[0] == 0.); // the axis is not left
        }
      BOOST_TEST(previous < 3e-3);
    }
}

BOOST_AUTO_TEST_CASE(any_number_of_ranks)
{
  const fluid::FlowParameters parameters = box(16);
  fluid::FlowSolver           together(parameters, MPI_COMM_WORLD),
    alone(parameters, MPI_COMM_SELF);
  TracerParameters lattice = line({{0., -0.9}}, {{0.98, 0.9}}, 12);
  lattice.rectangle        = true;
  lattice.numbers          = {{12, 7}};
  set_hill(together, 0., 0.);
  set_hill(alone, 0., 0.);
  Tracers a(lattice, parameters, together.velocity()),
    b(lattice, parameters, alone.velocity());
  for (int step = 0; step < 100; ++step)
    {
      a.advance(0.02 * step, 0.02, together.velocity());
      b.advance(0.02 * step, 0.02, alone.velocity());
    }
  BOOST_REQUIRE(a.all().size() == b.all().size());
  BOOST_TEST(a.all().size() > 20u);
  double difference = 0;
  for (std::size_t k = 0; k < a.all().size(); ++k)
    for (int c = 0; c < 2; ++c)
      difference =
        std::max(difference, std::abs(a.all()[k].x[c] - b.all()[k].x[c]));
  BOOST_TEST(difference < 1e-12);
}

BOOST_AUTO_TEST_CASE(letting_go_leaving_and_restart)
{
  // A uniform stream through the box takes 3 s; more are let go every 1 s.
  fluid::FlowParameters parameters  = box(8);
  parameters.lower.kind             = fluid::SideKind::velocity;
  parameters.upper.kind             = fluid::SideKind::outflow;
  parameters.lower.axial_velocity   = "1";
  parameters.initial_axial_velocity = "1";
  fluid::FlowSolver flow(parameters, MPI_COMM_WORLD);
  TracerParameters  where = line({{0.2, -1.}}, {{0.8, -1.}}, 3);
  where.first             = 0.25;
  where.interval          = 1.;
  Tracers whole(where, parameters, flow.velocity()),
    resumed(where, parameters, flow.velocity());
  BOOST_TEST(whole.all().empty());
  const auto to = [&](Tracers &dye, const int from, const int end) {
    for (int step = from; step < end; ++step)
      dye.advance(0.1 * step, 0.1, flow.velocity());
  };
  to(whole, 0, 3);
  BOOST_TEST(whole.all().size() == 3u); // since t = 0.3
  to(whole, 3, 12);
  BOOST_TEST(whole.all().size() == 3u);
  BOOST_TEST(whole.all()[0].x[1] == -0.1, boost::test_tools::tolerance(1e-10));

  MemoryArchive memory;
  memory.begin_writing();
  whole.serialize(memory);
  memory.begin_reading();
  resumed.serialize(memory);
  for (Tracers *dye : {&whole, &resumed})
    {
      to(*dye, 12, 35);
      // Let go at 0.3, 1.3, 2.3 and 3.3; those of 0.3 have left at 3.3.
      BOOST_TEST(dye->all().size() == 9u);
      BOOST_TEST(dye->all()[0].number == 3.);
      BOOST_TEST(dye->all()[0].start == 1.3,
                 boost::test_tools::tolerance(1e-12));
      BOOST_TEST(dye->all()[0].x[1] == 1.2,
                 boost::test_tools::tolerance(1e-10));
      BOOST_TEST(dye->output(3.5).fields[1].values[0] == 2.2,
                 boost::test_tools::tolerance(1e-10));
    }
}

BOOST_AUTO_TEST_CASE(periodic_ends_and_walls)
{
  fluid::FlowParameters parameters;
  parameters.density = parameters.viscosity = 1.;
  parameters.grid.r.spacings                = {0.1};
  parameters.grid.y.breakpoints             = {0., 1.};
  parameters.grid.y.spacings                = {0.125};
  parameters.lower.kind = parameters.upper.kind = fluid::SideKind::periodic;
  parameters.outer.kind                         = fluid::SideKind::free_slip;
  parameters.initial_axial_velocity             = "-1";
  fluid::FlowSolver flow(parameters, MPI_COMM_WORLD);
  Tracers dye(line({{0., 0.5}}, {{1., 0.5}}, 3), parameters, flow.velocity());
  for (int step = 0; step < 20; ++step)
    dye.advance(0.1 * step, 0.1, flow.velocity());
  BOOST_REQUIRE(dye.all().size() == 3u); // two times around
  for (const Tracers::Tracer &tracer : dye.all())
    BOOST_TEST(tracer.x[1] == 0.5, boost::test_tools::tolerance(1e-10));
}

BOOST_AUTO_TEST_CASE(places_outside_of_the_grid_are_refused)
{
  const fluid::FlowParameters parameters = box(8);
  const fluid::FlowSolver     flow(parameters, MPI_COMM_WORLD);
  BOOST_CHECK_EXCEPTION(
    Tracers(line({{0., 0.}}, {{0., 2.5}}, 6), parameters, flow.velocity()),
    InputError,
    [](const InputError &error) {
      return std::string(error.what()) ==
             "The tracers 'dye' start at (r, y) = (0, 2.5) m, which is outside "
             "of the grid; move them or widen the grid.";
    });
}

BOOST_AUTO_TEST_SUITE_END()
