#pragma once

#include "ephyra/base/record.h"

#include <optional>
#include <string>

namespace ephyra
{
  class ParameterHandler;
}

namespace ephyra::fluid
{
  class FlowSolver;
  struct GridLine;

  /// The subsection "Moving window" of "Fluid".
  struct MovingWindowParameters
  {
    std::string           follow;   ///< name of a body; empty: no window
    std::optional<double> position; ///< of the followed point in the window,
                                    ///< fraction of its height from below;
                                    ///< none: where the body starts
    int cells = 4;                  ///< least number of cells of one shift

    bool
    on() const
    {
      return !follow.empty();
    }
    static void
    declare(ParameterHandler &prm);
    void
    parse(ParameterHandler &prm);
  };

  /// A flow domain that follows a point along y: by FlowSolver::shift_window(),
  /// as soon as the point is so many cells away from its place in the window.
  /// Where the window is follows from the flow alone, which keeps it in its
  /// state.
  class MovingWindow
  {
  public:
    /// @p y_start: the point at the start of the run (m), also after a restart.
    /// Throws InputError where the point has no place in the window.
    MovingWindow(const MovingWindowParameters &parameters,
                 FlowSolver                   &flow,
                 double                        y_start);

    /// Cells by which the window has to move for the point at @p y (m); 0 as
    /// long as it is less than the least shift away.
    int
    cells_to(double y) const;

    /// Shifts the flow after the point at @p y (m). To be called between two
    /// steps; collective.
    void
    follow(double y);

    /// Adds "window y [m]", the lower end of the window, and "window shift
    /// [cells]" since the start.
    void
    evaluate(Record &record) const;

  private:
    FlowSolver &flow;
    double      place;   ///< of the point above the lower end, m
    int         n_cells; ///< least shift
  };
} // namespace ephyra::fluid
