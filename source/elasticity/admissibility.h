#pragma once

#include "ephyra/elasticity/elasticity_operator.h"
#include "ephyra/elasticity/newton.h"

#include <sstream>

namespace ephyra::elasticity::internal
{
  /// Strain below which a residual is round-off.
  constexpr double strain_floor = 1e-13;

  /// What Newton's method has to know about an evaluation of the operator.
  inline NonlinearProblem::Evaluation
  admissibility(const ElasticityOperator             &op,
                const ElasticityOperator::Evaluation &result)
  {
    NonlinearProblem::Evaluation out;
    out.valid = result.smallest_J > 0.;
    if (!out.valid)
      {
        std::ostringstream reason;
        reason << "an element folds (determinant of the elastic deformation "
               << result.smallest_J << ")";
        out.reason = reason.str();
      }
    out.scale = result.scale;
    out.floor = strain_floor * op.unit_force();
    return out;
  }
} // namespace ephyra::elasticity::internal
