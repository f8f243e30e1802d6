#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/base/record.h"
#include "ephyra/base/step_status.h"

namespace ephyra::coupling
{
  /// Advances everything that a scene has by one step. On failure the state is
  /// undefined: the caller restores it from the archive that serialize() wrote
  /// before the step, and cuts the step or ends the run. A step is never
  /// accepted unless its status says success.
  class Scheme
  {
  public:
    virtual ~Scheme() = default;

    /// From t to t + dt, s; collective.
    virtual StepStatus
    advance(double t, double dt) = 0;

    /// All that a later step depends on.
    virtual void
    serialize(Archive &archive) = 0;

    /// Adds the columns of statistics.csv that this scheme knows; collective.
    virtual void
    evaluate(Record &record) = 0;

    /// Columns of iterations.csv for the last step; none by default.
    virtual void
    evaluate_iterations(Record &) const
    {
    }
  };
} // namespace ephyra::coupling
