#pragma once

#include "ephyra/base/parameter_handler.h"
#include "ephyra/fluid/flow_solver.h"
#include "ephyra/immersed_boundary/moving_least_squares.h"
#include "ephyra/simulation/run_output.h"

#include <array>
#include <string>
#include <vector>

namespace ephyra::simulation
{
  /// Where the flow is recorded: a point (section "Flow probe NAME") or points
  /// at equal distances on a straight line (section "Flow line NAME").
  struct FlowSampling
  {
    struct Line
    {
      std::string           name;
      std::array<double, 2> start{{0., 0.}}, end{{0., 0.}}; ///< (r, y), m
      int                   intervals = 0;                  ///< 0: a probe
      bool moves = false; ///< with a moving window, else at rest

      /// Point k of 0 ... intervals at the start of the run.
      std::array<double, 2>
      point(int k) const;
    };
    std::vector<Line> probes, lines;

    static void
    declare(ParameterHandler &prm);
    void
    parse(ParameterHandler &prm);
  };

  /// Velocity and pressure at points, interpolated by moving least squares
  /// (second order). A moving window may leave a point behind, or not have come
  /// to it yet: then there is no row of the probe or line.
  class FlowProbes
  {
  public:
    /// Throws InputError where a point lies outside of the grid, or beside the
    /// window if that moves (@p window).
    FlowProbes(const FlowSampling                  &sampling,
               const immersed_boundary::Parameters &interpolation,
               const fluid::StaggeredGrid          &grid,
               bool                                 window = false);

    /// Rows of probes/NAME.csv; collective.
    void
    write_probes(double time, const fluid::FlowSolver &flow, RunOutput &output);
    /// The present values at the probes, "NAME axial velocity [m/s]";
    /// collective.
    void
    add_results(const fluid::FlowSolver &flow, Record &record);
    /// Rows of profiles/NAME_QUANTITY.csv, columns by the distance from the
    /// start of the line in m; collective.
    void
    write_lines(double time, const fluid::FlowSolver &flow, RunOutput &output);

  private:
    struct Point
    {
      immersed_boundary::Stencil v_r, v_y, p;
    };
    struct Series
    {
      FlowSampling::Line       line;
      std::vector<std::string> distances; ///< column names
      std::vector<Point>       points;    ///< none: outside of the window
    };
    void
    place(Series &series) const;
    /// Places all anew where the grid has moved.
    void
    follow_grid();
    /// v_r, v_y, p of each point.
    std::vector<double>
    evaluate(const Series &series, const fluid::FlowSolver &flow) const;

    const fluid::StaggeredGrid                 &grid;
    const immersed_boundary::MovingLeastSquares mls;
    std::vector<Series>                         probes, lines;
    int placed_at = 0; ///< shift of the grid
  };
} // namespace ephyra::simulation
