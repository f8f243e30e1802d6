#include "ephyra/electrophysiology/stimulus.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/parameter_handler.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ephyra::electrophysiology
{
  void
  Stimulus::Parameters::declare(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Stimulus");
    prm.declare_entry("Current",
                      "0.1 A/m^3",
                      patterns::Double("A/m^3"),
                      "Current density of a pulse; divided by the capacitance "
                      "it is the rate at which the potential rises. 0: none.");
    prm.declare_entry(
      "Duration", "0.1 ms", patterns::Positive("s"), "Duration of a pulse.");
    prm.declare_entry("Start time",
                      "0 s",
                      patterns::Double("s", 0.),
                      "Onset of the first pulse.");
    prm.declare_entry("Pacing frequency",
                      "0 Hz",
                      patterns::Double("Hz", 0.),
                      "Frequency of the pulses; 0: a single pulse.");
    prm.declare_entry("Number of pulses",
                      "0",
                      patterns::Integer(0),
                      "Last pulse of the train; 0: no end.");
    prm.declare_entry("Interval",
                      "0.96, 0.98",
                      patterns::List(patterns::Double("", 0., 1.), 2, 2),
                      "Stimulated part of the line, in theta^1.");
    prm.declare_entry("EPSC times",
                      "",
                      patterns::List(patterns::Double("s", 0.)),
                      "Times at which the points of the interval receive an "
                      "excitatory postsynaptic current from outside.");
  }

  void
  Stimulus::Parameters::parse(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Stimulus");
    current                          = prm.get_double("Current");
    duration                         = prm.get_double("Duration");
    start                            = prm.get_double("Start time");
    frequency                        = prm.get_double("Pacing frequency");
    n_pulses                         = prm.get_integer("Number of pulses");
    const std::vector<double> limits = prm.get_double_list("Interval");
    if (limits.size() == 2) // else it has been reported
      interval = {{limits[0], limits[1]}};
    epsc_times = prm.get_double_list("EPSC times");
    if (!(interval[0] < interval[1]))
      prm.add_error("Interval", "the first number must be the smaller one");
    if (frequency > 0 && duration * frequency > 1)
      prm.add_error("Duration",
                    "the pulses overlap; the duration must not exceed the "
                    "period 1/(pacing frequency)");
  }

  Stimulus::Stimulus(const Parameters &parameters)
    : prm(parameters)
  {
    EphyraThrowIf(!(prm.interval[0] < prm.interval[1]),
                  InputError,
                  "The stimulated interval [" << prm.interval[0] << ", "
                                              << prm.interval[1]
                                              << "] is empty; give two "
                                                 "increasing values.");
    EphyraThrowIf(prm.frequency > 0 && prm.duration * prm.frequency > 1,
                  InputError,
                  "Stimulus pulses of " << prm.duration << " s at "
                                        << prm.frequency
                                        << " Hz overlap; shorten them or "
                                           "lower the pacing frequency.");
    std::sort(prm.epsc_times.begin(), prm.epsc_times.end());
  }

  double
  Stimulus::onset(const int pulse) const
  {
    return prm.start + (pulse > 0 ? pulse / prm.frequency : 0.);
  }

  bool
  Stimulus::exists(const int pulse) const
  {
    if (prm.current == 0 || pulse < 0 || (prm.frequency <= 0 && pulse > 0))
      return false;
    return prm.n_pulses == 0 || pulse < prm.n_pulses;
  }

  int
  Stimulus::n_pulses_before(const double t) const
  {
    int n = 0;
    while (exists(n) && onset(n) < t)
      ++n;
    return n;
  }

  double
  Stimulus::mean_current(const double t, const double dt) const
  {
    // At most the last pulse that began before t and those that begin in the
    // step contribute.
    int pulse =
      prm.frequency > 0
        ? std::max(
            0,
            static_cast<int>(std::floor((t - prm.start) * prm.frequency)) - 1)
        : 0;
    double covered = 0;
    for (; exists(pulse) && onset(pulse) < t + dt; ++pulse)
      covered += std::max(0.,
                          std::min(t + dt, onset(pulse) + prm.duration) -
                            std::max(t, onset(pulse)));
    return prm.current * covered / dt;
  }

  double
  Stimulus::next_event(const double t) const
  {
    double     next = std::numeric_limits<double>::infinity();
    const auto epsc =
      std::upper_bound(prm.epsc_times.begin(), prm.epsc_times.end(), t);
    if (epsc != prm.epsc_times.end())
      next = *epsc;
    int pulse =
      prm.frequency > 0
        ? std::max(
            0,
            static_cast<int>(std::floor((t - prm.start) * prm.frequency)) - 1)
        : 0;
    for (; exists(pulse); ++pulse)
      for (const double edge : {onset(pulse), onset(pulse) + prm.duration})
        if (edge > t)
          return std::min(next, edge);
    return next;
  }

  std::array<std::vector<double>::const_iterator, 2>
  Stimulus::epscs(const double from, const double to) const
  {
    const std::vector<double> &times = prm.epsc_times;
    return {{std::lower_bound(times.begin(), times.end(), from),
             std::lower_bound(times.begin(), times.end(), to)}};
  }
} // namespace ephyra::electrophysiology
