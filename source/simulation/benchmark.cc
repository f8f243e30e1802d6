#include "ephyra/simulation/benchmark.h"

#include "ephyra/base/mpi.h"
#include "ephyra/elasticity/elasticity_solver.h"
#include "ephyra/electrophysiology/electrophysiology_solver.h"
#include "ephyra/geometry/bell.h"
#include "ephyra/geometry/simple_curves.h"
#include "ephyra/simulation/flow_benchmark.h"

#include <array>
#include <string>
#include <vector>

namespace ephyra::simulation
{
  namespace
  {
    /// A wave that starts on a cable of 1200 control points.
    void
    tissue_case(BenchmarkReport &report, const MPI_Comm comm)
    {
      using electrophysiology::ElectrophysiologySolver;
      using electrophysiology::Placement;
      geometry::Discretization line;
      line.degree     = {{3, 3}};
      line.n_elements = {{1197, 1}};
      const auto curve =
        geometry::make_cylinder_surface(0.015, 0.02, 0., line).curve;
      const auto measure =
        [&](const std::string                         &what,
            const ElectrophysiologySolver::Parameters &parameters) {
          ElectrophysiologySolver solver(parameters, curve, comm);
          const int               n_steps = 1000;
          double                  t       = 0;
          const double            dt      = n_steps * parameters.time_step;
          const double            time    = least_time(3, comm, [&] {
            solver.advance(t, dt);
            t += dt;
          });
          report.line("nerve net, a substep, " + what,
                      time / n_steps,
                      solver.n_control_points());
        };
      ElectrophysiologySolver::Parameters parameters;
      measure("for each control point", parameters);
      parameters.sleep_tolerance = 0;
      measure("all awake", parameters);
      parameters.placement = Placement::control_coefficients;
      measure("all awake, control coefficients", parameters);
      parameters.neuron.table_interval = 0;
      measure("the same without a table", parameters);
    }

    void
    body_case(BenchmarkReport          &report,
              const int                 degree,
              const std::array<int, 2> &elements,
              const bool                muscle,
              const MPI_Comm            comm)
    {
      const std::string name = std::string(muscle ? "active " : "") + "bell, " +
                               std::to_string(elements[0]) + " x " +
                               std::to_string(elements[1]) + ", degree " +
                               std::to_string(degree) + ": ";
      const geometry::BodyPatch shape = geometry::make_bell(
        geometry::BellParameters(), 0., {{{degree, degree}}, elements});
      elasticity::ElasticityOperator::Parameters parameters;
      if (muscle)
        parameters.active_strain.form =
          elasticity::ActiveStrain::Form::unit_directors;
      elasticity::ElasticityOperator body(
        parameters, shape.patch, MPI_COMM_SELF);
      const double n       = body.n_unknowns();
      auto         pattern = body.sparsity_pattern();
      pattern.compress();
      linear_algebra::SparseMatrix matrix(
        pattern, linear_algebra::preferred_storage(pattern), MPI_COMM_SELF);
      std::vector<double> u(body.n_unknowns(), 0.), residual;
      report.line(name + "residual, for each unknown",
                  least_time(20, comm, [&] { body.residual(u, residual); }),
                  n);
      report.line(name + "residual and tangent",
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
      report.line(name + "factorisation",
                  least_time(20, comm, [&] { solver->factorize(matrix); }),
                  n);
      report.line(name + "solve",
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
    body_case(report, 3, {{35, 6}}, false, comm);
    body_case(report, 3, {{35, 6}}, true, comm);
    body_case(report, 2, {{35, 6}}, false, comm);
    body_case(report, 4, {{35, 6}}, false, comm);
    body_case(report, 3, {{80, 12}}, false, comm);
  }
} // namespace ephyra::simulation
