#pragma once

#include "ephyra/fluid/distributed_array.h"

namespace ephyra::fluid
{
  /// The two velocity components, m/s: v_r on the faces r = r.face[i], v_y on
  /// the faces y = y.face[j].
  struct VelocityField
  {
    explicit VelocityField(const StaggeredGrid &grid)
      : r(grid)
      , y(grid)
    {
    }

    DistributedArray r, y;

    void
    copy_from(const VelocityField &other)
    {
      r.copy_from(other.r);
      y.copy_from(other.y);
    }
    const StaggeredGrid &
    grid() const
    {
      return r.grid();
    }
  };
} // namespace ephyra::fluid
