#include "ephyra/simulation/flow_status.h"

#include <cmath>
#include <sstream>

namespace ephyra::simulation
{
  StepStatus
  flow_status(const fluid::FlowSolver &flow, const double dt, double &cfl)
  {
    const double new_cfl = flow.max_cfl(dt);
    if (!std::isfinite(new_cfl))
      {
        std::ostringstream reason;
        reason << "The velocity of the flow is not finite (CFL number of the "
                  "step before: "
               << cfl << "); run the scene with a smaller Time/Time step.";
        return StepStatus::failure(reason.str());
      }
    cfl = new_cfl;
    return {};
  }
} // namespace ephyra::simulation
