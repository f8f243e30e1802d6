#pragma once

#include "ephyra/coupling/activation_source.h"
#include "ephyra/electrophysiology/prescribed_activation.h"

namespace ephyra::coupling
{
  /// Activation by a formula or a table: no electrophysiology is built.
  class PrescribedMuscle : public ActivationSource
  {
  public:
    PrescribedMuscle(
      const electrophysiology::PrescribedActivation::Parameters &parameters,
      const std::vector<double> &activation_points);

    StepStatus
    advance(double                     t,
            double                     dt,
            const std::vector<double> &displacement) override;
    const std::vector<double> &
    activation() const override
    {
      return gamma;
    }
    void
    serialize(Archive &archive) override;
    void
    evaluate(Record &record) const override;

  private:
    const electrophysiology::PrescribedActivation law;
    const std::vector<double>                     points;
    std::vector<double>                           gamma;
  };
} // namespace ephyra::coupling
