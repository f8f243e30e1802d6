#pragma once

#include "ephyra/simulation/scene.h"

namespace ephyra::simulation
{
  /// Checks of a parsed scene that concern several sections: is the grid
  /// possible, do the bodies lie in it, does the coupling fit body and flow.
  /// Errors go to @p prm; what is only doubtful to the warnings of the scene,
  /// among them sections that have no effect.
  void
  check_scene(Scene &scene, ParameterHandler &prm);
} // namespace ephyra::simulation
