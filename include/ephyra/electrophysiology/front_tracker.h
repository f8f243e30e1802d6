#pragma once

#include "ephyra/base/archive.h"

#include <string>
#include <vector>

namespace ephyra::electrophysiology
{
  /// When the potential first reached a level at each control coefficient of a
  /// line: how far a front has come, and whether it moves still.
  class FrontTracker
  {
  public:
    /// @p theta stands for the coefficients, increasing; @p level in V.
    FrontTracker(std::vector<double> theta, double level);

    /// Coefficients of the potential at the time @p t, s.
    void
    record(double t, const std::vector<double> &v);
    /// Why the front has not reached the place @p target by the time @p t: it
    /// never started, has stopped (and where and when), or is on its way.
    std::string
    why_not_reached(double target, double t) const;
    void
    serialize(Archive &archive);

  private:
    std::vector<double> theta;
    double              level;
    std::vector<double> arrival; ///< s; never: a negative number
  };
} // namespace ephyra::electrophysiology
