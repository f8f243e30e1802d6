#include "ephyra/electrophysiology/front_tracker.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ephyra::electrophysiology
{
  namespace
  {
    constexpr double never = -1;
  }

  FrontTracker::FrontTracker(std::vector<double> theta, const double level)
    : theta(std::move(theta))
    , level(level)
    , arrival(this->theta.size(), never)
  {
  }

  void
  FrontTracker::record(const double t, const std::vector<double> &v)
  {
    for (std::size_t i = 0; i < v.size(); ++i)
      if (v[i] >= level && arrival[i] < 0)
        arrival[i] = t;
  }

  std::string
  FrontTracker::why_not_reached(const double target, const double t) const
  {
    // The point nearest to the target that was reached, and the one before.
    const auto distance = [&](const std::size_t i) {
      return std::abs(theta[i] - target);
    };
    std::size_t nearest = theta.size();
    for (std::size_t i = 0; i < theta.size(); ++i)
      if (arrival[i] >= 0 &&
          (nearest == theta.size() || distance(i) < distance(nearest)))
        nearest = i;
    std::ostringstream text;
    text << "The front has not reached theta^1 = " << target << " ("
         << 1e3 * level << " mV) by " << t << " s: ";
    if (nearest == theta.size())
      {
        text << "no point of the line has come to that potential. The stimulus "
                "may be too weak, too short or too narrow.";
        return text.str();
      }
    const std::size_t before  = theta[nearest] > target
                                  ? std::min(nearest + 1, theta.size() - 1)
                                  : std::max<std::size_t>(nearest, 1) - 1;
    const double      advance = std::abs(arrival[nearest] - arrival[before]);
    // Longer than a front needs for some elements, or for its rise.
    const double patience = std::max(2e-3, 5. * advance);
    if (t - arrival[nearest] < patience)
      text << "it is at theta^1 = " << theta[nearest]
           << " and moves on; extend \"Time/End time\".";
    else
      text << "it stopped at theta^1 = " << theta[nearest] << " at "
           << arrival[nearest]
           << " s, conduction is blocked there. Check conductivity, stimulus "
              "and whether finer elements change it.";
    return text.str();
  }

  void
  FrontTracker::serialize(Archive &archive)
  {
    archive.values("front arrivals", arrival);
  }
} // namespace ephyra::electrophysiology
