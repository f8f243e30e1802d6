#pragma once

#include "ephyra/simulation/body_quantities.h"
#include "ephyra/simulation/run_output.h"
#include "ephyra/splines/nurbs_patch.h"

#include <array>
#include <string>
#include <vector>

namespace ephyra::simulation
{
  /// Material points of a body that are followed: one (section "Body probe
  /// NAME"), or points at equal parametric distances on a straight line in
  /// theta^1, theta^2, such as a side (section "Body line NAME").
  struct BodySampling
  {
    struct Line
    {
      std::string              name;
      std::array<double, 2>    start{{0., 0.}}, end{{0., 0.}}; ///< theta
      int                      intervals = 0;                  ///< 0: a probe
      std::vector<std::string> quantities; ///< groups, see body_quantities.h

      /// theta of point k of 0 ... intervals.
      std::array<double, 2>
      point(int k) const;
    };
    std::vector<Line> probes, lines;

    static void
    declare(ParameterHandler &prm);
    void
    parse(ParameterHandler &prm);
  };

  /// Writes what a body shows at the points of a BodySampling.
  class BodyProbes
  {
  public:
    BodyProbes(const BodySampling           &sampling,
               const splines::NurbsPatch<2> &patch);

    /// Rows of probes/NAME.csv, one column for each quantity; collective.
    void
    write_probes(double time, const BodyState &state, RunOutput &output) const;
    /// Rows of profiles/NAME_QUANTITY.csv; the columns are named by the share
    /// of the way from the start to the end of the line; collective.
    void
    write_lines(double time, const BodyState &state, RunOutput &output) const;

  private:
    struct Point
    {
      std::array<double, 2>   theta;
      splines::Point          rest; ///< m
      splines::BasisValues<2> basis;
    };
    struct Series
    {
      std::string               name;
      std::vector<BodyQuantity> quantities;
      std::vector<std::string>  columns; ///< of a line
      std::vector<Point>        points;
    };
    static std::vector<double>
    evaluate(const Point &point, const BodyState &state);

    std::vector<Series> probes, lines;
  };
} // namespace ephyra::simulation
