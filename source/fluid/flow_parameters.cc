#include "ephyra/fluid/flow_parameters.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/parameter_handler.h"

namespace ephyra::fluid
{
  namespace
  {
    const char *const side_names[] = {
      "Lower boundary", "Upper boundary", "Outer boundary"};

    void
    declare_side(ParameterHandler  &prm,
                 const std::string &name,
                 const bool         along_r)
    {
      const ParameterHandler::Section section(prm, name);
      const std::string               where =
        along_r ? "a formula in s = r and t" : "a formula in s = y and t";
      prm.declare_entry(
        "Type",
        "no-slip",
        patterns::Selection(
          along_r ? "no-slip|free-slip|velocity|pressure|outflow|periodic"
                  : "no-slip|free-slip|velocity|pressure|outflow"),
        "no-slip: a wall at rest. free-slip: no flow through, no friction. "
        "velocity: both components given (inflow, moving wall). pressure: "
        "pressure given, velocity free. outflow: convective, balances the "
        "mass." +
          std::string(along_r ? " periodic: lower and upper side together."
                              : ""));
      prm.declare_entry("Radial velocity",
                        "0",
                        patterns::Expression({"s", "t"}, "m/s"),
                        "Of type velocity: " + where + ".");
      prm.declare_entry("Axial velocity",
                        "0",
                        patterns::Expression({"s", "t"}, "m/s"),
                        "Of type velocity: " + where + ".");
      prm.declare_entry("Pressure",
                        "0",
                        patterns::Expression({"s", "t"}, "Pa"),
                        "Of type pressure: " + where + ".");
    }

    SideParameters
    parse_side(ParameterHandler &prm, const std::string &name)
    {
      const ParameterHandler::Section section(prm, name);
      SideParameters                  side;
      const std::string               type = prm.get("Type");
      side.kind            = type == "no-slip"     ? SideKind::no_slip
                             : type == "free-slip" ? SideKind::free_slip
                             : type == "velocity"  ? SideKind::velocity
                             : type == "pressure"  ? SideKind::pressure
                             : type == "outflow"   ? SideKind::outflow
                                                   : SideKind::periodic;
      side.radial_velocity = prm.get("Radial velocity");
      side.axial_velocity  = prm.get("Axial velocity");
      side.pressure        = prm.get("Pressure");
      for (const char *entry : {"Radial velocity", "Axial velocity"})
        if (prm.is_set(entry) && side.kind != SideKind::velocity)
          prm.add_error(entry,
                        "is given, but the type of the " + name + " is \"" +
                          type + "\": set Type = velocity or remove it.");
      if (prm.is_set("Pressure") && side.kind != SideKind::pressure)
        prm.add_error("Pressure",
                      "is given, but the type of the " + name + " is \"" +
                        type + "\": set Type = pressure or remove it.");
      return side;
    }
  } // namespace

  void
  FlowParameters::declare(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Fluid");
    prm.declare_entry("Density",
                      "1000 kg/m^3",
                      patterns::Positive("kg/m^3"),
                      "Density of the fluid.");
    prm.declare_entry("Viscosity",
                      "1e-3 Pa s",
                      patterns::Double("Pa s", 0.),
                      "Dynamic viscosity; 0 is an inviscid flow.");
    prm.declare_entry("Time scheme",
                      "rk3",
                      patterns::Selection("rk3|ab2"),
                      "rk3: three-step Runge-Kutta. ab2: Adams-Bashforth with "
                      "one projection a step, the cheaper partner of implicit "
                      "coupling.");
    prm.declare_entry("Projections per step",
                      "each substep",
                      patterns::Selection("each substep|one"),
                      "With rk3: whether every substep ends free of divergence "
                      "or only the step.");
    prm.declare_entry(
      "Viscous terms",
      "automatic",
      patterns::Selection("automatic|explicit|implicit"),
      "automatic: implicit in those directions only in which an "
      "explicit treatment would restrict the time step.");
    prm.declare_entry(
      "Convection",
      "true",
      patterns::Bool(),
      "Whether the convective terms are there; without them the "
      "flow is a Stokes flow.");
    prm.declare_entry("Energy budget",
                      "false",
                      patterns::Bool(),
                      "Adds the terms of the energy budget to the statistics: "
                      "kinetic energy, dissipation, work at the sides and of "
                      "the forces of a deformable body; not for rigid ones.");
    prm.declare_entry(
      "Poisson solver",
      "automatic",
      patterns::Selection("automatic|fft|hybrid|eigen"),
      "fft: transforms in y (uniform axial spacing). eigen: eigenvectors in r "
      "(any spacing). hybrid: transforms in a uniform block of y, eigenvectors "
      "in stretched ends. automatic: the cheapest that fits the grid.");
    prm.declare_entry("Initial radial velocity",
                      "0",
                      patterns::Expression({"r", "y"}, "m/s"),
                      "At the start; made free of divergence.");
    prm.declare_entry("Initial axial velocity",
                      "0",
                      patterns::Expression({"r", "y"}, "m/s"),
                      "At the start; made free of divergence.");
    prm.declare_entry("Axial body force",
                      "0",
                      patterns::Expression({"t"}, "N/m^3"),
                      "Uniform force along y for each volume, or the negative "
                      "of a uniform pressure gradient.");
    GridParameters::declare(prm);
    MovingWindowParameters::declare(prm);
    for (const char *name : side_names)
      declare_side(prm, name, name != side_names[2]);
  }

