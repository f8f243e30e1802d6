#include "ephyra/simulation/scene.h"

#include "ephyra/simulation/scene_checks.h"

#include <algorithm>
#include <cmath>

namespace ephyra::simulation
{
  namespace
  {
    void
    declare_rigid_body(ParameterHandler &prm)
    {
      immersed_boundary::RigidBody::Parameters::declare(prm);
    }

    template <std::size_t dim>
    void
    refine(std::array<int, dim> &n_elements, const double factor)
    {
      for (int &n : n_elements)
        n = std::max(1, static_cast<int>(std::lround(factor * n)));
    }

    void
    refine(fluid::GridDirection &direction, const double factor)
    {
      for (double &spacing : direction.spacings)
        spacing /= factor;
    }
  } // namespace

  void
  Scene::declare(ParameterHandler &prm)
  {
    {
      const ParameterHandler::Section section(prm, "Scene");
      prm.declare_entry(
        "Physics",
        "flow",
        patterns::List(
          patterns::Selection("electrophysiology|elasticity|flow|rigid bodies"),
          1),
        "What the scene has; what is not named is neither built nor stepped.");
      prm.declare_entry("Mechanics",
                        "dynamic",
                        patterns::Selection("dynamic|static"),
                        "Motion of the body, or its equilibrium under the "
                        "loads.");
      prm.declare_entry("Muscle",
                        "none",
                        patterns::Selection("none|prescribed|nerve net"),
                        "What contracts the body: nothing, the section "
                        "Prescribed activation, or electrophysiology.");
      prm.declare_entry("Refinement",
                        "1",
                        patterns::Double("", 1. / 64., 64.),
                        "Refines a whole scene at once: multiplies the numbers "
                        "of elements and divides the spacings of the grid and "
                        "the time steps.");
      prm.declare_entry(
        "Refined parts",
        "elements, grid, time step, nerve net step",
        patterns::List(
          patterns::Selection("elements|grid|time step|nerve net step"), 1),
        "What Refinement changes.");
      prm.declare_entry("Nested elements",
                        "34",
                        patterns::Integer(1, 100000),
                        "Elements of the nerve net in each element of the body "
                        "along theta^1.");
      prm.declare_entry("Distributed body from",
                        "20000",
                        patterns::Integer(0),
                        "Unknowns from which on a body is shared among the "
                        "ranks (Tpetra, Amesos2); a smaller one is computed on "
                        "every rank for itself, which is faster.");
    }
    {
      const ParameterHandler::Section section(prm, "Time");
      TimeControl::Parameters::declare(prm);
      prm.declare_entry("Cut-backs",
                        "true",
                        patterns::Bool(),
                        "Repeat a step that fails with half its length; off: "
                        "it ends the run.");
      prm.declare_entry("Wall time limit",
                        "0",
                        patterns::Double("s", 0.),
                        "Wall time after which the run stops with a checkpoint "
                        "(exit code 3); 0: none.");
    }
    {
      const ParameterHandler::Section section(prm, "Output");
      OutputParameters::declare(prm);
      prm.declare_entry("Progress interval",
                        "100",
                        patterns::Integer(0),
                        "Steps between two lines of progress; 0: none.");
    }
    {
      const ParameterHandler::Section section(prm, "Body");
      geometry::BodyParameters::declare(prm);
    }
    {
      const ParameterHandler::Section section(prm, "Tissue");
      prm.declare_entry("Isolated cell",
                        "false",
                        patterns::Bool(),
                        "A single neuron instead of a tissue on a line.");
      prm.declare_entry("Crossing probes",
                        "",
                        patterns::List(patterns::Double("", 0., 1.)),
                        "theta^1 of places where the first upward crossing of "
                        "the level is timed; the speed is that from the first "
                        "to the last.");
      prm.declare_entry("Crossing level",
                        "20 mV",
                        patterns::Double("V"),
                        "Potential whose upward crossing counts.");
      geometry::CurveParameters::declare(prm);
      TissueMotion::Parameters::declare(prm);
    }
    TissueSampling::declare(prm);
    electrophysiology::ElectrophysiologySolver::Parameters::declare(prm);
    electrophysiology::PrescribedActivation::Parameters::declare(prm);
    {
      const ParameterHandler::Section section(prm, "Elasticity");
      elasticity::ElasticitySolver::Parameters::declare(prm);
      elasticity::StaticsSolver::Parameters::declare(prm);
    }
    fluid::FlowParameters::declare(prm);
    FlowSampling::declare(prm);
    FlowRegion::declare(prm);
    TracerParameters::declare(prm);
    immersed_boundary::Parameters::declare(prm);
    BodySampling::declare(prm);
    prm.declare_repeated_subsection("Rigid body",
                                    declare_rigid_body,
                                    "A rigid body in the flow, by any name.");
    {
      const ParameterHandler::Section section(prm, "Coupling");
      coupling::CouplingParameters::declare(prm);
    }
    {
      const ParameterHandler::Section section(prm, "Cycles");
      diagnostics::CycleParameters::declare(prm);
    }
  }

