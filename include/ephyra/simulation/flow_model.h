#pragma once

#include "ephyra/fluid/flow_solver.h"
#include "ephyra/fluid/moving_window.h"
#include "ephyra/immersed_boundary/rigid_flow.h"
#include "ephyra/simulation/flow_probes.h"
#include "ephyra/simulation/flow_regions.h"
#include "ephyra/simulation/flow_status.h"
#include "ephyra/simulation/model.h"
#include "ephyra/simulation/tracers.h"

namespace ephyra::simulation
{
  /// Flow alone, or around rigid bodies.
  class FlowModel : public Model
  {
  public:
    FlowModel(const Scene &scene, MPI_Comm comm);

    StepStatus
    advance(double t, double dt) override;
    void
    serialize(Archive &archive) override;
    void
    evaluate(Record &record) override;
    double
    cfl() const override;
    double
    largest_step(double time, double longest) const override;
    void
    write_probes(double time, RunOutput &output) const override;
    void
    write_profiles(double time, RunOutput &output) const override;
    void
    write_fields(double time, RunOutput &output) override;
    void
    add_results(Record &record) const override;
    std::string
    end_reason() const override;

  private:
    /// Says once that cells are too coarse for the Reynolds number.
    void
    tell_of_coarse_cells(double dt);

    std::unique_ptr<fluid::FlowSolver>            flow;
    std::unique_ptr<immersed_boundary::RigidFlow> bodies;       ///< null: none
    std::unique_ptr<fluid::MovingWindow>          window;       ///< null: none
    int                                           followed = 0; ///< body
    std::unique_ptr<FlowProbes>                   probes;
    std::vector<FlowRegion>                       regions;
    std::vector<Tracers>                          tracers;
    FlowStatus                                    flow_status;
    /// Of adaptive steps; 0: the step is fixed.
    double cfl_number           = 0;
    bool   told_of_coarse_cells = false;
  };
} // namespace ephyra::simulation
