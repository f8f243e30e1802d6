#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/base/parameter_handler.h"

#include <cstdint>
#include <string>

namespace ephyra
{
  /// The clock of a run: which step is next, how long it is, and when the run
  /// is over. A step that fails is repeated with half its length; after some
  /// good steps the length grows back. Adaptive lengths are time_step / 2^(k/4)
  /// with whole k, so that few of them occur: they are cut at once where the
  /// solvers ask for shorter ones, and grow by one rung of this ladder a step,
  /// with a margin.
  ///
  ///   while (!time_control.finished())
  ///     if (advance(time_control.time(), time_control.step_size()))
  ///       time_control.accept_step();
  ///     else
  ///       restore, time_control.cut_step(reason);
  class TimeControl
  {
  public:
    struct Parameters
    {
      double       end_time  = 1;    ///< s
      std::int64_t n_steps   = 0;    ///< end after so many steps; 0: no limit
      double       time_step = 1e-3; ///< s, the largest and the first
      double       smallest_time_step = 0; ///< s, 0: a thousandth of time_step
      double       growth     = 1.2;       ///< of the length, from step to step
      bool         adaptive   = false;     ///< as long as the solvers allow
      double       cfl_number = 0; ///< largest; 0: what suits the time scheme
      /// The entry of smallest_time_step, for messages.
      std::string name_of_smallest = "Smallest time step";

      /// Of the subsection that is open.
      static void
      declare(ParameterHandler &prm);
      void
      parse(ParameterHandler &prm);
    };

    explicit TimeControl(const Parameters &parameters);

    /// Whether end time or number of steps are reached.
    bool
    finished() const;
    /// Steps that are done.
    std::int64_t
    n_steps() const;
    /// Time at which the next step begins, s.
    double
    time() const;
    /// Time at which the last accepted step began, s.
    double
    previous_time() const;
    /// Length of the next step, s. The last two steps share what remains until
    /// the end time, so that none is tiny.
    double
    step_size() const;
    /// Share of the run that is done, by time or by steps, whichever is more.
    double
    progress() const;

    /// The step of step_size() is done.
    void
    accept_step();
    /// The step failed: the next try has half the length, and for some steps
    /// the length does not grow. Written to the log and counted. Throws
    /// DivergedError with the reason below the smallest time step.
    void
    cut_step(const std::string &reason);
    /// Before a step: shortens it to @p largest (s), which a solver allows at
    /// most; a larger value changes nothing, but lets adaptive steps grow.
    /// Throws DivergedError with the reason ("the flow is fast") below the
    /// smallest time step.
    void
    limit_step_size(double largest, const std::string &reason);

    /// Steps repeated so far.
    std::int64_t
    n_cuts() const;

    void
    serialize(Archive &archive);

  private:
    double
    smallest_step() const;

    Parameters parameters;
    double     length;        ///< before it is fitted to the end time
    double     last_time = 0; ///< see previous_time()
    /// time() = anchor + n * anchor_step: no sum of many rounded steps.
    double       anchor         = 0;
    double       anchor_step    = 0;
    std::int64_t n_since_anchor = 0;
    std::int64_t steps          = 0;
    std::int64_t cuts           = 0;
    std::int64_t n_until_growth = 0; ///< good steps to wait after a cut
  };

  /// When something is due that recurs every so many seconds, or steps, of a
  /// run: output, checkpoints.
  struct Interval
  {
    double       time  = 0; ///< s, 0: never
    std::int64_t steps = 0; ///< 0: never
    double       start = 0; ///< s; nothing is due before

    /// Entries "Time interval", "Step interval" and "Start time" of the
    /// subsection that is open.
    static void
    declare(ParameterHandler  &prm,
            const std::string &time_interval,
            int                step_interval);
    void
    parse(ParameterHandler &prm);

    /// Whether it is due now, after the last accepted step; also before the
    /// first step, unless it never is. Exact for steps that do not divide the
    /// interval, and indifferent to round-off. Without memory, so a resumed run
    /// gives the same answers.
    bool
    due(const TimeControl &control) const;
    /// Whether it is ever due.
    bool
    on() const
    {
      return time > 0 || steps > 0;
    }
  };
} // namespace ephyra
