#pragma once

#include "ephyra/fluid/velocity_field.h"

#include <array>
#include <vector>

namespace ephyra::fluid
{
  /// Velocities (v_r, v_y) at points (r, y) in the domain, m/s. Each component
  /// is bilinear between its own nodes: second order, continuous, with the
  /// boundary values on the boundary, so that v_r = 0 on the axis and no flow
  /// goes through walls. A point is evaluated by the rank that holds its row:
  /// the same on any number of ranks. Points beyond the domain take the values
  /// of its end. Collective; halo rows and ghosts must be valid.
  std::vector<std::array<double, 2>>
  local_velocities(const VelocityField                      &velocity,
                   const std::vector<std::array<double, 2>> &points);
} // namespace ephyra::fluid
