#include "ephyra/elasticity/newton.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"
#include "ephyra/base/parameter_handler.h"
#include "ephyra/base/timer_tree.h"

#include <algorithm>
#include <cmath>

namespace ephyra::elasticity
{
  void
  Newton::Parameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("Newton iterations",
                      "30",
                      patterns::Integer(1),
                      "Most iterations of Newton's method in one step.");
    prm.declare_entry("Newton tolerance",
                      "1e-11",
                      patterns::Double("", 1e-14, 1e-2),
                      "Residual over the sum of the absolute element forces "
                      "at which Newton's method has converged.");
    prm.declare_entry("Line search",
                      "true",
                      patterns::Bool(),
                      "Shortens corrections that overshoot.");
    prm.declare_entry("Factorisation reuse",
                      "0.3",
                      patterns::Double("", 0., 0.9),
                      "The factorised matrix is kept, also over time steps, "
                      "while an iteration reduces the residual to this "
                      "fraction or less; 0 factorises in every iteration.");
    prm.declare_entry("Independent pressure",
                      "true",
                      patterns::Bool(),
                      "Newton's method first treats the pressure at each Gauss "
                      "point as an unknown of its own: the same solution in as "
                      "many iterations for any K; where that does not "
                      "converge, as without.");
  }

  void
  Newton::Parameters::parse(ParameterHandler &prm)
  {
    max_iterations       = prm.get_integer("Newton iterations");
    tolerance            = prm.get_double("Newton tolerance");
    line_search          = prm.get_bool("Line search");
    reuse                = prm.get_double("Factorisation reuse");
    independent_pressure = prm.get_bool("Independent pressure");
  }

  Newton::Newton(const Parameters                      &parameters,
                 const linear_algebra::SparsityPattern &pattern,
                 const MPI_Comm                         comm,
                 const std::string                     &what)
    : prm(parameters)
    , comm(comm)
    , matrix(pattern, linear_algebra::preferred_storage(pattern), comm)
    , solver(linear_algebra::make_direct_solver(matrix.storage(), what))
  {
  }

  void
  Newton::forget()
  {
    factorized       = false;
    failed_attempts  = 0;
    attempts_to_skip = 0;
  }

  double
  Newton::dot(const std::vector<double> &x, const std::vector<double> &y) const
  {
    double sum = 0.;
    for (std::size_t i = 0; i < x.size(); ++i)
      sum += x[i] * y[i];
    // One value for all ranks: what follows from it is decided alike.
    mpi::broadcast(&sum, 1, comm);
    return sum;
  }

  double
  Newton::norm(const std::vector<double> &x) const
  {
    return std::sqrt(dot(x, x));
  }

  bool
  Newton::factorize(NewtonStatus &status)
  {
    const TimerTree::Scope scope(timer(), "factorise", matrix.n_rows());
    try
      {
        solver->factorize(matrix);
      }
    catch (const DivergedError &error)
      {
        status.success = false;
        status.reason  = error.what();
        factorized     = false;
        return false;
      }
    ++status.factorizations;
    factorized = true;
    return true;
  }

  void
  Newton::find_correction(const NonlinearProblem &problem)
  {
    const TimerTree::Scope scope(timer(), "solve", matrix.n_rows());
    solver->solve(r, correction);
    for (double &c : correction)
      c = -c;
    problem.complete(correction);
  }

  bool
  Newton::follow(NonlinearProblem          &problem,
                 std::vector<double>       &x,
                 const std::vector<double> &jump)
  {
    const double h = 1e-6;
    matrix.begin_assembly();
    const auto here = problem.residual_and_tangent(x, r, matrix);
    matrix.finish_assembly();
    x_new = x;
    for (std::size_t i = 0; i < x.size(); ++i)
      x_new[i] += h * jump[i];
    const auto   there = problem.residual(x_new, r_new);
    NewtonStatus status;
    if (!here.valid || !there.valid || !factorize(status))
      return false;
    for (std::size_t i = 0; i < x.size(); ++i)
      r[i] += (r_new[i] - r[i]) / h;
    solver->solve(r, correction);
    for (double &c : correction)
      c = -c;
    problem.complete(correction);
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] += correction[i] + jump[i];
    return true;
  }

  NewtonStatus
  Newton::solve(NonlinearProblem &problem, std::vector<double> &x)
  {
    if (!prm.independent_pressure || attempts_to_skip > 0)
      {
        attempts_to_skip = std::max(0, attempts_to_skip - 1);
        return iterate(problem, x, false);
      }
    const std::vector<double> start = x;
    const NewtonStatus        first = iterate(problem, x, true);
    if (first.success)
      {
        failed_attempts = 0;
        return first;
      }
    ++failed_attempts;
    attempts_to_skip    = (1 << std::min(failed_attempts, 5)) - 1;
    x                   = start;
    NewtonStatus status = iterate(problem, x, false);
    status.iterations += first.iterations;
    status.factorizations += first.factorizations;
    return status;
  }

  NewtonStatus
  Newton::iterate(NonlinearProblem    &problem,
                  std::vector<double> &x,
                  const bool           independent_pressure)
  {
    NewtonStatus status;
    // Full steps either converge soon, or do not.
    const int most_iterations =
      independent_pressure ? (prm.max_iterations + 1) / 2 : prm.max_iterations;
    const bool line_search = prm.line_search && !independent_pressure;
    bool       moved       = false; // by the correction, from x_new to x
    const auto assemble    = [&](std::vector<double> &residual) {
      const TimerTree::Scope scope(timer(), "tangent", matrix.n_rows());
      if (independent_pressure && moved)
        problem.predict(x_new, correction);
      else if (independent_pressure)
        problem.predict_start();
      matrix.begin_assembly();
      const auto evaluation = problem.residual_and_tangent(x, residual, matrix);
      matrix.finish_assembly();
      return evaluation;
    };
    const auto evaluate = [&](const std::vector<double> &at,
                              std::vector<double>       &residual) {
      const TimerTree::Scope scope(timer(), "residual", matrix.n_rows());
      return problem.residual(at, residual);
    };
    const auto fail = [&](const std::string &reason) {
      status.success = false;
      status.reason  = reason;
      factorized     = false;
      return status;
    };

    bool assembled  = !factorized; // matrix belongs to x, not yet factorised
    auto evaluation = assembled ? assemble(r) : evaluate(x, r);
    if (!evaluation.valid)
      return fail("the starting point of Newton's method is not admissible: " +
                  evaluation.reason);
    double size = norm(r);
    for (;;)
      {
        const double scale = evaluation.scale + evaluation.floor;
        status.residual    = scale > 0. ? size / scale : size;
        status.residuals.push_back(status.residual);
        if (!std::isfinite(size))
          return fail("the residual of Newton's method is not finite");
        if (size <= prm.tolerance * evaluation.scale + evaluation.floor)
          {
            // What is left follows from the residual that is known anyway.
            // Without it round-off that decides between two iterations would
            // move x by as much as the tolerance allows.
            if (status.iterations > 0)
              {
                find_correction(problem);
                for (std::size_t i = 0; i < x.size(); ++i)
                  x[i] += correction[i];
              }
            return status;
          }
        if (status.iterations == most_iterations)
          {
            std::ostringstream reason;
            reason << "Newton's method did not converge in " << most_iterations
                   << " iterations: relative residual " << status.residual
                   << ", wanted " << prm.tolerance;
            return fail(reason.str());
          }

        const bool fresh = assembled || !factorized;
        if (fresh)
          {
            if (!assembled)
              assemble(r);
            assembled = false;
            if (!factorize(status))
              return status;
          }
        ++status.iterations;
        find_correction(problem);

        // Along the correction the work of the residual has to fall.
        const double work     = dot(correction, r);
        double       step     = 1.;
        double       size_new = 0.;
        auto         trial    = evaluation;
        bool         accepted = false;
        for (int attempt = 0; attempt < 12 && !accepted; ++attempt)
          {
            x_new = x;
            for (std::size_t i = 0; i < x.size(); ++i)
              x_new[i] += step * correction[i];
            trial    = evaluate(x_new, r_new);
            size_new = trial.valid ? norm(r_new) : 0.;
            if (!trial.valid || !std::isfinite(size_new))
              {
                if (!fresh)
                  break;
                trial.valid = false;
                step *= 0.5;
                continue;
              }
            const double work_new = dot(correction, r_new);
            accepted              = size_new < size || !line_search ||
                       std::abs(work_new) <= 0.8 * std::abs(work) ||
                       attempt >= 5;
            if (!accepted && !fresh)
              break;
            if (!accepted)
              {
                const double ratio = work / (work - work_new);
                step *= std::isfinite(ratio) && ratio > 0.
                          ? std::clamp(ratio, 0.1, 0.7)
                          : 0.5;
              }
          }
        if (!accepted && fresh)
          return fail("Newton's method finds no admissible step: " +
                      trial.reason);
        if (!accepted || (!fresh && size_new > size))
          {
            // The old matrix misleads: try again from here with a new one.
            factorized = false;
            moved      = false;
            continue;
          }
        if (size_new > prm.reuse * size)
          factorized = false;
        for (double &c : correction)
          c *= step;
        moved = true;
        x.swap(x_new);
        r.swap(r_new);
        evaluation = trial;
        size       = size_new;
      }
  }
} // namespace ephyra::elasticity
