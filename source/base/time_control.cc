#include "ephyra/base/time_control.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/log.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ephyra
{
  namespace
  {
    /// Good steps after a cut before the length grows again.
    constexpr std::int64_t steps_after_cut = 4;

    /// Fractions of a step, or an interval, that count as round-off.
    constexpr double step_round_off     = 1e-6;
    constexpr double interval_round_off = 1e-9;
    constexpr double same_step          = 1e-12;

    /// Rungs of the ladder of adaptive steps for a factor of two, and what must
    /// be allowed beyond the next rung before a step grows to it.
    constexpr double rungs_per_octave = 4;
    constexpr double growth_margin    = 1.05;
  } // namespace

  void
  TimeControl::Parameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("End time",
                      "1 s",
                      patterns::Positive("s"),
                      "Time at which the run ends.");
    prm.declare_entry("Number of steps",
                      "0",
                      patterns::Integer(0),
                      "The run also ends after so many steps; 0: no limit.");
    prm.declare_entry("Time step",
                      "1 ms",
                      patterns::Positive("s"),
                      "First and largest length of a step. Steps are shorter "
                      "where a solver asks for it or a step is repeated.");
    prm.declare_entry("Smallest time step",
                      "0",
                      patterns::Double("s", 0),
                      "The run ends with an error where shorter steps are "
                      "needed; 0: a thousandth of the time step.");
    prm.declare_entry("Growth of time step",
                      "1.2",
                      patterns::Double("", 1, 10),
                      "Largest ratio of the lengths of successive steps.");
    prm.declare_entry(
      "Time step control",
      "fixed",
      patterns::Selection("fixed|adaptive"),
      "fixed: the time step as given. adaptive: as long as the "
      "CFL number and explicit viscosity of the flow allow, and "
      "at most the time step.");
    prm.declare_entry("CFL number",
                      "0",
                      patterns::Double("", 0, 1.7),
                      "Of adaptive steps: largest (|v_r|/dr + |v_y|/dy) dt; 0: "
                      "1.2 with the time scheme rk3, 0.9 with a single "
                      "projection a step, 0.3 with ab2.");
  }

  void
  TimeControl::Parameters::parse(ParameterHandler &prm)
  {
    end_time           = prm.get_double("End time");
    n_steps            = prm.get_integer("Number of steps");
    time_step          = prm.get_double("Time step");
    smallest_time_step = prm.get_double("Smallest time step");
    growth             = prm.get_double("Growth of time step");
    adaptive           = prm.get("Time step control") == "adaptive";
    cfl_number         = prm.get_double("CFL number");
    if (cfl_number > 0 && !adaptive)
      prm.add_error("CFL number",
                    "it has no effect on fixed steps; set Time step control = "
                    "adaptive or remove it");
    if (smallest_time_step > time_step)
      prm.add_error("Smallest time step",
                    "it exceeds the time step, " + prm.get("Time step"));
  }

  TimeControl::TimeControl(const Parameters &parameters)
    : parameters(parameters)
    , length(parameters.time_step)
  {
  }

  bool
  TimeControl::finished() const
  {
    return (parameters.n_steps > 0 && steps >= parameters.n_steps) ||
           time() >= parameters.end_time - step_round_off * smallest_step();
  }

  std::int64_t
  TimeControl::n_steps() const
  {
    return steps;
  }

  double
  TimeControl::time() const
  {
    return anchor + static_cast<double>(n_since_anchor) * anchor_step;
  }

  double
  TimeControl::previous_time() const
  {
    return last_time;
  }

  double
  TimeControl::step_size() const
  {
    const double remaining = parameters.end_time - time();
    const double n         = std::ceil(remaining / length - step_round_off);
    return n > 2 ? length : remaining / std::max(n, 1.);
  }

  double
  TimeControl::progress() const
  {
    const double by_time = time() / parameters.end_time;
    const double by_steps =
      parameters.n_steps > 0
        ? static_cast<double>(steps) / static_cast<double>(parameters.n_steps)
        : 0.;
    return std::min(1., std::max(by_time, by_steps));
  }

  void
  TimeControl::accept_step()
  {
    const double step = step_size();
    last_time         = time();
    // Lengths that agree but for round-off keep the anchor.
    if (std::abs(step - anchor_step) > same_step * step)
      {
        anchor         = last_time;
        anchor_step    = step;
        n_since_anchor = 0;
      }
    ++n_since_anchor;
    ++steps;
    if (n_until_growth > 0)
      --n_until_growth;
    else if (!parameters.adaptive)
      length = std::min(length * parameters.growth, parameters.time_step);
  }

  void
  TimeControl::cut_step(const std::string &reason)
  {
    const double failed = step_size();
    EphyraThrowIf(failed / 2 < smallest_step() * (1 - step_round_off),
                  DivergedError,
                  "Step " << steps + 1 << " at time " << time()
                          << " s failed with a time step of " << failed
                          << " s, and half of it is below the "
                          << parameters.name_of_smallest << " ("
                          << smallest_step() << " s): " << reason);
    length         = failed / 2;
    n_until_growth = steps_after_cut;
    ++cuts;
    std::ostringstream message;
    message << "step " << steps + 1 << " at time " << time()
            << " s is repeated with a time step of " << length
            << " s: " << reason;
    log().warning(message.str());
  }

  void
  TimeControl::limit_step_size(const double largest, const std::string &reason)
  {
    EphyraThrowIf(!(largest >= smallest_step()),
                  DivergedError,
                  "Step " << steps + 1 << " at time " << time()
                          << " s needs a time step of " << largest
                          << " s, which is below the smallest allowed ("
                          << smallest_step() << " s): " << reason);
    if (!parameters.adaptive)
      {
        length = std::min(length, largest);
        return;
      }
    // The rung at or below a length; those of the ladder stay where they are.
    const auto rung = [this](const double step) {
      const double k = std::ceil(
        rungs_per_octave * std::log2(parameters.time_step / step) - 1e-9);
      return parameters.time_step *
             std::exp2(-std::max(k, 0.) / rungs_per_octave);
    };
    const double next = rung(length * std::exp2(1. / rungs_per_octave));
    if (length > largest)
      length = rung(largest);
    else if (n_until_growth == 0 && largest >= growth_margin * next)
      length = next;
  }

  std::int64_t
  TimeControl::n_cuts() const
  {
    return cuts;
  }

  void
  TimeControl::serialize(Archive &archive)
  {
    const Archive::Group group(archive, "time_control");
    archive.value("length", length);
    archive.value("last_time", last_time);
    archive.value("anchor", anchor);
    archive.value("anchor_step", anchor_step);
    archive.value("n_since_anchor", n_since_anchor);
    archive.value("steps", steps);
    archive.value("cuts", cuts);
    archive.value("n_until_growth", n_until_growth);
    // A resumed run may have a shorter time step.
    length = std::min(length, parameters.time_step);
  }

  double
  TimeControl::smallest_step() const
  {
    return parameters.smallest_time_step > 0 ? parameters.smallest_time_step
                                             : 1e-3 * parameters.time_step;
  }

  // --- Interval -------------------------------------------------------------

  void
  Interval::declare(ParameterHandler  &prm,
                    const std::string &time_interval,
                    const int          step_interval)
  {
    prm.declare_entry("Time interval",
                      time_interval,
                      patterns::Double("s", 0),
                      "Time between two of them; 0: not by time.");
    prm.declare_entry("Step interval",
                      std::to_string(step_interval),
                      patterns::Integer(0),
                      "Steps between two of them; 0: not by steps.");
    prm.declare_entry("Start time",
                      "0 s",
                      patterns::Double("s", 0),
                      "Time before which there are none.");
  }

  void
  Interval::parse(ParameterHandler &prm)
  {
    time  = prm.get_double("Time interval");
    steps = prm.get_integer("Step interval");
    start = prm.get_double("Start time");
  }

  bool
  Interval::due(const TimeControl &control) const
  {
    if (control.time() < start * (1 - interval_round_off))
      return false;
    if (control.n_steps() == 0)
      return on();
    const auto count = [this](const double t) {
      return std::floor(t / time + interval_round_off);
    };
    return (steps > 0 && control.n_steps() % steps == 0) ||
           (time > 0 && count(control.time()) > count(control.previous_time()));
  }
} // namespace ephyra
