#include "ephyra/simulation/flow_model.h"

#include "ephyra/fluid/flow_diagnostics.h"

#include <sstream>
#include <string>

namespace ephyra::simulation
{
  FlowModel::FlowModel(const Scene &scene, const MPI_Comm comm)
    : flow(std::make_unique<fluid::FlowSolver>(scene.fluid, comm))
    , probes(std::make_unique<FlowProbes>(scene.flow_sampling,
                                          scene.immersed_boundary,
                                          flow->grid(),
                                          scene.fluid.window.on()))
    , regions(scene.flow_regions)
  {
    using immersed_boundary::RigidBody;
    flow->check_time_step(scene.time.time_step);
    for (const TracerParameters &parameters : scene.tracers)
      tracers.emplace_back(parameters, scene.fluid, flow->velocity());
    if (!scene.rigid_bodies)
      {
        flow->keep_predicted(false);
        return;
      }
    std::vector<std::unique_ptr<RigidBody>> list;
    for (const auto &parameters : scene.bodies)
      list.push_back(std::make_unique<RigidBody>(parameters));
    bodies = std::make_unique<immersed_boundary::RigidFlow>(
      *flow, std::move(list), scene.immersed_boundary);
    if (!scene.fluid.window.on())
      return;
    while (bodies->body(followed).parameters.name != scene.fluid.window.follow)
      ++followed; // the scene has been checked
    window = std::make_unique<fluid::MovingWindow>(
      scene.fluid.window, *flow, bodies->body(followed).position);
  }

  StepStatus
  FlowModel::advance(const double t, const double dt)
  {
    if (window)
      window->follow(bodies->body(followed).position);
    StepStatus status;
    if (bodies)
      status = bodies->advance(t, dt);
    else
      flow->advance(t, dt);
    if (!status.success)
      return status;
    status = flow_status.check(*flow, dt);
    if (status.success)
      for (Tracers &set : tracers)
        set.advance(t, dt, flow->velocity());
    return status;
  }

  void
  FlowModel::serialize(Archive &archive)
  {
    if (bodies)
      bodies->serialize(archive);
    else
      flow->serialize(archive);
    for (Tracers &set : tracers)
      set.serialize(archive);
  }

  void
  FlowModel::evaluate(Record &record)
  {
    if (bodies)
      bodies->evaluate(record);
    if (window)
      window->evaluate(record);
    record.add("kinetic energy [J]",
               fluid::kinetic_energy(flow->velocity(), flow->density()));
    const fluid::VorticityIntegrals vorticity =
      fluid::vorticity_integrals(flow->velocity(), flow->density());
    record.add("circulation [m^2/s]", vorticity.circulation());
    record.add("positive circulation [m^2/s]", vorticity.positive);
    for (const FlowRegion &region : regions)
      region.evaluate(*flow, record);
    for (const Tracers &set : tracers)
      set.evaluate(record);
    record.add("relative divergence [-]",
               fluid::relative_divergence(flow->velocity()));
    record.add("CFL number [-]", flow_status.cfl());
  }

  double
  FlowModel::cfl() const
  {
    return flow_status.cfl();
  }

  void
  FlowModel::write_probes(const double time, RunOutput &output) const
  {
    probes->write_probes(time, *flow, output);
  }

  void
  FlowModel::write_profiles(const double time, RunOutput &output) const
  {
    probes->write_lines(time, *flow, output);
    for (int b = 0; bodies && b < bodies->n_bodies(); ++b)
      {
        const auto &parameters = bodies->body(b).parameters;
        if (!parameters.surface_profiles)
          continue;
        const auto               profile = bodies->surface_profile(b);
        std::vector<std::string> arc;
        for (const double s : profile.arc)
          {
            std::ostringstream name;
            name << s;
            arc.push_back(name.str());
          }
        output.add_profile(
          parameters.name + "_pressure", time, arc, profile.pressure);
        output.add_profile(
          parameters.name + "_friction", time, arc, profile.friction);
      }
  }

  void
  FlowModel::write_fields(const double time, RunOutput &output)
  {
    GridOutput grid;
    flow->write(grid);
    output.add_fields("flow", time, grid);
    for (const Tracers &set : tracers)
      output.add_fields(set.name(), time, set.output(time));
  }

  void
  FlowModel::add_results(Record &record) const
  {
    record.add("flow cells [-]", flow->n_cells());
    probes->add_results(*flow, record);
  }

  std::string
  FlowModel::end_reason() const
  {
    return bodies ? bodies->end_reason() : "";
  }
} // namespace ephyra::simulation
