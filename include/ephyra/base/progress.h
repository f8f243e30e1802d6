#pragma once

#include "ephyra/base/time_control.h"

#include <string>

namespace ephyra
{
  /// Estimates the remaining wall time of a run from its recent speed: an
  /// average that forgets within a fifth of the run so far (at least a minute),
  /// so that neither a slow start nor one slow step makes it jump.
  class RemainingTime
  {
  public:
    /// @p wall_time in s from any origin, @p progress from 0 to 1.
    void
    update(double wall_time, double progress);

    /// s; negative as long as nothing is known.
    double
    seconds() const;

  private:
    bool   started  = false;
    double first    = 0;
    double last     = 0;
    double done     = 0;
    double wall_sum = 0, progress_sum = 0; ///< fading sums of increments
  };

  /// "45 s", "12 min", "3 h 20 min", "2 d 5 h".
  std::string
  format_duration(double seconds);

  /// One line in the log for every so many steps: step, time, length of the
  /// step, largest CFL number and mean coupling iterations since the last line,
  /// wall time of a step, and remaining wall time.
  class Progress
  {
  public:
    /// @p interval steps from line to line; 0: no lines.
    explicit Progress(int interval);

    /// After each accepted step. A negative number of iterations, or CFL
    /// number, stands for none.
    void
    step(const TimeControl &control, double cfl = -1, double iterations = -1);

    /// The line for the steps since the last one; @p wall_time in s.
    std::string
    line(const TimeControl &control, double wall_time);

  private:
    const int     interval;
    RemainingTime remaining;
    bool          started        = false;
    int           n_steps        = 0; ///< since the last line
    double        cfl            = -1;
    double        iterations_sum = 0;
    bool          any_iterations = false;
    double        wall_of_last;
  };
} // namespace ephyra
