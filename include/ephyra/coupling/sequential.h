#pragma once

#include "ephyra/coupling/fluid_structure.h"

namespace ephyra::coupling
{
  /// The sequential scheme of section 3.5 of Nitti et al. 2023
  /// (10.1016/j.apm.2023.08.003): the body moves under the load of the previous
  /// step, the flow follows. It is unstable, at any time step, where the added
  /// mass of the fluid exceeds the mass of the body (Causin, Gerbeau & Nobile
  /// 2005, 10.1016/j.cma.2004.12.005), as it does for the thin flap of a bell;
  /// a load that grows without bound ends the run with that reason.
  class Sequential : public FluidStructureScheme
  {
  public:
    Sequential(fluid::FlowSolver           &flow,
               DeformableBody              &body,
               WetSurface                  &surface,
               CouplingParameters::LoadKind load_kind);

    StepStatus
    advance(double t, double dt) override;

  private:
    const CouplingParameters::LoadKind load_kind;
  };
} // namespace ephyra::coupling
