#include "ephyra/simulation/benchmark.h"

#include "ephyra/base/mpi.h"
#include "ephyra/base/timer_tree.h"
#include "ephyra/elasticity/elasticity_solver.h"
#include "ephyra/electrophysiology/electrophysiology_solver.h"
#include "ephyra/fluid/flow_solver.h"
#include "ephyra/geometry/bell.h"
#include "ephyra/geometry/simple_curves.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <limits>
#include <ostream>
#include <vector>

namespace ephyra::simulation
{
  namespace
  {
    /// Least wall time of a piece of work over some repetitions, s.
    double
    least_time(const int                    repetitions,
               const MPI_Comm               comm,
               const std::function<void()> &work)
    {
      double result = std::numeric_limits<double>::infinity();
      for (int k = 0; k < repetitions; ++k)
        {
          MPI_Barrier(comm);
          const double start = MPI_Wtime();
          work();
          result = std::min(result, mpi::max(MPI_Wtime() - start, comm));
        }
      return result;
    }

    /// Bytes per second of all ranks together.
    double
    triad_bandwidth(const MPI_Comm comm)
    {
      const std::size_t   n = 20000000 / mpi::size(comm);
      std::vector<double> a(n, 0.), b(n, 1.), c(n, 2.);
      const double        time = least_time(5, comm, [&] {
        for (std::size_t i = 0; i < n; ++i)
          a[i] = b[i] + 3. * c[i];
      });
      return 24. * static_cast<double>(n) * mpi::size(comm) / time;
    }

    class Report
    {
    public:
      Report(std::ostream &out, const double bandwidth, const MPI_Comm comm)
        : out(out)
        , bandwidth(bandwidth)
        , writes(mpi::rank(comm) == 0)
      {
      }

      void
      line(const std::string &what, const double seconds, const double unknowns)
      {
        if (writes)
          out << std::left << std::setw(50) << what << std::right << std::fixed
              << std::setprecision(1) << std::setw(12)
              << 1e9 * seconds / unknowns << std::setw(14)
              << bandwidth * seconds / unknowns << std::endl;
      }

    private:
      std::ostream &out;
      const double  bandwidth;
      const bool    writes;
    };

    void
    flow_case(Report                      &report,
              const std::string           &name,
              const fluid::FlowParameters &parameters,
              const int                    n_steps,
              const MPI_Comm               comm)
    {
      fluid::FlowSolver flow(parameters, comm);
      const double      cells =
        static_cast<double>(flow.grid().r.n_cells) * flow.grid().y.n_cells;
      flow.set_initial_velocity(
        [](const double r, const double y) {
          return std::sin(3. * r) * std::cos(2. * y);
        },
        [](const double r, const double y) {
          return std::cos(3. * r) * std::sin(2. * y);
        });
      const double dt   = 0.2 * flow.grid().y.smallest_width();
      int          step = 0;
      flow.advance(0., dt); // the first step prepares
      const auto phase = [](const std::string &path) {
        return timer().seconds(path);
      };
      const double momentum   = phase("momentum");
      const double projection = phase("projection");
      const double time       = least_time(n_steps, comm, [&] {
        ++step;
        flow.advance(step * dt, dt);
      });
      report.line(name + ", a step", time, cells);
      report.line(
        "    momentum", (phase("momentum") - momentum) / n_steps, cells);
      report.line(
        "    projection", (phase("projection") - projection) / n_steps, cells);
    }

    void
    flow_cases(Report &report, const MPI_Comm comm)
    {
      fluid::FlowParameters parameters;
      parameters.density            = 1.;
      parameters.viscosity          = 1e-5;
      parameters.grid.r.breakpoints = {0., 7.};
      parameters.grid.r.spacings    = {0.01};
      parameters.grid.y.breakpoints = {0., 46.};
      parameters.grid.y.spacings    = {0.01};
      flow_case(report, "flow 700 x 4600, rk3, uniform y", parameters, 3, comm);
      parameters.scheme = fluid::TimeScheme::ab2;
      flow_case(report, "flow 700 x 4600, ab2, uniform y", parameters, 3, comm);
      parameters.scheme             = fluid::TimeScheme::rk3;
      parameters.grid.r.spacings    = {0.02};
      parameters.grid.y.breakpoints = {0., 10., 36., 46.};
      parameters.grid.y.spacings    = {0.06, 0.035, 0.035, 0.06};
      flow_case(report, "flow, rk3, stretched y", parameters, 3, comm);
    }

    void
    tissue_case(Report &report, const MPI_Comm comm)
    {
      using electrophysiology::ElectrophysiologySolver;
      ElectrophysiologySolver::Parameters parameters;
      geometry::Discretization            line;
      line.degree     = {{3, 3}};
      line.n_elements = {{1197, 1}};
      ElectrophysiologySolver solver(
        parameters,
        geometry::make_cylinder_surface(0.015, 0.02, 0., line).curve,
        comm);
      const int    n_steps = 1000;
      double       t       = 0;
      const double dt      = n_steps * parameters.time_step;
      const double time    = least_time(3, comm, [&] {
        solver.advance(t, dt);
        t += dt;
      });
      report.line("nerve net, a substep, for each control point",
                  time / n_steps,
                  solver.n_control_points());
    }

    void
    body_case(Report &report, const MPI_Comm comm)
    {
      const geometry::BodyPatch shape = geometry::make_bell(
        geometry::BellParameters(), 0., geometry::Discretization());
      elasticity::ElasticityOperator body(
        elasticity::ElasticityOperator::Parameters(),
        shape.patch,
        MPI_COMM_SELF);
      const double n       = body.n_unknowns();
      auto         pattern = body.sparsity_pattern();
      pattern.compress();
      linear_algebra::SparseMatrix matrix(
        pattern, linear_algebra::preferred_storage(pattern), MPI_COMM_SELF);
      std::vector<double> u(body.n_unknowns(), 0.), residual;
      report.line("bell, residual, for each unknown",
                  least_time(20, comm, [&] { body.residual(u, residual); }),
                  n);
      report.line("bell, residual and tangent",
                  least_time(20,
                             comm,
                             [&] {
                               matrix.begin_assembly();
                               body.residual_and_tangent(
                                 u, residual, matrix, 1e-7, 1.);
                               matrix.finish_assembly();
                             }),
                  n);
      const auto solver =
        linear_algebra::make_direct_solver(matrix.storage(), "bell");
      report.line("bell, factorisation",
                  least_time(20, comm, [&] { solver->factorize(matrix); }),
                  n);
      report.line("bell, solve",
                  least_time(20, comm, [&] { solver->solve(residual, u); }),
                  n);
    }
  } // namespace

  void
  run_benchmark(std::ostream &out, const MPI_Comm comm)
  {
    const double bandwidth = triad_bandwidth(comm);
    if (mpi::rank(comm) == 0)
      out << "Ranks: " << mpi::size(comm)
          << "\nMemory bandwidth (triad): " << std::fixed
          << std::setprecision(1) << 1e-9 * bandwidth << " GB/s\n\n"
          << std::left << std::setw(50) << "phase" << std::right
          << std::setw(12) << "ns each" << std::setw(14) << "triad bytes"
          << std::endl;
    Report report(out, bandwidth, comm);
    flow_cases(report, comm);
    tissue_case(report, comm);
    body_case(report, comm);
  }
} // namespace ephyra::simulation
