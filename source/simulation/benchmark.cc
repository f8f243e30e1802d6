#include "ephyra/simulation/benchmark.h"

#include "ephyra/base/mpi.h"
#include "ephyra/elasticity/elasticity_solver.h"
#include "ephyra/electrophysiology/electrophysiology_solver.h"
#include "ephyra/geometry/bell.h"
#include "ephyra/geometry/simple_curves.h"
#include "ephyra/simulation/flow_benchmark.h"

#include <vector>

namespace ephyra::simulation
{
  namespace
  {
    void
    tissue_case(BenchmarkReport &report, const MPI_Comm comm)
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
    body_case(BenchmarkReport &report, const MPI_Comm comm)
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
    BenchmarkReport report(out, comm);
    run_flow_benchmark(report, comm);
    report.heading("solids and nerve net");
    tissue_case(report, comm);
    body_case(report, comm);
  }
} // namespace ephyra::simulation
