#include "ephyra/simulation/flow_status.h"

#include <sstream>

namespace ephyra::simulation
{
  namespace
  {
    /// No flow gets here but by instability, not even one without convection.
    constexpr double unstable_cfl = 1e6;
  } // namespace

  StepStatus
  flow_status(const fluid::FlowSolver &flow, const double dt, double &cfl)
  {
    const double new_cfl = flow.max_cfl(dt);
    if (!(new_cfl < unstable_cfl))
      {
        std::ostringstream reason;
        reason << "The flow has become unstable (CFL number " << new_cfl
               << ", in the step before " << cfl
               << "); run the scene with a smaller Time/Time step.";
        return StepStatus::failure(reason.str());
      }
    cfl = new_cfl;
    return {};
  }
} // namespace ephyra::simulation
