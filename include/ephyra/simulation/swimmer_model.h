#pragma once

#include "ephyra/coupling/deformable_body.h"
#include "ephyra/coupling/fluid_structure.h"
#include "ephyra/coupling/wet_surface.h"
#include "ephyra/diagnostics/cycles.h"
#include "ephyra/fluid/flow_solver.h"
#include "ephyra/fluid/moving_window.h"
#include "ephyra/simulation/body_output.h"
#include "ephyra/simulation/flow_probes.h"
#include "ephyra/simulation/flow_regions.h"
#include "ephyra/simulation/flow_status.h"
#include "ephyra/simulation/model.h"
#include "ephyra/simulation/surface_output.h"
#include "ephyra/simulation/tracers.h"

namespace ephyra::simulation
{
  /// A deformable body, with or without a nerve net, in a flow.
  class SwimmerModel : public Model
  {
  public:
    SwimmerModel(const Scene &scene, MPI_Comm comm);

    StepStatus
    advance(double t, double dt) override;
    void
    serialize(Archive &archive) override;
    void
    evaluate(Record &record) override;
    void
    evaluate_iterations(Record &record) const override;
    double
    cfl() const override;
    double
    largest_step(double time, double longest) const override;
    double
    iterations() const override;
    void
    observe(double time, RunOutput &output) override;
    void
    serialize_observations(Archive &archive) override;
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
    std::unique_ptr<fluid::FlowSolver>        flow;
    std::unique_ptr<coupling::DeformableBody> body;
    std::unique_ptr<fluid::MovingWindow>      window; ///< null: none
    std::unique_ptr<coupling::WetSurface>     surface;
    std::unique_ptr<coupling::Scheme>         scheme;
    std::unique_ptr<diagnostics::Cycles>      cycles; ///< null: none
    std::unique_ptr<BodyOutput>               body_output;
    std::unique_ptr<SurfaceOutput>            surface_output;
    std::unique_ptr<FlowProbes>               flow_probes;
    std::vector<FlowRegion>                   regions;
    std::vector<Tracers>                      tracers;
    FlowStatus                                flow_status;
    double                                    cfl_number      = 0;
    double                                    last_iterations = 0;
  };
} // namespace ephyra::simulation
