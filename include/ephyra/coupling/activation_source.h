#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/base/record.h"
#include "ephyra/base/step_status.h"

#include <vector>

namespace ephyra::coupling
{
  /// What contracts the muscle of a body: the activation gamma in [0, 1] along
  /// theta^1, the same across the thickness.
  class ActivationSource
  {
  public:
    virtual ~ActivationSource() = default;

    /// From t to t + dt, s, on a body with the given displacement (control
    /// values, 2 * point + component, m).
    virtual StepStatus
    advance(double t, double dt, const std::vector<double> &displacement) = 0;

    /// gamma at the theta^1 that the source was made for, at the time reached.
    virtual const std::vector<double> &
    activation() const = 0;

    virtual void
    serialize(Archive &archive) = 0;
    virtual void
    evaluate(Record &record) const = 0;
  };
} // namespace ephyra::coupling
