#pragma once

#include "ephyra/base/parameter_handler.h"
#include "ephyra/electrophysiology/electrophysiology_solver.h"
#include "ephyra/simulation/run_output.h"
#include "ephyra/simulation/tissue_motion.h"
#include "ephyra/splines/field_evaluation.h"

#include <string>
#include <vector>

namespace ephyra::simulation
{
  /// Where a tissue is recorded: a material point (section "Tissue probe NAME")
  /// or points at equal parametric distances (section "Tissue line NAME").
  struct TissueSampling
  {
    struct Line
    {
      std::string              name;
      double                   start = 0, end = 0; ///< theta^1
      int                      intervals = 0;      ///< 0: a probe
      std::vector<std::string> quantities;

      /// theta^1 of all points.
      std::vector<double>
      points() const;
      bool
      has(const std::string &quantity) const;
    };
    std::vector<Line> probes, lines;

    static void
    declare(ParameterHandler &prm);
    void
    parse(ParameterHandler &prm);
  };

  /// Writes what a tissue shows at the points of a TissueSampling. Currents are
  /// those of the potential, gates and conductance interpolated to the point.
  class TissueProbes
  {
  public:
    /// All are referred to and must live on. Adds crossing probes of @p level
    /// (V) to the solver for lines that ask for arrivals.
    TissueProbes(const TissueSampling                       &sampling,
                 const splines::NurbsPatch<1>               &line,
                 const TissueMotion                         &motion,
                 double                                      level,
                 electrophysiology::ElectrophysiologySolver &solver);

    /// Rows of probes/NAME.csv; collective.
    void
    write_probes(double time, RunOutput &output) const;
    /// Rows of profiles/NAME_QUANTITY.csv; the columns are named by theta^1;
    /// collective.
    void
    write_lines(double time, RunOutput &output) const;

  private:
    /// A quantity at all points of a series.
    struct Column
    {
      std::string         name; ///< with its unit
      std::string         file; ///< end of the name of a profile
      std::vector<double> values;
    };
    struct Series
    {
      TissueSampling::Line      line;
      std::vector<std::string>  names; ///< columns of a profile
      splines::EvaluationMatrix evaluation;
      std::vector<int>          crossing_probes; ///< one each, or none
    };
    void
    add_gates_or_currents(const Series        &series,
                          bool                 currents,
                          std::vector<Column> &columns) const;
    void
    add_place(const Series        &series,
              double               time,
              bool                 stretch,
              std::vector<Column> &columns) const;
    std::vector<Column>
    evaluate(const Series &series, double time) const;

    const splines::NurbsPatch<1>                     &line;
    const TissueMotion                               &motion;
    const electrophysiology::ElectrophysiologySolver &solver;
    std::vector<Series>                               probes, lines;
  };
} // namespace ephyra::simulation
