#pragma once

#include "ephyra/base/step_status.h"
#include "ephyra/linear_algebra/direct_solver.h"
#include "ephyra/linear_algebra/sparse_matrix.h"

#include <mpi.h>

#include <memory>
#include <string>
#include <vector>

namespace ephyra
{
  class ParameterHandler;
}

namespace ephyra::elasticity
{
  /// How Newton's method ended. `residual` of the base class is the last norm
  /// over the force scale of the problem; `iterations` counts linear solves.
  struct NewtonStatus : StepStatus
  {
    int                 factorizations = 0;
    std::vector<double> residuals; ///< norms relative to the scale, in order
  };

  /// A system of equations residual(x) = 0 as Newton's method sees it.
  /// Vectors are replicated, all functions collective.
  class NonlinearProblem
  {
  public:
    struct Evaluation
    {
      bool        valid = true; ///< false: x is outside of the domain
      std::string reason;       ///< where it is not valid
      double      scale = 0.;   ///< size of the terms that cancel
      double      floor = 0.;   ///< residual that is round-off anyway
    };

    virtual ~NonlinearProblem() = default;
    virtual Evaluation
    residual(const std::vector<double> &x, std::vector<double> &residual) = 0;
    virtual Evaluation
    residual_and_tangent(const std::vector<double>    &x,
                         std::vector<double>          &residual,
                         linear_algebra::SparseMatrix &tangent) = 0;
    /// The next residual_and_tangent() will be at x + correction, which is where
    /// Newton's method went from x: for problems that know a better tangent then.
    virtual void
    predict(const std::vector<double> & /*x*/,
            const std::vector<double> & /*correction*/)
    {
    }
    /// The same where Newton's method is at its starting point.
    virtual void
    predict_start()
    {
    }
    /// Completes a correction in the eliminated unknowns.
    virtual void
    complete(std::vector<double> &correction) const = 0;
  };

  /// Newton's method with a line search on the work of the residual along the
  /// correction (Matthies & Strang 1979, 10.1002/nme.1620141104) and with the
  /// factorisation kept, over iterations and calls, for as long as one
  /// iteration reduces the residual well.
  class Newton
  {
  public:
    struct Parameters
    {
      int    max_iterations = 30;
      double tolerance      = 1e-11; ///< of the residual over its scale
      bool   line_search    = true;
      /// The factorisation is kept while an iteration reduces the residual to
      /// this fraction or less; 0: a new one for every iteration.
      double reuse = 0.3;
      /// Full steps with tangents of predicted pressures first, see
      /// ElasticityOperator::predict_pressure().
      bool independent_pressure = true;

      static void
      declare(ParameterHandler &prm);
      void
      parse(ParameterHandler &prm);
    };

    /// @p what names the system in messages.
    Newton(const Parameters                      &parameters,
           const linear_algebra::SparsityPattern &pattern,
           MPI_Comm                               comm,
           const std::string                     &what);

    /// Improves x until |residual| <= tolerance * scale + floor, and by one more
    /// correction, without an evaluation, where it iterated. Where that fails
    /// the status says why and x is the last iterate.
    NewtonStatus
    solve(NonlinearProblem &problem, std::vector<double> &x);

    /// Moves x by a jump of the eliminated unknowns and by the answer of the
    /// others to it, to first order: a start for solve() that keeps elements
    /// from folding where displacements are prescribed. Returns whether x was
    /// moved.
    bool
    follow(NonlinearProblem          &problem,
           std::vector<double>       &x,
           const std::vector<double> &jump);

    /// Drops the factorisation, so that what follows does not depend on what
    /// was solved before.
    void
    forget();

  private:
    NewtonStatus
    iterate(NonlinearProblem    &problem,
            std::vector<double> &x,
            bool                 independent_pressure);
    bool
    factorize(NewtonStatus &status);
    /// correction = -(factorised matrix)^-1 r.
    void
    find_correction(const NonlinearProblem &problem);
    double
    norm(const std::vector<double> &x) const;
    double
    dot(const std::vector<double> &x, const std::vector<double> &y) const;

    Parameters                                    prm;
    MPI_Comm                                      comm;
    linear_algebra::SparseMatrix                  matrix;
    std::unique_ptr<linear_algebra::DirectSolver> solver;
    bool                                          factorized = false;
    /// With independent pressures, in a row; each doubles how many calls go
    /// without them.
    int                 failed_attempts  = 0;
    int                 attempts_to_skip = 0;
    std::vector<double> r, r_new, correction, x_new;
  };
} // namespace ephyra::elasticity
