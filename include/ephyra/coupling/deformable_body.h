#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/base/record.h"
#include "ephyra/base/step_status.h"
#include "ephyra/coupling/activation_source.h"
#include "ephyra/coupling/body_motion.h"
#include "ephyra/diagnostics/body_kinematics.h"
#include "ephyra/elasticity/elasticity_solver.h"

#include <memory>
#include <vector>

namespace ephyra::coupling
{
  /// A body with muscles: finite elasticity, contracted by an activation that
  /// comes from its nerve net, from a formula, or is absent. Between
  /// advance_mechanics() and accept() it knows two levels, the accepted one n
  /// and the new one n + 1; every advance starts from n, as often as asked.
  class DeformableBody
  {
  public:
    /// Starts at time 0 and at rest. @p solver_comm: the ranks that share its
    /// equations, those of @p comm, or each for itself (MPI_COMM_SELF).
    DeformableBody(const elasticity::ElasticitySolver::Parameters &parameters,
                   const splines::NurbsPatch<2>                   &patch,
                   MPI_Comm                                        solver_comm,
                   MPI_Comm                                        comm);
    /// Null: no muscle.
    void
    set_activation_source(std::unique_ptr<ActivationSource> source);

    // --- one step ---------------------------------------------------------
    /// Nerve net and muscle from t to t + dt on the accepted shape.
    StepStatus
    advance_activation(double t, double dt);
    /// Elasticity from level n at t to n + 1 under the load at n + 1.
    StepStatus
    advance_mechanics(double                           t,
                      double                           dt,
                      const elasticity::InterfaceLoad &load = {});
    /// The new level becomes the accepted one.
    void
    accept();

    // --- motion -----------------------------------------------------------
    /// At the new level.
    BodyMotion
    motion() const;
    /// From level n with its velocity and acceleration.
    BodyMotion
    extrapolated_motion(double dt) const;
    /// Newmark's velocity at n + 1 if the new acceleration vanished.
    BodyMotion
    motion_without_new_acceleration(double dt) const;
    /// Between level n (fraction 0) and n + 1 (1).
    BodyMotion
    motion_between(double fraction) const;
    /// Load of the surroundings in the last advance, N.
    const std::vector<double> &
    interface_force() const
    {
      return solver.interface_force();
    }

    // --- facts ------------------------------------------------------------
    int
    n_unknowns() const
    {
      return solver.body().n_unknowns();
    }
    double
    density() const ///< kg/m^3
    {
      return solver.body().parameters().density;
    }
    /// At the accepted level, y in m.
    double
    centre_of_mass() const;
    /// Of the centre of mass along y at the accepted level, m/s.
    double
    speed() const;
    const diagnostics::BodyKinematics &
    shape() const
    {
      return kinematics;
    }
    double
    newmark_gamma() const
    {
      return solver.coefficients().gamma;
    }
    elasticity::ElasticitySolver &
    mechanics()
    {
      return solver;
    }
    const elasticity::ElasticitySolver &
    mechanics() const
    {
      return solver;
    }
    const ActivationSource *
    activation() const
    {
      return source.get();
    }

    void
    serialize(Archive &archive);
    /// Returns the imbalance of its energy, J.
    double
    evaluate(Record &record) const;

  private:
    const MPI_Comm                    comm;
    elasticity::ElasticitySolver      solver;
    std::unique_ptr<ActivationSource> source;
    diagnostics::BodyKinematics       kinematics;
    std::vector<double>               reference; ///< positions, m
    int                               newton_iterations = 0;
  };
} // namespace ephyra::coupling
