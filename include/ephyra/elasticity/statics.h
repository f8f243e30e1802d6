#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/base/time_control.h"
#include "ephyra/elasticity/elasticity_operator.h"
#include "ephyra/elasticity/energy_accounts.h"
#include "ephyra/elasticity/newton.h"

#include <functional>

namespace ephyra::elasticity
{
  /// Equilibrium of a body by load steps with automatic cut-back. The load
  /// level goes from 0 to 1; at level l the time is l * end_time, and, where
  /// `ramp` is on, all loads, prescribed displacements and the activation are
  /// multiplied by l as well.
  class StaticsSolver
  {
  public:
    struct Parameters
    {
      ElasticityOperator::Parameters body;
      Newton::Parameters             newton;
      int                            n_steps  = 1;
      double                         end_time = 1.;
      bool                           ramp     = true;
      /// Smallest increment of the level before giving up.
      double smallest_step = 1e-4;

      /// Only the entries of the subsection "Statics": body and Newton's method
      /// are those of ElasticitySolver::Parameters.
      static void
      declare(ParameterHandler &prm);
      void
      parse(ParameterHandler &prm);
      /// Times of the load steps, level * end_time, and how they are cut.
      TimeControl::Parameters
      load_steps() const;
    };

    /// How a run ended; not successful: `level` is the last converged one,
    /// which displacement() holds, and the reason says what stopped it.
    struct Result : StepStatus
    {
      double       level     = 0.;
      int          steps     = 0;
      int          cut_backs = 0;
      NewtonStatus last; ///< of the last Newton solve
    };

    /// gamma on the lines activation_points() of the operator at a time.
    using Activation =
      std::function<void(double time, std::vector<double> &gamma)>;
    /// Called after every converged level.
    using Observer = std::function<void(double level)>;

    /// Throws InputError where nothing holds the body along the axis.
    StaticsSolver(const Parameters             &parameters,
                  const splines::NurbsPatch<2> &patch,
                  MPI_Comm                      comm);

    /// All load steps, to the full load or where they end.
    Result
    run(const Activation &activation = {}, const Observer &observer = {});
    /// One load step from the last converged level to @p level, at most 1.
    /// Where it fails, that level and its equilibrium remain.
    NewtonStatus
    advance(double level, const Activation &activation = {});
    /// The last converged level.
    double
    level() const
    {
      return the_level;
    }
    /// Drops what only speeds up the next load step.
    void
    forget();
    /// The last converged level and what the next one is extrapolated from.
    void
    serialize(Archive &archive);

    const std::vector<double> &
    displacement() const
    {
      return u;
    }
    PointFields
    fields(const double theta1, const double theta2) const
    {
      return op.fields(u, op.activation(), theta1, theta2);
    }
    BodyMeasures
    measures() const
    {
      return op.measures(u, std::vector<double>(u.size(), 0.), op.activation());
    }
    /// From the unloaded body to the last converged level: trapezoidal rule
    /// over the load steps.
    const EnergyAccounts &
    energy() const
    {
      return accounts;
    }
    EnergyAccounts::Parts
    energy_parts() const;
    ElasticityOperator &
    body()
    {
      return op;
    }
    const ElasticityOperator &
    body() const
    {
      return op;
    }

  private:
    void
    set_level(double level, const Activation &activation);
    void
    predict(double            level,
            double            old_level,
            double            older_level,
            NonlinearProblem &problem);
    void
    count_work();

    Parameters          prm;
    ElasticityOperator  op;
    Newton              newton;
    std::vector<double> u, u_old, u_older;
    double              the_level = 0., older_level = 0.;
    EnergyAccounts      accounts;
    /// At the last converged level: loads and reactions (N), activation.
    std::vector<double> load, reaction, old_gamma;
  };
} // namespace ephyra::elasticity
