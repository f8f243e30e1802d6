#pragma once

#include "ephyra/simulation/run_output.h"
#include "ephyra/splines/field_evaluation.h"
#include "ephyra/splines/nurbs_patch.h"

#include <functional>
#include <string>
#include <vector>

namespace ephyra::simulation
{
  /// Samples fields along theta^1 at equal parametric distances for the tables
  /// in profiles/; the columns are named by theta^1.
  class LineProfile
  {
  public:
    /// Along a line.
    explicit LineProfile(const splines::NurbsPatch<1> &line);
    /// Along a side of a patch, for fields of the patch.
    LineProfile(const splines::NurbsPatch<2> &patch, splines::Side side);

    /// One component of a field given by its control coefficients.
    void
    write(const std::string         &name,
          double                     time,
          const std::vector<double> &coefficients,
          int                        n_components,
          int                        component,
          RunOutput                 &output) const;

    /// Any function of theta^1 at the same places.
    static void
    write(const std::string                   &name,
          double                               time,
          const std::function<double(double)> &function,
          RunOutput                           &output);


  private:
    std::vector<double>       points;
    std::vector<std::string>  names;
    splines::EvaluationMatrix evaluation;
  };
} // namespace ephyra::simulation
