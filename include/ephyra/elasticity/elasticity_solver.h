#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/elasticity/elasticity_operator.h"
#include "ephyra/elasticity/energy_accounts.h"
#include "ephyra/elasticity/newton.h"
#include "ephyra/elasticity/step_work.h"

#include <Eigen/SparseCore>

#include <memory>

namespace ephyra::elasticity
{
  /// The load of the surroundings on a body at t^{n+1}, f = constant +
  /// (added + inertia_ratio M) a^{n+1}: forces on the unknowns over the full
  /// revolution, N.
  struct InterfaceLoad
  {
    /// 2 * point + component; empty: none.
    std::vector<double> constant;
    /// Minus the added mass, kg; only rows and columns of the wet surface.
    const Eigen::SparseMatrix<double, Eigen::RowMajor> *added = nullptr;
    /// Of the mass of the surroundings that moves with the body to its own.
    double inertia_ratio = 0.;
    /// The load acts with its value at n + 1 instead of being weighted to
    /// n + alpha_f, eq. (65), in which the load at n takes part. A load that
    /// depends strongly on the new motion must: weighted, it alternates in sign
    /// from step to step and grows. First order in time.
    bool at_new_level = false;
  };

  /// Motion of a body by the generalised-alpha method, eqs. (59)-(65) of Nitti
  /// et al. 2023 (10.1016/j.apm.2023.08.003):
  ///   M a^alpha + F_int(u^alpha) = F_ext(u^alpha, t^alpha) + f^alpha
  /// with u, a, the activation and the load of the surroundings f weighted
  /// between t^n and t^{n+1}, the own loads of the body at t^alpha. Newton's
  /// method solves for a^{n+1}, starting from the acceleration at n and, for
  /// rho_infinity < 1, its trend.
  ///
  /// advance() goes from the level n to n+1 and may be called any number of
  /// times with other loads, activations and time steps: level n is kept until
  /// accept().
  class ElasticitySolver
  {
  public:
    struct Parameters
    {
      ElasticityOperator::Parameters body;
      Newton::Parameters             newton;
      double                         rho_infinity = 0.5;
      bool chosen_rho_infinity = true; ///< not by the parameter file
      /// An advance that repeats a step starts from its last result.
      bool warm_start = true;

      static void
      declare(ParameterHandler &prm);
      void
      parse(ParameterHandler &prm);
    };

    ElasticitySolver(const Parameters             &parameters,
                     const splines::NurbsPatch<2> &patch,
                     MPI_Comm                      comm);
    ~ElasticitySolver();

    /// Unknowns that InterfaceLoad::added may couple with each other; call
    /// before the first step where it is used. Entries elsewhere still act, but
    /// the tangent does not see them.
    void
    allow_coupling(linear_algebra::SparsityPattern pattern);

    /// Starts at time t (s; the first advance() does it at rest otherwise) from a displacement and a velocity (m, m/s; empty:
    /// zero) with the acceleration that balances the forces there.
    void
    initialize(double                     t,
               const std::vector<double> &displacement = {},
               const std::vector<double> &velocity     = {});

    /// gamma at t^{n+1} on the lines activation_points() of the operator.
    void
    set_activation(const std::vector<double> &gamma);

    /// From t^n = t to t + dt. Level n stays as it is; where the status is a
    /// failure, level n+1 is of no use.
    NewtonStatus
    advance(double t, double dt, const InterfaceLoad &load = {});
    /// Makes level n+1 the new level n and adds the work of the step to the
    /// accounts; collective.
    void
    accept();

    /// Level n+1 (equal to n after accept() and initialize()), replicated.
    const std::vector<double> &
    displacement() const
    {
      return next.u;
    }
    const std::vector<double> &
    velocity() const
    {
      return next.v;
    }
    const std::vector<double> &
    acceleration() const
    {
      return next.a;
    }
    /// Level n.
    const std::vector<double> &
    old_displacement() const
    {
      return level.u;
    }
    const std::vector<double> &
    old_velocity() const
    {
      return level.v;
    }
    const std::vector<double> &
    old_acceleration() const
    {
      return level.a;
    }
    /// The load of the surroundings in the last advance, N.
    const std::vector<double> &
    interface_force() const
    {
      return next.f;
    }

    BodyMeasures
    measures() const
    {
      return op->measures(next.u, next.v, next.gamma);
    }
    PointFields
    fields(const double theta1, const double theta2) const
    {
      return op->fields(next.u, next.gamma, theta1, theta2);
    }
    /// Work done in the last advance, J: by the pressures, tractions and body
    /// forces of the body (midpoint rule), by the surroundings (trapezoidal
    /// rule).
    double
    load_work();
    double
    interface_work() const;
    /// Work done by the muscle in the last advance, J.
    double
    muscle_work() const
    {
      return op->muscle_work(level.u, level.gamma, next.u, next.gamma);
    }
    /// Since the start, at the accepted level.
    const EnergyAccounts &
    energy() const
    {
      return accounts;
    }
    /// The parts of the accounts that the body has.
    EnergyAccounts::Parts
    energy_parts() const;
    ElasticityOperator &
    body()
    {
      return *op;
    }
    const ElasticityOperator &
    body() const
    {
      return *op;
    }
    const GeneralizedAlpha &
    coefficients() const
    {
      return alpha;
    }

    /// Drops what speeds up the solves (kept factorisation, starting points),
    /// so that a run and its restart continue alike.
    void
    forget();
    /// Both levels become those of the first rank: for a body that every rank
    /// of @p ranks computes for itself; collective.
    void
    synchronize(MPI_Comm ranks);
    /// Level n, which level n+1 becomes as well when reading.
    void
    serialize(Archive &archive);

  private:
    struct Level
    {
      std::vector<double> u, v, a;
      std::vector<double> f;     ///< load of the surroundings, N
      std::vector<double> gamma; ///< activation
    };
    class Problem;

    /// u, v of level n+1 from its acceleration, eqs. (61), (62).
    void
    newmark(double dt);
    void
    make_newton();
    void
    count_work();

    Parameters                          prm;
    GeneralizedAlpha                    alpha;
    std::unique_ptr<ElasticityOperator> op;
    linear_algebra::SparsityPattern     coupling; ///< by InterfaceLoad::added
    linear_algebra::SparsityPattern     pattern;  ///< of the tangent
    std::unique_ptr<Newton>             newton;
    Level                               level, next;
    double                              last_t   = 0.; ///< of the last advance
    double                              last_dt  = 0.;
    bool                                started  = false;
    bool                                repeated = false;
    EnergyAccounts                      accounts;
    StepWork                            step_work;
    std::vector<double>                 reaction; ///< at t^alpha, N
    /// At level n-1, empty where unknown.
    std::vector<double> older_acceleration;
    bool                at_new_level = false; ///< last load
    bool                counted      = true;  ///< last step
  };
} // namespace ephyra::elasticity
