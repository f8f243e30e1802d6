#include "ephyra/coupling/prescribed_muscle.h"

#include <algorithm>

namespace ephyra::coupling
{
  PrescribedMuscle::PrescribedMuscle(
    const electrophysiology::PrescribedActivation::Parameters &parameters,
    const std::vector<double> &activation_points)
    : law(parameters)
    , points(activation_points)
  {
    law.evaluate(points, 0., gamma);
  }

  StepStatus
  PrescribedMuscle::advance(const double t,
                            const double dt,
                            const std::vector<double> &)
  {
    law.evaluate(points, t + dt, gamma);
    return {};
  }

  void
  PrescribedMuscle::serialize(Archive &archive)
  {
    archive.values("activation", gamma);
  }

  void
  PrescribedMuscle::evaluate(Record &record) const
  {
    record.add("largest activation [-]",
               *std::max_element(gamma.begin(), gamma.end()));
  }
} // namespace ephyra::coupling
