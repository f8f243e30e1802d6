#include "ephyra/coupling/forcing_as_load.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/timer_tree.h"

namespace ephyra::coupling
{
  ForcingAsLoad::ForcingAsLoad(fluid::FlowSolver &flow,
                               DeformableBody    &body,
                               WetSurface        &surface)
    : FluidStructureScheme(flow, body, surface)
  {
    EphyraThrowIf(body.density() < flow.density(),
                  InputError,
                  "Coupling/Scheme = forcing as load needs a body at least as "
                  "dense as the fluid, but the body has "
                    << body.density() << " kg/m^3 and the fluid "
                    << flow.density() << "; use Scheme = added mass.");
    EphyraThrowIf(flow.n_stages() != 1,
                  InputError,
                  "Coupling/Scheme = forcing as load needs a flow with one "
                  "projection a step; set Fluid/Time scheme = "
                  "ab2 or use Scheme = added mass.");
    flow.keep_predicted(false);
    allow_forcing_resistance();
  }

  StepStatus
  ForcingAsLoad::advance(const double t, const double dt)
  {
    StepStatus status = prepare(t, dt);
    if (!status.success)
      return status;
    allow_forcing_resistance();
    const std::size_t n = body.n_unknowns();

    // The load that would follow from a vanishing new acceleration, and how it
    // changes with the acceleration.
    elasticity::InterfaceLoad interface_load;
    WetSurface::Matrix        added;
    {
      const TimerTree::Scope scope(timer(), "interface");
      surface.set_motion(body.motion_without_new_acceleration(dt));
      surface.solve_forcing();
      interface_load.constant.assign(n, 0.);
      surface.add_forcing_load(dt, interface_load.constant);
      added = surface.forcing_resistance(dt);
      added *= -dt * body.newmark_gamma();
    }
    interface_load.added         = &added;
    interface_load.inertia_ratio = flow.density() / body.density();
    interface_load.at_new_level  = true;

    status = body.advance_mechanics(t, dt, interface_load);
    if (!status.success)
      return status;

    surface.set_motion(body.motion());
    surface.solve_forcing();
    force_and_project(0);
    flow_solves = 1;

    // The load is part of the body's equations: what is left is their residual.
    std::vector<double> inertia(body.mechanics().acceleration()), given(n, 0.);
    for (double &a : inertia)
      a *= interface_load.inertia_ratio;
    body.mechanics().body().add_inertia(inertia, given);
    surface.add_forcing_load(dt, given);
    const std::vector<double> used = body.interface_force();
    status.iterations              = 1;
    status.residual                = relative_difference(given, used);
    accept(used);
    last = status;
    return status;
  }
} // namespace ephyra::coupling
