#pragma once

#include "ephyra/fluid/distributed_array.h"
#include "ephyra/immersed_boundary/markers.h"

namespace ephyra::immersed_boundary
{
  /// Axial momentum over density, m^4/s, of the fluid inside the closed surface
  /// made of the curves [first_curve, last_curve),
  ///   int v_y dV = sum_l G(r_l, y_l) n_y 2 pi r_l ds_l,
  ///   G(r, y) = int_{y_reference}^{y} v_y(r, y') dy',
  /// by the divergence theorem; second order. @p y_reference, a height inside
  /// or near the body, must lie in the grid. Collective.
  double
  interior_axial_momentum(const Markers                 &markers,
                          int                            first_curve,
                          int                            last_curve,
                          const fluid::DistributedArray &v_y,
                          double                         y_reference);
} // namespace ephyra::immersed_boundary
