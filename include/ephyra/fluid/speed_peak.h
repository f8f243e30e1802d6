#pragma once

#include "ephyra/fluid/velocity_field.h"

#include <string>

namespace ephyra::fluid
{
  /// The cell in which the flow is fastest in terms of its size, or the first
  /// one with a value that is not finite (lowest r, then lowest y).
  struct SpeedPeak
  {
    double rate = -1;        ///< |v_r|/dr + |v_y|/dy, 1/s; infinite
                             ///< where values are not finite
    int    i = 0, j = 0;     ///< the cell
    double r = 0, y = 0;     ///< its centre, m
    double v_r = 0, v_y = 0; ///< means over its faces, m/s
    double n_not_finite = 0; ///< cells with such values

    /// "(v_r, v_y) = (1, 2) m/s at (r, y) = (3, 4) m"
    std::string
    description() const;
  };

  /// Of the rows of this rank; not collective.
  SpeedPeak
  local_speed_peak(const VelocityField &velocity);

  /// The peak over all ranks, the same on any number of them; collective.
  SpeedPeak
  global_speed_peak(const SpeedPeak &local, MPI_Comm comm);
} // namespace ephyra::fluid
