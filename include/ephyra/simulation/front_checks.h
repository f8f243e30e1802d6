#pragma once

#include "ephyra/simulation/scene.h"

namespace ephyra::simulation
{
  /// Adds to the warnings of a scene with electrophysiology what would make its
  /// wave wrong: elements too long for the front, a step beyond the limit of
  /// the explicit currents.
  void
  check_front(Scene &scene);
} // namespace ephyra::simulation
