#pragma once

#include "ephyra/simulation/scene.h"

namespace ephyra::simulation
{
  /// Adds what contradicts in "Fluid/Moving window" and in what moves with it
  /// to the errors of @p prm. @p y: the axial line of the grid, or null where
  /// that is wrong itself.
  void
  check_window(const Scene           &scene,
               const fluid::GridLine *y,
               ParameterHandler      &prm);
} // namespace ephyra::simulation
