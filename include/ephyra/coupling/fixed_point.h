#pragma once

#include "ephyra/coupling/fluid_structure.h"

namespace ephyra::coupling
{
  /// Implicit coupling by a fixed-point iteration on the load: the body moves
  /// from the old level under the load x, the flow answers from the same u*
  /// and pressure with the load H(x) at the probes, until
  ///   |H(x) - x| <= tolerance |H(x)| + absolute tolerance,
  /// the latter never below the load that strains the body by 1e-11.
  /// Carrying the flow from one iteration to the next would not converge. An
  /// iteration that does not converge is a failed step.
  class FixedPoint : public FluidStructureScheme
  {
  public:
    /// Throws InputError for a flow with several stages.
    FixedPoint(fluid::FlowSolver        &flow,
               DeformableBody           &body,
               WetSurface               &surface,
               const CouplingParameters &parameters);

    StepStatus
    advance(double t, double dt) override;
    void
    serialize(Archive &archive) override;

  private:
    /// The answer H(x); sets the status on failure.
    StepStatus
    answer(double                     t,
           double                     dt,
           const std::vector<double> &x,
           std::vector<double>       &result);

    const CouplingParameters      parameters;
    std::unique_ptr<Acceleration> acceleration;
    std::vector<double> older_load; ///< at level n - 1, for prediction
  };
} // namespace ephyra::coupling
