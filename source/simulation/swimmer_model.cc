#include "ephyra/simulation/swimmer_model.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/fluid/flow_diagnostics.h"
#include "ephyra/simulation/build_body.h"


namespace ephyra::simulation
{
  SwimmerModel::SwimmerModel(const Scene &scene, const MPI_Comm comm)
    : regions(scene.flow_regions)
  {
    const geometry::BodyPatch shape = geometry::create_body(scene.body);
    flow       = std::make_unique<fluid::FlowSolver>(scene.fluid, comm);
    cfl_number = scene.time.cfl_number;
    if (!scene.time.adaptive)
      flow->check_time_step(scene.time.time_step);
    body = build_body(scene, shape, comm);
    if (scene.fluid.window.on())
      window = std::make_unique<fluid::MovingWindow>(
        scene.fluid.window, *flow, body->centre_of_mass());
    std::vector<splines::Side> wet_sides;
    // The ends of a periodic body do not touch the flow.
    const elasticity::Tie tie = scene.mechanics.body.tie;
    for (const geometry::WetSide &wet : shape.wet_sides)
      {
        const bool end1 = wet.side == splines::Side::theta1_0 ||
                          wet.side == splines::Side::theta1_1;
        if ((tie == elasticity::Tie::theta1 && end1) ||
            (tie == elasticity::Tie::theta2 && !end1))
          continue;
        wet_sides.push_back(wet.side);
      }
    surface = std::make_unique<coupling::WetSurface>(
      scene.immersed_boundary, shape.patch, wet_sides, *flow);
    scheme = coupling::make_fluid_structure_scheme(
      scene.coupling, *flow, *body, *surface);
    if (scene.cycles.on())
      cycles = std::make_unique<diagnostics::Cycles>(
        scene.cycles,
        diagnostics::Cycles::Swimmer{body->shape().widest_at_rest(),
                                     body->shape().inner_margin_at_rest(),
                                     body->mechanics().measures().mass,
                                     scene.muscle != Scene::Muscle::none});
    body_output    = std::make_unique<BodyOutput>(*body, scene.body_sampling);
    surface_output = std::make_unique<SurfaceOutput>(*body, *surface, *flow);
    flow_probes    = std::make_unique<FlowProbes>(scene.flow_sampling,
                                               scene.immersed_boundary,
                                               flow->grid(),
                                               scene.fluid.window.on());
    for (const TracerParameters &parameters : scene.tracers)
      tracers.emplace_back(parameters, scene.fluid, flow->velocity());
  }

  StepStatus
  SwimmerModel::advance(const double t, const double dt)
  {
    if (window)
      window->follow(body->centre_of_mass());
    StepStatus status;
    try
      {
        status = scheme->advance(t, dt);
      }
    catch (const immersed_boundary::LeftTheGrid &)
      {
        throw;
      }
    catch (const DivergedError &error)
      {
        // A shorter step may do; all ranks have the same body.
        return StepStatus::failure(error.what());
      }
    if (!status.success)
      return status;
    last_iterations = status.iterations;
    status          = flow_status.check(*flow, dt);
    if (status.success)
      for (Tracers &set : tracers)
        set.advance(t, dt, flow->velocity());
    return status;
  }

  void
  SwimmerModel::serialize(Archive &archive)
  {
    scheme->serialize(archive);
    for (Tracers &set : tracers)
      set.serialize(archive);
  }

  void
  SwimmerModel::evaluate(Record &record)
  {
    scheme->evaluate(record);
    if (window)
      window->evaluate(record);
    for (const FlowRegion &region : regions)
      region.evaluate(*flow, record);
    for (const Tracers &set : tracers)
      set.evaluate(record);
    record.add("relative divergence [-]",
               fluid::relative_divergence(flow->velocity()));
    record.add("CFL number [-]", flow_status.cfl());
  }

  void
  SwimmerModel::evaluate_iterations(Record &record) const
  {
    scheme->evaluate_iterations(record);
  }

  double
  SwimmerModel::largest_step(double, double) const
  {
    return flow->largest_time_step(cfl_number);
  }

  double
  SwimmerModel::cfl() const
  {
    return flow_status.cfl();
  }

  double
  SwimmerModel::iterations() const
  {
    return last_iterations;
  }

  void
  SwimmerModel::observe(const double time, RunOutput &output)
  {
    if (!cycles)
      return;
    const auto radii =
      body->shape().radii(body->mechanics().old_displacement());
    for (const auto &[end, row] :
         cycles->add({time,
                      body->centre_of_mass(),
                      body->speed(),
                      radii.margin,
                      radii.inner_margin,
                      radii.widest,
                      body->mechanics().energy().muscle,
                      -body->mechanics().energy().surroundings}))
      output.add_row("cycles", end, row);
  }

  void
  SwimmerModel::serialize_observations(Archive &archive)
  {
    if (cycles)
      cycles->serialize(archive);
  }

  void
  SwimmerModel::write_probes(const double time, RunOutput &output) const
  {
    body_output->write_probes(time, output);
    flow_probes->write_probes(time, *flow, output);
  }

  void
  SwimmerModel::write_profiles(const double time, RunOutput &output) const
  {
    body_output->write_profiles(time, output);
    flow_probes->write_lines(time, *flow, output);
    surface_output->write_profiles(time, output);
  }

  void
  SwimmerModel::write_fields(const double time, RunOutput &output)
  {
    GridOutput grid;
    flow->write(grid);
    output.add_fields("flow", time, grid);
    for (const Tracers &set : tracers)
      output.add_fields(set.name(), time, set.output(time));
    body_output->write_fields(time, output);
    surface_output->write_fields(time, output);
  }

  void
  SwimmerModel::add_results(Record &record) const
  {
    record.add("flow cells [-]", flow->n_cells());
    record.add("body unknowns [-]", body->n_unknowns());
    flow_probes->add_results(*flow, record);
    if (cycles)
      cycles->add_results(record);
  }

  void
  SwimmerModel::forget()
  {
    body->mechanics().forget();
  }
} // namespace ephyra::simulation
