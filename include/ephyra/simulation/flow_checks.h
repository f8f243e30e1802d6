#pragma once

#include "ephyra/simulation/scene.h"

namespace ephyra::simulation
{
  /// What can be known of a flow before it runs: sides that contradict each
  /// other, velocities given on all sides that do not balance at some time, time
  /// steps beyond the limits. Errors are added to those of @p prm, warnings to
  /// those of the scene.
  void
  check_flow(Scene                 &scene,
             const fluid::GridLine &r,
             const fluid::GridLine &y,
             ParameterHandler      &prm);

  /// The same for rigid bodies: too small for the cells, overlapping, lighter
  /// than their way of motion allows, faster than the time step allows.
  void
  check_rigid_bodies(Scene                 &scene,
                     const fluid::GridLine &r,
                     const fluid::GridLine &y,
                     ParameterHandler      &prm);
} // namespace ephyra::simulation
