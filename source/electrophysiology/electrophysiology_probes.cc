// Probes of the electrophysiology solver, and what it says of its resolution.
#include "ephyra/electrophysiology/electrophysiology_solver.h"

#include <cmath>
#include <sstream>

namespace ephyra::electrophysiology
{
  int
  ElectrophysiologySolver::add_crossing_probe(const double theta,
                                              const double level)
  {
    if (!front)
      front.emplace(monodomain.greville(), level);
    const auto distance = [&](const int i) {
      return std::abs(reaction->theta()[i] - theta);
    };
    int nearest = 0;
    for (int i = 0; i < n_points(); ++i)
      if (distance(i) < distance(nearest))
        nearest = i;
    probe_points.push_back(nearest);
    largest_gates.push_back(0.);
    return probes.add(monodomain, theta, level);
  }

  std::string
  ElectrophysiologySolver::why_not_reached(const int    probe,
                                           const double t) const
  {
    return front->why_not_reached(probes.theta(probe), t);
  }

  std::string
  ElectrophysiologySolver::resolution_problem() const
  {
    // Elements 2, 3.5 and 5 times as long as the front is wide (cubic, Greville
    // points) change its speed by 0.3, 1.2 and 3 %; 9 times as long by 15 %.
    constexpr double   largest_ratio = 4, good_ratio = 2;
    std::ostringstream problem;
    if (!model)
      return "";
    const double width   = model->front_width(prm.diffusivity());
    const double longest = monodomain.longest_element();
    if (longest > largest_ratio * width)
      problem << "The longest element of the tissue, " << 1e3 * longest
              << " mm, does not resolve the front of the action potential, "
              << 1e3 * width << " mm wide: the speed would be wrong by "
              << "several per cent or more, or the front stop; refine to "
              << 1e3 * good_ratio * width << " mm.";
    const double limit = 1. / model->fastest_rate();
    if (prm.time_step > limit)
      problem << (problem.str().empty() ? "" : " ") << "The time step of "
              << prm.time_step
              << " s is beyond the limit of the explicit ionic "
              << "currents, about " << limit
              << " s; reduce \"Electrophysiology/Time step\".";
    return problem.str();
  }
} // namespace ephyra::electrophysiology
