#pragma once

#include "ephyra/coupling/added_mass.h"
#include "ephyra/coupling/fluid_structure.h"

namespace ephyra::coupling
{
  /// Implicit coupling by iteration. The body moves from the old level under
  /// the load g + A a, a its new acceleration; the flow answers the motion, from
  /// the same start, with the load f. The residual is f - (g + A a); g is
  /// improved by an Acceleration until
  ///   |f - (g + A a)| <= tolerance |f| + absolute tolerance,
  /// the latter never below the load that strains the body by 1e-11. Carrying
  /// the flow from one iteration to the next would not converge; an iteration
  /// that does not converge is a failed step.
  ///
  /// `fixed point`: A = 0. `added mass`: A is that of the forcing alone, as in
  /// ForcingAsLoad, which leaves pressure and the fluid inside to the iteration
  /// (`Added mass = forcing`); or it is measured by unit accelerations of
  /// the wet unknowns, which is nearly all of how the load depends on the
  /// motion, and carried along with the body (AddedMass). It is measured again
  /// where the steps since the last time have taken as many evaluations beyond
  /// two each as a measurement takes, and where a step does not converge.
  class FixedPoint : public FluidStructureScheme
  {
  public:
    /// @p with_added_mass: A is measured in the first step.
    FixedPoint(fluid::FlowSolver        &flow,
               DeformableBody           &body,
               WetSurface               &surface,
               const CouplingParameters &parameters,
               bool                      with_added_mass);

    StepStatus
    advance(double t, double dt) override;
    void
    serialize(Archive &archive) override;
    /// Null: A is not measured.
    const AddedMass *
    added_mass_operator() const
    {
      return added_mass.get();
    }

  private:
    /// Iterates from the prediction; the flow is prepared.
    StepStatus
    iterate(double t, double dt, std::vector<double> &answer);
    StepStatus
    measure_added_mass(const std::string &reason);

    const CouplingParameters      parameters;
    std::unique_ptr<Acceleration> acceleration;
    std::unique_ptr<AddedMass>    added_mass; ///< null: not measured
    bool                          with_forcing_resistance = false;
    /// At level n - 1, for prediction.
    std::vector<double> older_load, older_acceleration;
    double              older_step = 0; ///< from n - 1 to n, s
    std::int64_t        excess     = 0; ///< evaluations since measurement
  };
} // namespace ephyra::coupling
