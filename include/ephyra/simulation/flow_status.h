#pragma once

#include "ephyra/base/step_status.h"
#include "ephyra/fluid/flow_solver.h"
#include "ephyra/fluid/speed_peak.h"

#include <deque>
#include <string>

namespace ephyra::simulation
{
  /// Watches whether the flow stays sound from step to step. A step has failed
  /// where
  ///   a velocity is not finite,
  ///   the CFL number is beyond FlowSolver::unstable_cfl(),
  ///   the largest velocity (in cells a second) has grown at least 2.5 times in
  ///   each of the last five steps, a hundredfold in all, and crosses more than
  ///   a tenth of a cell in a step: no motion that the steps resolve does so.
  /// The reason names the place, the values and the remedy, the same on any
  /// number of ranks.
  class FlowStatus
  {
  public:
    /// After a step of length @p dt, s. A step that has failed is not
    /// remembered. Collective.
    StepStatus
    check(const fluid::FlowSolver &flow, double dt);

    /// Largest CFL number of the last good step.
    double
    cfl() const
    {
      return good_cfl;
    }

  private:
    std::string
    failure(const fluid::FlowSolver  &flow,
            const fluid::SpeedPeak   &local,
            const std::deque<double> &recent,
            double                    dt) const;

    fluid::SpeedPeak   good_peak; ///< of this rank in the last good step
    double             good_cfl = 0;
    std::deque<double> rates; ///< largest ones of the last good steps, 1/s
  };
} // namespace ephyra::simulation