  void
  Scene::parse(ParameterHandler &prm)
  {
    {
      const ParameterHandler::Section section(prm, "Scene");
      const auto                      physics = prm.get_list("Physics");
      const auto                      has     = [&](const std::string &name) {
        return std::find(physics.begin(), physics.end(), name) != physics.end();
      };
      electrophysiology      = has("electrophysiology");
      elasticity             = has("elasticity");
      flow                   = has("flow");
      rigid_bodies           = has("rigid bodies");
      statics                = prm.get("Mechanics") == "static";
      const std::string name = prm.get("Muscle");
      muscle                 = name == "prescribed"  ? Muscle::prescribed
                               : name == "nerve net" ? Muscle::nerve_net
                                                     : Muscle::none;
      refinement             = prm.get_double("Refinement");
      refined_parts          = prm.get_list("Refined parts");
      nested_elements        = prm.get_integer("Nested elements");
      distributed_unknowns   = prm.get_integer("Distributed body from");

      if (rigid_bodies && !flow)
        prm.add_error("Physics", "rigid bodies need flow; add flow.");
      if (rigid_bodies && elasticity)
        prm.add_error("Physics",
                      "rigid bodies and elasticity exclude each other; leave "
                      "one of them out.");
      if (electrophysiology && flow && !elasticity)
        prm.add_error("Physics",
                      "electrophysiology and flow meet only through a "
                      "deformable body; add elasticity or leave one of them "
                      "out.");
      if (muscle != Muscle::none && !elasticity)
        prm.add_error("Muscle",
                      "there is no deformable body to contract; add elasticity "
                      "to Physics or set Muscle = none.");
      if (muscle == Muscle::nerve_net && !electrophysiology)
        prm.add_error("Muscle",
                      "a nerve net needs electrophysiology in Physics.");
      if (electrophysiology && elasticity && muscle != Muscle::nerve_net)
        prm.add_error("Muscle",
                      "electrophysiology would have no effect on the body; set "
                      "Muscle = nerve net or leave electrophysiology out of "
                      "Physics.");
      if (statics && (flow || electrophysiology))
        prm.add_error("Mechanics",
                      "static equilibrium is for elasticity alone; set "
                      "Mechanics = dynamic.");
    }
    {
      const ParameterHandler::Section section(prm, "Time");
      time.parse(prm);
      time.time_step /= refinement_of("time step");
      if (time.adaptive && !flow)
        prm.add_error("Time step control",
                      "adaptive steps follow the flow, and there is none; set "
                      "it to fixed or add flow to Physics.");
      cut_backs       = prm.get_bool("Cut-backs");
      wall_time_limit = prm.get_double("Wall time limit");
    }
    {
      const ParameterHandler::Section section(prm, "Output");
      output.parse(prm);
      progress_interval = prm.get_integer("Progress interval");
    }
    if (elasticity)
      {
        const ParameterHandler::Section section(prm, "Body");
        body.parse(prm);
        refine(body.discretization.n_elements, refinement_of("elements"));
      }
    if (elasticity)
      body_sampling.parse(prm);
    if (electrophysiology && !elasticity)
      {
        const ParameterHandler::Section section(prm, "Tissue");
        single_cell     = prm.get_bool("Isolated cell");
        crossing_points = prm.get_double_list("Crossing probes");
        crossing_level  = prm.get_double("Crossing level");
        tissue_line.parse(prm);
        tissue_motion.parse(prm);
        refine(tissue_line.discretization.n_elements,
               refinement_of("elements"));
      }
    if (electrophysiology && !elasticity)
      tissue_sampling.parse(prm);
    if (electrophysiology)
      {
        tissue.parse(prm);
        tissue.time_step /= refinement_of("nerve net step");
      }
    if (muscle == Muscle::prescribed)
      activation.parse(prm);
    if (elasticity)
      {
        const ParameterHandler::Section section(prm, "Elasticity");
        mechanics.parse(prm);
        if (muscle == Muscle::none)
          mechanics.body.active_strain.form =
            elasticity::ActiveStrain::Form::none;
        equilibrium.body   = mechanics.body;
        equilibrium.newton = mechanics.newton;
        equilibrium.parse(prm);
        if (statics)
          time = equilibrium.load_steps();
      }
    if (flow)
      {
        fluid.parse(prm);
        refine(fluid.grid.r, refinement_of("grid"));
        refine(fluid.grid.y, refinement_of("grid"));
        flow_sampling.parse(prm);
        flow_regions = FlowRegion::parse_all(prm);
        tracers      = TracerParameters::parse_all(prm);
      }
    if (flow && rigid_bodies && fluid.energy_budget)
      {
        const ParameterHandler::Section section(prm, "Fluid");
        prm.add_error("Energy budget",
                      "the work of rigid bodies is not counted; set it to "
                      "false.");
      }
    if (flow && (elasticity || rigid_bodies))
      immersed_boundary.parse(prm, rigid_bodies);
    if (rigid_bodies)
      for (const std::string &name : prm.instances("Rigid body"))
        {
          const ParameterHandler::Section section(prm, "Rigid body " + name);
          bodies.emplace_back();
          bodies.back().name = name;
          bodies.back().parse(prm);
        }
    if (flow && elasticity)
      {
        const ParameterHandler::Section section(prm, "Coupling");
        coupling.parse(prm);
        if (mechanics.chosen_rho_infinity &&
            mechanics.body.density < fluid.density)
          mechanics.rho_infinity = 0.;
      }
    if (flow && elasticity)
      {
        const ParameterHandler::Section section(prm, "Cycles");
        cycles.parse(prm);
        const auto &pacing = tissue.stimulus;
        if (!cycles.on() && electrophysiology && pacing.frequency > 0)
          {
            cycles.period = 1. / pacing.frequency;
            cycles.start  = pacing.start;
          }
        if (cycles.on() && cycles.period < 10 * time.time_step)
          prm.add_error("Period",
                        "a cycle has less than ten time steps; make it longer "
                        "or the steps shorter.");
      }
    check_scene(*this, prm);
  }

  double
  Scene::refinement_of(const std::string &part) const
  {
    return std::find(refined_parts.begin(), refined_parts.end(), part) ==
               refined_parts.end()
             ? 1
             : refinement;
  }

  std::string
  Scene::description() const
  {
    std::string result;
    const auto  add = [&result](const bool on, const std::string &name) {
      if (on)
        result += (result.empty() ? "" : " + ") + name;
    };
    add(electrophysiology, "electrophysiology");
    add(elasticity, statics ? "elasticity (static)" : "elasticity");
    add(muscle == Muscle::prescribed, "prescribed activation");
    add(flow, "flow");
    add(rigid_bodies, std::to_string(bodies.size()) + " rigid bodies");
    return result;
  }
} // namespace ephyra::simulation
