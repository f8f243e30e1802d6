#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/electrophysiology/boundary_condition.h"
#include "ephyra/electrophysiology/monodomain_operator.h"
#include "ephyra/linear_algebra/direct_solver.h"

#include <memory>
#include <vector>

namespace ephyra::electrophysiology
{
  /// Time steps of M dv/dt = - kappa K v + L by the Crank-Nicolson method with
  /// L given, in increments d = v^{m+1} - v^m:
  ///
  ///   (M + dt/2 kappa K) d = dt (L - kappa K v^m).
  ///
  /// Where an end begins to be held, two Crank-Nicolson steps are replaced by
  /// four backward Euler steps of half the size, which damp the jump and keep
  /// the order (Rannacher 1984, Numerische Mathematik 43, 309). They have the
  /// same matrix. Its factors are kept until step size, ends or metric change.
  ///
  /// On a closed line d_0 = d_{n-1} is a constraint with a multiplier, A d =
  /// b - lambda (e_0 - e_{n-1}): the sum of the first and the last row is that
  /// of the tied system.
  class DiffusionStepper
  {
  public:
    enum class LinearSolver
    {
      narrow_band, ///< on every rank for itself
      lapack_band, ///< the same, with pivoting
      amesos2      ///< distributed assembly (Tpetra), KLU2
    };

    /// The operator is referred to, not copied. Throws InputError where an end
    /// of a closed line is to be held.
    DiffusionStepper(const MonodomainOperator            &monodomain,
                     const BoundaryCondition::Parameters &start,
                     const BoundaryCondition::Parameters &end,
                     double                               kappa,
                     LinearSolver                         linear_solver,
                     MPI_Comm                             comm);

    /// Increment of a step from t to t + dt. The step may be repeated with
    /// another load; finish_step() ends it.
    void
    solve(double                     t,
          double                     dt,
          const std::vector<double> &load,
          const std::vector<double> &v,
          std::vector<double>       &increment);
    void
    finish_step();

    /// To be called when the matrices of the operator have changed.
    void
    matrices_changed();
    std::int64_t
    n_factorizations() const
    {
      return factorizations;
    }
    /// First start or end of holding later than t, s.
    double
    next_event(double t) const;

    void
    serialize(Archive &archive);

  private:
    void
    prepare_matrix(double dt, bool hold_start, bool hold_end);
    void
    factorize();
    void
    solve_system(std::vector<double> &x);

    const MonodomainOperator        &monodomain;
    BoundaryCondition                start, end;
    double                           kappa;
    linear_algebra::NarrowBandMatrix matrix;
    linear_algebra::NarrowBandSolver system;
    /// Instead of it, where a library solves; else null.
    std::unique_ptr<linear_algebra::SparseMatrix> sparse;
    std::unique_ptr<linear_algebra::DirectSolver> direct;
    std::vector<double>                           right_hand_side;
    /// A^{-1} (e_0 - e_{n-1}) of a closed line.
    std::vector<double> seam;
    std::int64_t        factorizations = 0;
    double              factorized_dt  = 0; ///< 0: none
    bool                start_held     = false;
    bool                end_held       = false;
    std::int64_t        damped_steps   = 0; ///< still to come
    std::vector<double> part_v, part_increment;

    static constexpr int damped_steps_after_jump = 2;
  };
} // namespace ephyra::electrophysiology
