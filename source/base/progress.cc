#include "ephyra/base/progress.h"

#include "ephyra/base/log.h"

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace ephyra
{
  void
  RemainingTime::update(const double wall_time, const double progress)
  {
    if (started)
      {
        const double memory = std::max(60., 0.2 * (wall_time - first));
        const double fading = std::exp(-(wall_time - last) / memory);
        wall_sum            = fading * wall_sum + (wall_time - last);
        progress_sum        = fading * progress_sum + (progress - done);
      }
    else
      first = wall_time;
    started = true;
    last    = wall_time;
    done    = progress;
  }

  double
  RemainingTime::seconds() const
  {
    return progress_sum > 0 ? (1 - done) * wall_sum / progress_sum : -1.;
  }

  std::string
  format_duration(const double seconds)
  {
    const auto text = [](const long  large,
                         const char *large_unit,
                         const long  small,
                         const char *small_unit) {
      return std::to_string(large) + large_unit +
             (small > 0 ? " " + std::to_string(small) + small_unit : "");
    };
    const long s = std::lround(std::min(seconds, 1e15));
    if (s < 100)
      return std::to_string(s) + " s";
    const long minutes = std::lround(static_cast<double>(s) / 60);
    if (minutes < 60)
      return std::to_string(minutes) + " min";
    if (minutes < 24 * 60)
      return text(minutes / 60, " h", minutes % 60, " min");
    const long hours = std::lround(static_cast<double>(minutes) / 60);
    return text(hours / 24, " d", hours % 24, " h");
  }

  Progress::Progress(const int interval)
    : interval(interval)
    , wall_of_last(MPI_Wtime())
  {
  }

  void
  Progress::step(const TimeControl &control,
                 const double       step_cfl,
                 const double       iterations)
  {
    if (interval == 0)
      return;
    // A resumed run does not begin at zero: measure from the first step on.
    if (!started)
      remaining.update(MPI_Wtime(), control.progress());
    started = true;
    ++n_steps;
    cfl = std::max(cfl, step_cfl);
    if (iterations >= 0)
      {
        any_iterations = true;
        iterations_sum += iterations;
      }
    if (n_steps >= interval || control.finished())
      log().line(line(control, MPI_Wtime()));
  }

  std::string
  Progress::line(const TimeControl &control, const double wall_time)
  {
    remaining.update(wall_time, control.progress());
    std::ostringstream text;
    text << "step " << std::setw(7) << control.n_steps()
         << "  t = " << std::setprecision(6) << std::left << std::setw(9)
         << control.time() << " s  dt = " << std::setprecision(3)
         << std::setw(8) << control.time() - control.previous_time() << " s";
    if (cfl >= 0)
      text << "  CFL " << std::setprecision(2) << std::setw(6) << cfl;
    if (any_iterations)
      text << "  iterations " << std::setprecision(2) << std::setw(4)
           << iterations_sum / n_steps;
    if (n_steps > 0)
      text << "  " << std::setprecision(3) << std::setw(6)
           << (wall_time - wall_of_last) / n_steps << " s/step";
    if (control.finished())
      text << "  done";
    else if (remaining.seconds() >= 0)
      text << "  remaining " << format_duration(remaining.seconds());
    n_steps        = 0;
    cfl            = -1;
    iterations_sum = 0;
    any_iterations = false;
    wall_of_last   = wall_time;
    return text.str();
  }
} // namespace ephyra
