// Sizes of the substeps of the electrophysiology solver.
#include "ephyra/electrophysiology/electrophysiology_solver.h"

#include <algorithm>
#include <cmath>

namespace ephyra::electrophysiology
{
  double
  ElectrophysiologySolver::largest_step() const
  {
    return may_rest ? std::min(prm.resting_time_step,
                               std::ldexp(prm.time_step,
                                          static_cast<int>(step_doublings)))
                    : prm.time_step;
  }

  bool
  ElectrophysiologySolver::resting() const
  {
    return may_rest && largest_step() >= prm.resting_time_step;
  }

  void
  ElectrophysiologySolver::wake()
  {
    step_doublings = 0;
    calm_time      = 0;
  }

  void
  ElectrophysiologySolver::adapt_step(const double dt)
  {
    double largest = 0;
    for (const double x : increment)
      largest = std::max(largest, std::abs(x));
    // A step may change the potential by this.
    const double allowed = prm.resting_rate * prm.resting_time_step;
    const double rate    = largest / dt;
    if (rate * largest_step() > allowed)
      {
        while (step_doublings > 0 && rate * largest_step() > allowed)
          --step_doublings;
        calm_time = 0;
        return;
      }
    calm_time += dt;
    if (resting() || calm_time < calm_time_needed ||
        2 * rate * largest_step() > allowed)
      return;
    calm_time = 0;
    if (distance_of_gates() <= prm.resting_gates)
      ++step_doublings;
  }

  double
  ElectrophysiologySolver::distance_of_gates() const
  {
    double              distance = 0;
    std::vector<double> steady(model->n_gates());
    const int           n = n_points();
    for (const AwakeRanges::Range &range : awake.ranges())
      for (int i = range[0]; i < range[1]; ++i)
        {
          model->steady_gates(points_v[i], steady.data());
          for (int k = 0; k < model->n_gates(); ++k)
            distance = std::max(
              distance,
              std::abs(gates[static_cast<std::size_t>(k) * n + i] - steady[k]));
        }
    return distance;
  }

  StepStatus
  ElectrophysiologySolver::advance(const double t, const double dt)
  {
    const double t_end = t + dt;
    const double tiny  = 1e-6 * std::min(dt, prm.time_step);
    double       now   = t - behind;
    while (t_end - now > tiny)
      {
        if (std::min(stimulus.next_event(now - tiny),
                     diffusion.next_event(now - tiny)) <= now + tiny)
          wake(); // where something begins
        const double largest = largest_step();
        double       limit = std::min(t_end, diffusion.next_event(now + tiny));
        if (step_doublings > 0)
          limit = std::min(limit, stimulus.next_event(now + tiny));
        // At rest whole steps alone, so that short steps of the scene do not
        // make short ones here; what is left waits for the next call.
        const bool   waits   = resting() && limit >= t_end;
        const double n_whole = (limit - now) / largest;
        if (waits && n_whole < 1 - 1e-6)
          break;
        const double begin   = now;
        const auto   n_steps = static_cast<std::int64_t>(
          waits ? std::floor(n_whole + 1e-6)
                  : std::max(1., std::ceil(n_whole - 1e-6)));
        const double h =
          waits ? largest : (limit - begin) / static_cast<double>(n_steps);
        for (std::int64_t i = 0; i < n_steps; ++i)
          {
            substep(now, h);
            now = waits || i + 1 < n_steps
                    ? begin + static_cast<double>(i + 1) * h
                    : limit;
            if (substeps % 64 == 0 && blown_up())
              return StepStatus::failure(failure_reason(now, h));
            if (largest_step() != largest)
              break;
          }
        if (blown_up())
          return StepStatus::failure(failure_reason(now, h));
      }
    behind = std::max(0., t_end - now);
    if (behind <= tiny)
      behind = 0;
    synchronize();
    return StepStatus();
  }
} // namespace ephyra::electrophysiology
