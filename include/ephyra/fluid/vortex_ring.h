#pragma once

#include "ephyra/fluid/flow_diagnostics.h"

#include <cstdint>

namespace ephyra::fluid
{
  /// A vortex ring: the connected set of cells around the strongest vorticity
  /// of a region in which the vorticity exceeds c, a share of that strongest
  /// one (cells are connected through their sides). A jet that trails behind
  /// belongs to it only while it is connected above that level.
  struct VortexRing
  {
    double       peak        = 0; ///< strongest vorticity, 1/s
    double       circulation = 0; ///< int omega dr dy, m^2/s
    double       impulse     = 0; ///< pi rho int omega r^2 dr dy, kg m/s
    double       r = 0, y = 0;    ///< centroid of the vorticity, m
    double       speed   = 0;     ///< along the axis, m/s
    std::int64_t n_cells = 0;     ///< 0: no vorticity of this sign
  };

  /// The ring of the given sign (positive or negative) in a region, with
  /// c = @p level times the peak, 0 < level < 1. Its speed is that of a contour
  /// omega = c that moves along y without change of shape: from
  /// d omega/dt + d(v_r omega)/dr + d(v_y omega)/dy = 0,
  ///   speed = [int (omega - c) v_y + c int (y - y_ring) v_r/r]
  ///           / int (omega - c),
  /// all over the set, without viscosity. The same on any number of ranks;
  /// collective, halo rows and ghosts must be valid.
  VortexRing
  find_vortex_ring(const VelocityField &velocity,
                   double               density,
                   const Region        &region,
                   VorticitySign        sign,
                   double               level);
} // namespace ephyra::fluid
