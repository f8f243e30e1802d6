#pragma once

#include "ephyra/simulation/scene.h"

namespace ephyra::simulation
{
  /// What can be known of a tissue without a body before it runs: a line that
  /// cannot be made, ends that a closed line does not have, quantities that the
  /// ionic model does not have, and entries that an isolated cell ignores.
  /// Errors are added to those of @p prm, warnings to those of the scene.
  void
  check_tissue(Scene &scene, ParameterHandler &prm);
} // namespace ephyra::simulation
