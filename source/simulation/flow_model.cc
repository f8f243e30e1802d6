#include "ephyra/simulation/flow_model.h"

#include "ephyra/base/log.h"
#include "ephyra/fluid/flow_diagnostics.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace ephyra::simulation
{
  namespace
  {
    /// An adaptive step is repeated where the CFL number exceeds the wanted one
    /// by this factor at its end.
    constexpr double overshoot = 1.3;
    /// Reynolds number of a cell from which on the log says that the flow is
    /// not resolved.
    constexpr double coarse_cells = 200;
  } // namespace

  FlowModel::FlowModel(const Scene &scene, const MPI_Comm comm)
    : flow(std::make_unique<fluid::FlowSolver>(scene.fluid, comm))
    , probes(std::make_unique<FlowProbes>(scene.flow_sampling,
                                          scene.immersed_boundary,
                                          flow->grid(),
                                          scene.fluid.window.on()))
    , regions(scene.flow_regions)
  {
    using immersed_boundary::RigidBody;
    if (!scene.time.adaptive)
      flow->check_time_step(scene.time.time_step);
    else
      cfl_number = scene.time.cfl_number > 0 ? scene.time.cfl_number
                                             : flow->default_cfl_number();
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
    status                = flow_status.check(*flow, dt);
    const double last_cfl = flow_status.cfl();
    if (status.success && !told_of_coarse_cells)
      tell_of_coarse_cells(dt);
    if (status.success && cfl_number > 0 && last_cfl > overshoot * cfl_number)
      {
        std::ostringstream reason;
        reason << "the flow has sped up to the CFL number " << last_cfl
               << " within the step, " << cfl_number << " is wanted";
        return StepStatus::failure(reason.str());
      }
    if (status.success)
      for (Tracers &set : tracers)
        set.advance(t, dt, flow->velocity());
    return status;
  }

  void
  FlowModel::tell_of_coarse_cells(const double dt)
  {
    const fluid::StaggeredGrid &grid = flow->grid();
    const double                width =
      std::min(grid.r.smallest_width(), grid.y.smallest_width());
    const double number = flow_status.cfl() / dt * width * width *
                          flow->density() / flow->viscosity();
    if (!(number > coarse_cells) || !std::isfinite(number))
      return;
    told_of_coarse_cells = true;
    std::ostringstream text;
    text << "The flow is not resolved: a cell of " << width
         << " m has the Reynolds number " << number
         << "; boundary layers and thin vortices need one below about 10. "
            "Refine the grid, or take the results as those of coarse cells.";
    log().warning(text.str());
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
    if (flow->energy() != nullptr)
      flow->energy()->evaluate(flow->velocity(), false, record);
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
  FlowModel::largest_step(const double t, const double longest) const
  {
    const double by_flow = flow->largest_time_step(cfl_number);
    return bodies
             ? std::min(by_flow, bodies->largest_step(t, longest, cfl_number))
             : by_flow;
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
