#pragma once

#include "ephyra/splines/field_evaluation.h"

#include <vector>

namespace ephyra::electrophysiology
{
  /// Metric of a deformed line at the points of @p at: G_11 = r'^2 + y'^2 (m^2,
  /// ' = d/d theta^1) and the distance r from the axis (m), from the positions
  /// of the control points, 2 * point + component.
  void
  line_metric(const splines::EvaluationMatrix &at,
              const std::vector<double>       &position,
              std::vector<double>             &G11,
              std::vector<double>             &r);
} // namespace ephyra::electrophysiology
