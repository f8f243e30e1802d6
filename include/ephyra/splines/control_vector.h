#pragma once

#include "ephyra/splines/nurbs_patch.h"

#include <vector>

namespace ephyra::splines
{
  /// Positions of the control points of a patch, m, as fields on it are stored:
  /// x[2 * point + component], component 0 = r, 1 = y.
  template <int dim>
  std::vector<double>
  control_vector(const NurbsPatch<dim> &patch);
} // namespace ephyra::splines
