#pragma once

#include "ephyra/base/output.h"
#include "ephyra/elasticity/elasticity_operator.h"
#include "ephyra/splines/bezier_extraction.h"
#include "ephyra/splines/nurbs_patch.h"

#include <vector>

namespace ephyra::simulation
{
  /// The deformed body as rational Bézier cells with the fields displacement,
  /// velocity, activation gamma, pattern f_a, J and Cauchy stress.
  class BodyFields
  {
  public:
    explicit BodyFields(const splines::NurbsPatch<2> &patch);

    BezierOutput
    evaluate(const elasticity::ElasticityOperator &body,
             const std::vector<double>            &displacement,
             const std::vector<double>            &velocity) const;

  private:
    const splines::BezierExtraction<2> extraction;
    std::vector<double>                reference; ///< positions, m
  };
} // namespace ephyra::simulation
