#include "ephyra/coupling/sequential.h"

#include "ephyra/base/exceptions.h"

#include <cmath>

namespace ephyra::coupling
{
  namespace
  {
    /// An error message, continued by why and what to do.
    std::string
    with_remedy(std::string message)
    {
      if (!message.empty() && message.back() == '.')
        message.pop_back();
      return message +
             "; the sequential scheme is unstable at any time step where the "
             "added mass of the fluid exceeds the mass of the body: use "
             "Coupling/Scheme = forcing as load or added mass.";
    }
  } // namespace

  Sequential::Sequential(fluid::FlowSolver                 &flow,
                         DeformableBody                    &body,
                         WetSurface                        &surface,
                         const CouplingParameters::LoadKind load_kind)
    : FluidStructureScheme(flow, body, surface)
    , load_kind(load_kind)
  {
    flow.keep_predicted(false);
  }

  StepStatus
  Sequential::advance(const double t, const double dt)
  {
    StepStatus status = body.advance_activation(t, dt);
    if (!status.success)
      return status;

    elasticity::InterfaceLoad interface_load;
    interface_load.constant = load;
    // The forcing also moves the fluid inside the body.
    if (load_kind == CouplingParameters::LoadKind::forcing)
      interface_load.inertia_ratio = flow.density() / body.density();
    status = body.advance_mechanics(t, dt, interface_load);
    if (!status.success)
      {
        status.reason = with_remedy(status.reason);
        return status;
      }

    std::vector<double> new_load(body.n_unknowns(), 0.);
    flow_solves = 1;
    flow.begin_step(t, dt);
    for (unsigned int k = 0; k < flow.n_stages(); ++k)
      {
        flow.predict(k);
        try
          {
            surface.set_geometry(
              body.motion_between((flow.stage_time(k) - t) / dt));
          }
        catch (const DivergedError &error)
          {
            throw DivergedError(with_remedy(error.what()));
          }
        surface.sample(flow, k);
        surface.solve_forcing();
        force_and_project(k);
        if (load_kind == CouplingParameters::LoadKind::forcing)
          surface.add_forcing_load(dt, new_load);
      }
    if (load_kind == CouplingParameters::LoadKind::probes)
      surface.probe_load(flow, new_load);

    // The body moved under the load of the step before, the flow answered with
    // this one.
    status.iterations = 1;
    status.residual   = relative_difference(new_load, load);
    if (!std::isfinite(status.residual))
      return StepStatus::failure(
        with_remedy("The load of the fluid on the body is not finite"));
    accept(new_load);
    last = status;
    return status;
  }
} // namespace ephyra::coupling
