#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/electrophysiology/monodomain_operator.h"

#include <vector>

namespace ephyra::electrophysiology
{
  /// Times at which the potential crosses levels upwards at places of the
  /// line, interpolated inside the steps: the passage of a front.
  class CrossingProbes
  {
  public:
    /// Returns the number of the new probe; level in V.
    int
    add(const MonodomainOperator &monodomain, double theta, double level);
    bool
    empty() const
    {
      return probes.empty();
    }
    /// The control coefficients of the potential went from old_v to new_v.
    void
    record(double                     t,
           double                     dt,
           const std::vector<double> &old_v,
           const std::vector<double> &new_v);
    double
    theta(const int probe) const
    {
      return probes[probe].theta;
    }
    const std::vector<double> &
    times(const int probe) const
    {
      return probes[probe].times;
    }
    void
    serialize(Archive &archive);

  private:
    struct Probe
    {
      double              theta;
      int                 first;
      std::vector<double> basis;
      double              level;
      std::vector<double> times;
    };
    std::vector<Probe> probes;
  };
} // namespace ephyra::electrophysiology
