#pragma once

#include <array>
#include <vector>

namespace ephyra
{
  class ParameterHandler;
}

namespace ephyra::electrophysiology
{
  /// What excites the tissue from outside: a current density i_a on an
  /// interval of theta^1, in one pulse or in a train of them, and EPSCs given
  /// to the points of the same interval.
  class Stimulus
  {
  public:
    struct Parameters
    {
      double                current   = 0.1;    ///< A/m^3
      double                duration  = 0.1e-3; ///< of a pulse, s
      double                start     = 0;      ///< of the first pulse, s
      double                frequency = 0;      ///< of pacing, Hz; 0: one pulse
      int                   n_pulses  = 0;      ///< 0: as many as there is time
      std::array<double, 2> interval{{0.96, 0.98}}; ///< of theta^1
      std::vector<double>   epsc_times;             ///< s

      static void
      declare(ParameterHandler &prm);
      void
      parse(ParameterHandler &prm);
    };

    /// Throws InputError where pulses would overlap or the interval is empty.
    explicit Stimulus(const Parameters &parameters);

    /// Mean current density over [t, t + dt], A/m^3: the charge of a pulse is
    /// kept wherever its edges lie within the steps.
    double
    mean_current(double t, double dt) const;
    /// First edge of a pulse or time of an EPSC later than t, s (infinite if
    /// none is left).
    double
    next_event(double t) const;
    /// The EPSCs with from <= time < to are [first, last).
    std::array<std::vector<double>::const_iterator, 2>
    epscs(double from, double to) const;
    /// Pulses that began before t.
    int
    n_pulses_before(double t) const;
    const std::array<double, 2> &
    interval() const
    {
      return prm.interval;
    }

  private:
    double
    onset(int pulse) const;
    /// Whether the train has a pulse of that number.
    bool
    exists(int pulse) const;

    Parameters prm;
  };
} // namespace ephyra::electrophysiology