  void
  FlowParameters::parse(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Fluid");
    density   = prm.get_double("Density");
    viscosity = prm.get_double("Viscosity");
    scheme =
      prm.get("Time scheme") == "rk3" ? TimeScheme::rk3 : TimeScheme::ab2;
    project_every_substep   = prm.get("Projections per step") == "each substep";
    const std::string terms = prm.get("Viscous terms");
    viscous                 = terms == "automatic" ? ViscousTreatment::automatic
                              : terms == "explicit" ? ViscousTreatment::explicit_
                                                    : ViscousTreatment::implicit;
    convection              = prm.get_bool("Convection");
    energy_budget           = prm.get_bool("Energy budget");
    const std::string solver = prm.get("Poisson solver");
    poisson                  = solver == "automatic" ? PoissonKind::automatic
                               : solver == "fft"     ? PoissonKind::fft
                               : solver == "hybrid"  ? PoissonKind::hybrid
                                                     : PoissonKind::eigen;
    initial_radial_velocity  = prm.get("Initial radial velocity");
    initial_axial_velocity   = prm.get("Initial axial velocity");
    body_force               = prm.get("Axial body force");
    grid.parse(prm);
    window.parse(prm);
    lower = parse_side(prm, side_names[0]);
    upper = parse_side(prm, side_names[1]);
    outer = parse_side(prm, side_names[2]);
    if ((lower.kind == SideKind::periodic) !=
        (upper.kind == SideKind::periodic))
      prm.add_error("Lower boundary/Type",
                    "is periodic only together with the upper boundary: set "
                    "both, or none.");
    if (window.on() && periodic_y())
      prm.add_error("Moving window/Follow",
                    "is given, but the flow is periodic along y, which has no "
                    "ends that could move: choose other boundaries, or no "
                    "window.");
  }

  double
  FlowParameters::explicit_time_step_limit(const GridLine &r_line,
                                           const GridLine &y_line) const
  {
    const double dr = r_line.smallest_width(), dy = y_line.smallest_width();
    return explicit_viscous_number() /
           (4 * kinematic_viscosity() * (1 / (dr * dr) + 1 / (dy * dy)));
  }

  void
  FlowParameters::check() const
  {
    EphyraThrowIf((lower.kind == SideKind::periodic) !=
                    (upper.kind == SideKind::periodic),
                  InputError,
                  "Only one of the lower and upper boundary of the flow is "
                  "periodic: set both, or none.");
    EphyraThrowIf(!(density > 0) || !(viscosity >= 0),
                  InputError,
                  "The flow has the density "
                    << density << " kg/m^3 and the viscosity " << viscosity
                    << " Pa s: the first must be positive, the second not "
                       "negative.");
    EphyraThrowIf(window.on() && periodic_y(),
                  InputError,
                  "The flow is periodic along y and cannot be a moving window: "
                  "choose other lower and upper boundaries.");
  }
} // namespace ephyra::fluid
