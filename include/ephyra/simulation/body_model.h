#pragma once

#include "ephyra/coupling/deformable_body.h"
#include "ephyra/simulation/body_output.h"
#include "ephyra/simulation/model.h"

namespace ephyra::simulation
{
  /// A deformable body in motion without a flow: mechanics alone, or
  /// electromechanics in vacuum.
  class BodyModel : public Model
  {
  public:
    BodyModel(const Scene &scene, MPI_Comm comm);

    StepStatus
    advance(double t, double dt) override;
    void
    serialize(Archive &archive) override;
    void
    evaluate(Record &record) override;
    void
    write_probes(double time, RunOutput &output) const override;
    void
    write_profiles(double time, RunOutput &output) const override;
    void
    write_fields(double time, RunOutput &output) override;
    void
    add_results(Record &record) const override;
    void
    forget() override;

  private:
    std::unique_ptr<coupling::DeformableBody> body;
    std::unique_ptr<BodyOutput>               body_output;
  };
} // namespace ephyra::simulation
