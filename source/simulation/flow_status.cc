#include "ephyra/simulation/flow_status.h"

#include <cmath>
#include <sstream>

namespace ephyra::simulation
{
  namespace
  {
    constexpr std::size_t n_growing_steps = 5;
    constexpr double      growth          = 2.5; ///< in each of them
    constexpr double      harmless_cfl    = 0.1;

    /// Whether the last rates grow without a pause.
    bool
    grows(const std::deque<double> &rates)
    {
      if (rates.size() <= n_growing_steps)
        return false;
      for (std::size_t k = 1; k < rates.size(); ++k)
        if (!(rates[k] >= growth * rates[k - 1] && rates[k - 1] > 0))
          return false;
      return true;
    }
  } // namespace

  StepStatus
  FlowStatus::check(const fluid::FlowSolver &flow, const double dt)
  {
    const fluid::SpeedPeak local = fluid::local_speed_peak(flow.velocity());
    const double rate = mpi::max(local.rate, flow.grid().communicator());
    const double cfl  = dt * rate;

    std::deque<double> recent = rates;
    recent.push_back(rate);
    if (recent.size() > n_growing_steps + 1)
      recent.pop_front();
    if (!(cfl < flow.unstable_cfl()) || !std::isfinite(cfl) ||
        (cfl > harmless_cfl && grows(recent)))
      return StepStatus::failure(failure(flow, local, recent, dt));
    rates     = recent;
    good_peak = local;
    good_cfl  = cfl;
    return {};
  }

  std::string
  FlowStatus::failure(const fluid::FlowSolver  &flow,
                      const fluid::SpeedPeak   &local,
                      const std::deque<double> &recent,
                      const double              dt) const
  {
    const double           cfl    = dt * recent.back();
    const MPI_Comm         comm   = flow.grid().communicator();
    const fluid::SpeedPeak peak   = fluid::global_speed_peak(local, comm);
    const fluid::SpeedPeak before = fluid::global_speed_peak(good_peak, comm);
    const double           n_cells =
      static_cast<double>(flow.grid().r.n_cells) * flow.grid().y.n_cells;

    std::ostringstream reason;
    reason << "The flow has become unstable: ";
    if (peak.n_not_finite > 0)
      reason << "its velocity is not finite in " << peak.n_not_finite << " of "
             << n_cells << " cells, first at (r, y) = (" << peak.r << ", "
             << peak.y << ") m";
    else
      {
        reason << "its velocity " << peak.description()
               << " has the CFL number " << cfl;
        if (cfl < flow.unstable_cfl())
          reason << " and has grown " << recent.back() / recent.front()
                 << "-fold in " << n_growing_steps << " steps";
        else
          reason << ", beyond " << flow.unstable_cfl();
      }
    if (before.rate > 0)
      reason << "; in the step before, the largest was " << before.description()
             << ", CFL number " << good_cfl;
    reason << ": run the scene with a smaller Time/Time step.";
    return reason.str();
  }
} // namespace ephyra::simulation
