#include "ephyra/simulation/flow_benchmark.h"

#include "ephyra/base/mpi.h"
#include "ephyra/base/timer_tree.h"
#include "ephyra/immersed_boundary/rigid_flow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace ephyra::simulation
{
  namespace
  {
    using fluid::FlowParameters;

    /// 700 x 4600 square cells of 0.01.
    FlowParameters
    large_flow()
    {
      FlowParameters p;
      p.density            = 1.;
      p.viscosity          = 1e-5;
      p.grid.r.breakpoints = {0., 7.};
      p.grid.r.spacings    = {0.01};
      p.grid.y.breakpoints = {0., 46.};
      p.grid.y.spacings    = {0.01};
      return p;
    }

    /// A swirl-free field without a body; a fixed sphere of this radius in it.
    void
    flow_case(BenchmarkReport      &report,
              const std::string    &name,
              const FlowParameters &parameters,
              const int             n_steps,
              const MPI_Comm        comm,
              const double          sphere_radius = 0)
    {
      fluid::FlowSolver flow(parameters, comm);
      flow.keep_predicted(false);
      const fluid::StaggeredGrid &grid = flow.grid();
      const double cells = static_cast<double>(grid.r.n_cells) * grid.y.n_cells;
      flow.set_initial_velocity(
        [](const double r, const double y) {
          return std::sin(3. * r) * std::cos(2. * y);
        },
        [](const double r, const double y) {
          return std::cos(3. * r) * std::sin(2. * y);
        });
      std::unique_ptr<immersed_boundary::RigidFlow> rigid;
      if (sphere_radius > 0)
        {
          immersed_boundary::RigidBody::Parameters sphere;
          sphere.radius   = sphere_radius;
          sphere.position = grid.y.face.front() + 0.3 * grid.y.length();
          std::vector<std::unique_ptr<immersed_boundary::RigidBody>> bodies;
          bodies.push_back(
            std::make_unique<immersed_boundary::RigidBody>(sphere));
          rigid = std::make_unique<immersed_boundary::RigidFlow>(
            flow, std::move(bodies), immersed_boundary::Parameters());
        }

      const double dt   = 0.2 * grid.y.smallest_width();
      double       time = 0;
      const auto   step = [&] {
        if (rigid != nullptr)
          rigid->advance(time, dt);
        else
          flow.advance(time, dt);
        time += dt;
      };
      step(); // the first one prepares
      double least    = std::numeric_limits<double>::infinity();
      double momentum = least, projection = least;
      for (int k = 0; k < n_steps; ++k)
        {
          const double before_momentum   = timer().seconds("momentum");
          const double before_projection = timer().seconds("projection");
          least = std::min(least, least_time(1, comm, step));
          momentum =
            std::min(momentum, timer().seconds("momentum") - before_momentum);
          projection = std::min(
            projection, timer().seconds("projection") - before_projection);
        }
      report.line(name + ": a step", least, cells);
      report.line("    momentum", momentum, cells);
      report.line(
        "    projection (" + flow.poisson().name() + ")", projection, cells);
      if (rigid != nullptr)
        report.line("    " + std::to_string(rigid->markers().size()) +
                      " markers and others",
                    std::max(0., least - momentum - projection),
                    cells);
    }
  } // namespace

  void
  run_flow_benchmark(BenchmarkReport &report, const MPI_Comm comm)
  {
    const std::string size = "700 x 4600";
    report.heading("flow, for each cell");
    FlowParameters p = large_flow();
    flow_case(report, size + ", rk3", p, 3, comm);
    flow_case(report, size + ", rk3, sphere", p, 3, comm, 2.);
    p.scheme = fluid::TimeScheme::ab2;
    flow_case(report, size + ", ab2", p, 3, comm);
    p.scheme  = fluid::TimeScheme::rk3;
    p.viscous = fluid::ViscousTreatment::implicit;
    flow_case(report, size + ", rk3, implicit viscosity", p, 2, comm);

    p                    = large_flow();
    p.grid.y.breakpoints = {0., 11.5, 41.5, 53.};
    p.grid.y.spacings    = {0.02, 0.01, 0.01, 0.02};
    flow_case(report, "stretched ends in y, rk3", p, 2, comm);
    p.poisson = fluid::PoissonKind::eigen;
    flow_case(report, "the same, eigenvectors alone", p, 1, comm);

    p                    = large_flow();
    p.grid.r.breakpoints = {0., 1.2};
    p.grid.y.breakpoints = {0., 3.2};
    flow_case(report, "120 x 320 (in cache), rk3", p, 50, comm);
  }
} // namespace ephyra::simulation
