#include "ephyra/coupling/fluid_structure.h"

#include "ephyra/base/log.h"
#include "ephyra/base/timer_tree.h"
#include "ephyra/coupling/fixed_point.h"
#include "ephyra/coupling/forcing_as_load.h"
#include "ephyra/coupling/sequential.h"

#include <cmath>

namespace ephyra::coupling
{
  void
  CouplingParameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry(
      "Scheme",
      "automatic",
      patterns::Selection("automatic|sequential|forcing as load|fixed point|"
                          "added mass"),
      "How body and flow are coupled. Sequential: the load of the previous "
      "step (the paper's scheme; unstable for thin bodies). Forcing as load: "
      "implicit without iteration, for bodies at least as dense as the fluid, "
      "with Time scheme = ab2. Added mass: implicit by iteration, with the "
      "measured added mass of the fluid in the matrix of the body, for any "
      "density and time scheme. Fixed point: the same without. Automatic: "
      "forcing as load where it is possible, else added mass.");
    prm.declare_entry(
      "Added mass",
      "full",
      patterns::Selection("full|lumped|diagonal|forcing"),
      "Added mass in the matrix of the body: the whole measured one; a local "
      "impedance at each control point, the sum of its row or its diagonal "
      "block; or the impedance of the forcing alone, which is known without "
      "measuring and needs Time scheme = ab2.");
    prm.declare_entry("Load of sequential scheme",
                      "probes",
                      patterns::Selection("probes|forcing"),
                      "Load on the body in the sequential scheme: from probes "
                      "along the normal, or the forcing and the momentum of "
                      "the fluid inside the body.");
    prm.declare_entry("Tolerance",
                      "1e-2",
                      patterns::Double("", 1e-12, 0.5),
                      "Fixed point, added mass: change of the load relative to "
                      "the load at "
                      "which a step has converged.");
    prm.declare_entry(
      "Absolute tolerance",
      "0",
      patterns::Double("N", 0.),
      "Fixed point, added mass: change of the load (norm of the nodal "
      "forces) that always counts as converged; never less "
      "than what strains the body by 1e-11.");
    prm.declare_entry("Maximum iterations",
                      "50",
                      patterns::Integer(1, 1000),
                      "Fixed point, added mass: iterations after which a step "
                      "has failed.");
    Acceleration::Parameters::declare(prm);
  }

  void
  CouplingParameters::parse(ParameterHandler &prm)
  {
    const std::string name = prm.get("Scheme");
    scheme                 = name == "sequential" ? SchemeKind::sequential
                             : name == "forcing as load" ? SchemeKind::forcing_as_load
                             : name == "fixed point" ? SchemeKind::fixed_point
                             : name == "added mass"  ? SchemeKind::added_mass
                                                     : SchemeKind::automatic;
    const std::string mass = prm.get("Added mass");
    added_mass             = mass == "full"       ? AddedMassKind::full
                             : mass == "lumped"   ? AddedMassKind::lumped
                             : mass == "diagonal" ? AddedMassKind::diagonal
                                                  : AddedMassKind::forcing;
    load = prm.get("Load of sequential scheme") == "probes" ? LoadKind::probes
                                                            : LoadKind::forcing;
    tolerance          = prm.get_double("Tolerance");
    absolute_tolerance = prm.get_double("Absolute tolerance");
    maximum_iterations = prm.get_integer("Maximum iterations");
    acceleration.parse(prm);
  }

  FluidStructureScheme::FluidStructureScheme(fluid::FlowSolver &flow,
                                             DeformableBody    &body,
                                             WetSurface        &surface)
    : flow(flow)
    , body(body)
    , surface(surface)
    , load(body.n_unknowns(), 0.)
    , forcing_work(flow.n_stages(), 0.)
  {
  }

  StepStatus
  FluidStructureScheme::prepare(const double t, const double dt)
  {
    const StepStatus status = body.advance_activation(t, dt);
    if (!status.success)
      return status;
    step_start  = t;
    step        = dt;
    flow_solves = 0;
    flow.begin_step(t, dt);
    surface.begin_step(body.motion_between(0.), flow);
    flow.predict(0);
    if (flow.n_stages() > 1)
      flow.keep_first_stage();
    const TimerTree::Scope scope(timer(), "interface");
    surface.set_geometry(body.extrapolated_motion(flow.stage_time(0) - t));
    surface.sample(flow, 0);
    return status;
  }

  void
  FluidStructureScheme::allow_forcing_resistance()
  {
    const Resistance needed = flow.implicit_directions().any()
                                ? Resistance::of_all
                                : Resistance::of_neighbours;
    if (allowed_resistance >= needed)
      return;
    allowed_resistance = needed;
    body.mechanics().allow_coupling(
      surface.coupling_pattern(needed == Resistance::of_all));
  }

  StepStatus
  FluidStructureScheme::respond(const BodyMotion    &end,
                                std::vector<double> &new_load)
  {
    ++flow_solves;
    const bool       several = flow.n_stages() > 1;
    const BodyMotion begin   = body.motion_between(0.);
    const auto       blend   = [](const std::vector<double> &a,
                          const std::vector<double> &b,
                          const double               fraction) {
      std::vector<double> result(a);
      for (std::size_t i = 0; i < result.size(); ++i)
        result[i] += fraction * (b[i] - a[i]);
      return result;
    };
    for (unsigned int k = 0; k < flow.n_stages(); ++k)
      {
        if (k > 0)
          flow.predict(k);
        else if (several)
          flow.return_to_first_stage();
        else
          flow.reset_to_predicted(0);
        const double time     = flow.stage_time(k) - step_start;
        const double fraction = time / step;
        {
          const TimerTree::Scope scope(timer(), "interface");
          if (several)
            {
              surface.set_geometry(body.extrapolated_motion(time));
              surface.sample(flow, k);
            }
          surface.set_motion(
            {{},
             blend(begin.velocity, end.velocity, fraction),
             blend(begin.acceleration, end.acceleration, fraction)});
          surface.solve_forcing();
        }
        const StepStatus status = force_and_project(k);
        if (!status.success)
          return status;
      }
    const TimerTree::Scope scope(timer(), "interface");
    new_load.assign(body.n_unknowns(), 0.);
    surface.fluid_load(flow, step, new_load);
    return {};
  }

  StepStatus
  FluidStructureScheme::force_and_project(const unsigned int stage)
  {
    const StepStatus status = surface.force_and_project(flow, stage);
    if (status.success && flow.energy() != nullptr)
      forcing_work[stage] =
        surface.forcing_work(flow.stage_start(), flow.velocity());
    return status;
  }

  void
  FluidStructureScheme::accept(const std::vector<double> &new_load)
  {
    load       = new_load;
    axial_load = 0;
    for (std::size_t i = 1; i < load.size(); i += 2)
      axial_load += load[i];
    body.accept();
    flow.end_step();
    if (flow.energy() != nullptr)
      for (const double work : forcing_work)
        flow.energy()->add_forcing(work);
  }

  void
  FluidStructureScheme::serialize(Archive &archive)
  {
    {
      const Archive::Group group(archive, "flow");
      flow.serialize(archive);
    }
    {
      const Archive::Group group(archive, "body");
      body.serialize(archive);
    }
    const Archive::Group group(archive, "coupling");
    archive.values("load", load);
    archive.value("axial load", axial_load);
    surface.serialize(archive);
  }

  void
  FluidStructureScheme::evaluate(Record &record)
  {
    const double imbalance_of_body = body.evaluate(record);
    if (fluid::EnergyBudget *const energy = flow.energy(); energy != nullptr)
      {
        const double imbalance =
          energy->evaluate(flow.velocity(), true, record) + imbalance_of_body;
        record.add("work lost at interface [J]",
                   -body.mechanics().energy().surroundings -
                     energy->work_of_forcing());
        record.add("energy imbalance [J]", imbalance);
      }
    record.add("fluid force y [N]", axial_load);
    record.add("slip [-]", surface.slip(flow.velocity()));
    if (surface.reports_roughness())
      record.add("load roughness [-]", surface.roughness(load));
    record.add("largest marker spacing [cells]", surface.largest_spacing());
    record.add("coupling iterations [-]", last.iterations);
    record.add("interface residual [-]", last.residual);
  }

  void
  FluidStructureScheme::evaluate_iterations(Record &record) const
  {
    record.add("iterations [-]", last.iterations);
    record.add("flow solves [-]", flow_solves);
    record.add("residual [-]", last.residual);
    record.add("relaxation [-]", relaxation);
  }

  double
  relative_difference(const std::vector<double> &a,
                      const std::vector<double> &b)
  {
    double change = 0, size = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      {
        change += std::pow(a[i] - b[i], 2);
        size += std::pow(a[i], 2);
      }
    return change == 0 ? 0. : std::sqrt(change / size);
  }

  std::unique_ptr<Scheme>
  make_fluid_structure_scheme(const CouplingParameters &parameters,
                              fluid::FlowSolver        &flow,
                              DeformableBody           &body,
                              WetSurface               &surface)
  {
    using Kind = CouplingParameters::SchemeKind;
    Kind kind  = parameters.scheme;
    if (kind == Kind::automatic)
      {
        const bool light   = body.density() < flow.density();
        const bool several = flow.n_stages() > 1;
        kind = light || several ? Kind::added_mass : Kind::forcing_as_load;
        log().line(std::string("Coupling: ") +
                   (light ? "added mass (the body is lighter than the fluid)"
                    : several
                      ? "added mass (the flow has several stages)"
                      : "forcing as load (the body is not lighter than the "
                        "fluid)"));
      }
    if (kind == Kind::forcing_as_load)
      return std::make_unique<ForcingAsLoad>(flow, body, surface);
    if (kind == Kind::fixed_point || kind == Kind::added_mass)
      return std::make_unique<FixedPoint>(
        flow, body, surface, parameters, kind == Kind::added_mass);
    log().warning(
      "sequential coupling is unstable, at any time step, where the "
      "added mass of the fluid exceeds the mass of the body");
    return std::make_unique<Sequential>(flow, body, surface, parameters.load);
  }
} // namespace ephyra::coupling
