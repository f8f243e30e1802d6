#pragma once

#include "ephyra/splines/field_evaluation.h"
#include "ephyra/splines/nurbs_patch.h"
#include "ephyra/splines/patch_quadrature.h"

#include <vector>

namespace ephyra::splines
{
  /// A fine univariate patch nested in a side of a coarse bivariate one,
  /// section 3.5 of Nitti et al. 2023 (10.1016/j.apm.2023.08.003): every
  /// element along the side is cut into n_parts, after the degree is raised
  /// where a higher one is asked for. Geometry and parametrisation are those
  /// of the side, so that fields go from one to the other by evaluation at
  /// equal theta^1, which is a sparse matrix made once.
  class NestedPatch
  {
  public:
    /// Throws InputError for a degree below that of the side.
    NestedPatch(const NurbsPatch<2> &parent,
                Side                 side,
                int                  n_parts,
                int                  degree);

    const NurbsPatch<1> &
    patch() const
    {
      return nested;
    }

    /// Fields of the parent (displacement, 2 components) and their derivative
    /// along the side, at the given parameters of the side.
    EvaluationMatrix
    parent_field(const std::vector<double> &theta) const;

    /// The same at the Gauss points of the nested patch, in the order of
    /// PatchQuadrature::point_index().
    EvaluationMatrix
    parent_field(const PatchQuadrature<1> &nested_points) const;

    /// Fields of the nested patch (activation) at the Gauss points of the
    /// parent, constant in the direction away from the side, in the order of
    /// PatchQuadrature::point_index().
    EvaluationMatrix
    nested_field(const PatchQuadrature<2> &parent_points) const;

  private:
    NurbsPatch<2> parent;
    Side          side;
    NurbsPatch<1> nested;
  };
} // namespace ephyra::splines
