#pragma once

#include "ephyra/base/output.h"
#include "ephyra/simulation/body_quantities.h"
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
    evaluate(const BodyState &state) const;

  private:
    const splines::BezierExtraction<2> extraction;
    std::vector<double>                reference; ///< positions, m
  };
} // namespace ephyra::simulation
