#pragma once

#include "ephyra/base/expression.h"
#include "ephyra/electrophysiology/electrophysiology_solver.h"
#include "ephyra/splines/field_evaluation.h"

#include <array>
#include <string>
#include <vector>

namespace ephyra::simulation
{
  /// A prescribed deformation of the line of a tissue: displacements as
  /// formulas, interpolated by the splines of the line at its Greville points.
  /// Where the line at rest meets the axis it stays there.
  class TissueMotion
  {
  public:
    struct Parameters
    {
      /// Displacements, m, in s = theta^1, the reference position r, y and t.
      std::string radial = "0", axial = "0";

      /// In a subsection "Motion".
      static void
      declare(ParameterHandler &prm);
      void
      parse(ParameterHandler &prm);
    };

    /// Line and solver are referred to and must live on.
    TissueMotion(const Parameters                                 &parameters,
                 const splines::NurbsPatch<1>                     &line,
                 const electrophysiology::ElectrophysiologySolver &solver);

    /// Whether the line is deformed at all.
    bool
    moves() const;
    /// Displacement of the control points, 2 * point + component, m.
    std::vector<double>
    displacement(double t) const;
    /// Covariant metric G_11 (m^2) and radius (m) at the metric points of the
    /// solver. Throws DivergedError where the line leaves r > 0.
    void
    metric(double t, std::vector<double> &G11, std::vector<double> &r) const;

  private:
    const splines::NurbsPatch<1>                     &line;
    const electrophysiology::ElectrophysiologySolver &solver;
    std::array<Expression, 2>                         formula;
    splines::EvaluationMatrix                         at_metric_points;
  };
} // namespace ephyra::simulation
