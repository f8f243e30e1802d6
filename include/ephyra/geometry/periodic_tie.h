#pragma once

#include "ephyra/splines/nurbs_patch.h"

#include <vector>

namespace ephyra::geometry
{
  /// For each control point of a patch the one whose unknowns it shares when
  /// the side @p slave is tied to the opposite or same-shaped side @p master:
  /// itself for all points that are not on the slave side. Fields are then
  /// periodic. Throws InputError unless both sides have the same knots and
  /// weights, and control points that differ by one axial shift.
  std::vector<int>
  tied_control_points(const splines::NurbsPatch<2> &patch,
                      splines::Side                 slave,
                      splines::Side                 master);
} // namespace ephyra::geometry
