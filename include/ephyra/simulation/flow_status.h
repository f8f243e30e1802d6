#pragma once

#include "ephyra/base/step_status.h"
#include "ephyra/fluid/flow_solver.h"

namespace ephyra::simulation
{
  /// Whether the velocity after a step of length @p dt (s) is finite and not
  /// absurd. @p cfl is the largest CFL number of the last good step and becomes
  /// that of this one. Collective.
  StepStatus
  flow_status(const fluid::FlowSolver &flow, double dt, double &cfl);
} // namespace ephyra::simulation
