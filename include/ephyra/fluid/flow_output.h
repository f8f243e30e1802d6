#pragma once

#include "ephyra/base/output.h"
#include "ephyra/fluid/velocity_field.h"

namespace ephyra::fluid
{
  /// omega = d v_r/dy - d v_y/dr, 1/s, at the corner (r.face[i], y.face[j]);
  /// zero on the axis. Ghosts must be valid.
  double
  corner_vorticity(const VelocityField &velocity, int i, int j);

  /// d v_r/dy + d v_y/dr at the same corner, 1/s.
  double
  corner_shear_rate(const VelocityField &velocity, int i, int j);

  /// omega in the centre of cell (i, j): the mean of its corners.
  double
  cell_vorticity(const VelocityField &velocity, int i, int j);

  /// Sets the grid of @p output and adds velocity (x, y, z), pressure and
  /// vorticity in the centres of the owned cells.
  void
  write_flow(const VelocityField    &velocity,
             const DistributedArray &pressure,
             GridOutput             &output);
} // namespace ephyra::fluid
