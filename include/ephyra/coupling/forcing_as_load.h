#pragma once

#include "ephyra/coupling/fluid_structure.h"

namespace ephyra::coupling
{
  /// The forcing itself is the load, treated implicitly: one Poisson solve a
  /// step and no iteration. The forcing is linear in the new velocity of the
  /// markers and known before the projection, F = T (B v - J u*), so that the
  /// load of the step,
  ///   f = -rho B^T D F / dt + M_f a,
  /// is linear in the new acceleration through v = v_n + dt ((1 - gamma) a_n +
  /// gamma a) and goes into the matrix of the body. M_f a is what the forcing
  /// spends on the fluid inside the body (M_f: mass matrix at the density of
  /// the fluid). Stable for bodies at least as dense as the fluid; it needs a
  /// flow with one projection a step.
  class ForcingAsLoad : public FluidStructureScheme
  {
  public:
    /// Throws InputError for a body lighter than the fluid or a flow with
    /// several stages.
    ForcingAsLoad(fluid::FlowSolver &flow,
                  DeformableBody    &body,
                  WetSurface        &surface);

    StepStatus
    advance(double t, double dt) override;
  };
} // namespace ephyra::coupling
