#pragma once

#include "ephyra/diagnostics/body_kinematics.h"
#include "ephyra/elasticity/statics.h"
#include "ephyra/simulation/body_fields.h"
#include "ephyra/simulation/body_probes.h"
#include "ephyra/simulation/line_profile.h"
#include "ephyra/simulation/model.h"

namespace ephyra::simulation
{
  /// Equilibrium of a body from no load to the full load: a step of the run is
  /// a load step, its time the load level times the end time.
  class StaticsModel : public Model
  {
  public:
    StaticsModel(const Scene &scene, MPI_Comm comm);

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
    BodyState
    state() const;

    double end_time; ///< of the full load, s
    std::unique_ptr<elasticity::StaticsSolver>               solver;
    std::unique_ptr<electrophysiology::PrescribedActivation> muscle;
    std::unique_ptr<diagnostics::BodyKinematics>             kinematics;
    std::unique_ptr<BodyFields>                              fields;
    std::unique_ptr<BodyProbes>                              probes;
    std::vector<std::pair<std::string, LineProfile>>         sides;
    std::vector<double>                                      rest; ///< velocity
  };
} // namespace ephyra::simulation
