#pragma once

#include <string>

namespace ephyra
{
  /// How the advance of a solver, or of several together, ended. Failure is a
  /// status and not an exception: the caller restores the last state, cuts the
  /// step, or ends the run with the reason.
  struct StepStatus
  {
    bool        success = true;
    std::string reason; ///< of a failure: what, where, value, remedy
    int         iterations = 0;
    double      residual   = 0; ///< of the last iteration, relative

    static StepStatus
    failure(const std::string &reason)
    {
      StepStatus status;
      status.success = false;
      status.reason  = reason;
      return status;
    }
  };
} // namespace ephyra
