#include "ephyra/immersed_boundary/parameters.h"

#include "ephyra/base/parameter_handler.h"

namespace ephyra::immersed_boundary
{
  void
  Parameters::declare(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Immersed boundary");
    prm.declare_entry("Marker spacing",
                      "0.5",
                      patterns::Double("", 0.05, 0.6),
                      "Distance of two markers over the local cell size when "
                      "they are placed. Leakage grows above 0.6; a deforming "
                      "body stretches the distance.");
    prm.declare_entry("Largest marker spacing",
                      "1",
                      patterns::Double("", 0.6, 2.),
                      "Distance of two markers over the local cell size from "
                      "which on the surface is no longer closed: those of a "
                      "deformable body are placed anew, a rigid body ends the "
                      "run.");
    prm.declare_entry(
      "Weight function",
      "automatic",
      patterns::Selection("automatic|exponential|cubic spline"),
      "Weight of the moving least squares, in each direction. "
      "Automatic: cubic spline for rigid bodies, whose loads it "
      "makes smoother, exponential for deformable ones, whose "
      "thin parts want the narrower weight.");
    prm.declare_entry("Half width",
                      "1.6",
                      patterns::Double("", 1.5, 3.),
                      "Half width of the moving-least-squares support over the "
                      "local cell size.");
    prm.declare_entry("Exponential width",
                      "0.3",
                      patterns::Double("", 0.2, 1.),
                      "Width of the exponential weight over the half width of "
                      "the support.");
    prm.declare_entry(
      "Forcing",
      "automatic",
      patterns::Selection("automatic|sweeps|scaled sweeps|exact"),
      "Marker forces by a number of forcing sweeps; by sweeps scaled so that "
      "they leave no slip where the force changes little from marker to "
      "marker; or so that the velocity before the projection meets the "
      "no-slip condition at every marker. Automatic: sweeps for rigid bodies, "
      "scaled sweeps for deformable ones, whose walls then keep a pressure "
      "difference without a leak.");
    prm.declare_entry("Forcing sweeps",
                      "3",
                      patterns::Integer(1, 1000),
                      "Number of forcing sweeps.");
    prm.declare_entry("Inward shift",
                      "0.25",
                      patterns::Double("", 0., 1.),
                      "Distance by which the forcing points are drawn into the "
                      "body along the normal, over the local cell size. The "
                      "spread forcing moves the wall that the flow sees out by "
                      "about a quarter of a cell.");
    prm.declare_entry(
      "Load",
      "automatic",
      patterns::Selection("automatic|probes|forcing"),
      "Load on a deformable body in the coupling schemes that iterate: from "
      "the probes, or the opposite of the forcing together with momentum and "
      "stress of the fluid inside the body, which needs a flow with one "
      "projection a step. Automatic: forcing with Time scheme = ab2, else "
      "probes. The scheme 'forcing as load' has its own.");
    prm.declare_entry("No-slip iterations",
                      "0",
                      patterns::Integer(0, 200),
                      "Largest number of iterations that bring the velocity "
                      "after the projection to the markers, one projection "
                      "each; for rigid bodies that are fixed or moved by a "
                      "law, and for deformable ones in coupling schemes that "
                      "iterate. 0: forcing and projection once.");
    prm.declare_entry("No-slip tolerance",
                      "1e-3 m/s",
                      patterns::Positive("m/s"),
                      "Root mean square of the slip over the markers at which "
                      "these iterations end.");
    prm.declare_entry("Probe length",
                      "1.5",
                      patterns::Double("", 0.5, 5.),
                      "Distance from the surface at which pressure and "
                      "velocity are taken for the loads, over the local cell "
                      "size.");
    prm.declare_entry(
      "Wall pressure",
      "automatic",
      patterns::Selection("automatic|probe|acceleration|linear"),
      "Pressure at the wall: that of the probe; carried to "
      "the wall with the normal acceleration of the wall; or "
      "extrapolated from one and two probe lengths. Automatic: "
      "linear for rigid bodies, acceleration for deformable "
      "ones, whose coupling it makes stable.");
    prm.declare_entry("Friction",
                      "quadratic",
                      patterns::Selection("one-point|quadratic|extrapolated"),
                      "Wall friction from the velocity gradient at the probe, "
                      "from a parabola through the wall and the points at one "
                      "and two probe lengths, or from one through the points "
                      "at one, two and three probe lengths.");
    prm.declare_entry(
      "Surface slip",
      "false",
      patterns::Bool(),
      "Report slip and leakage also on the surface of rigid "
      "bodies, where the flow outside, continued by a parabola, "
      "meets it; without it only at the forcing points.");
    prm.declare_entry("Load roughness",
                      "false",
                      patterns::Bool(),
                      "Report the roughness of the load on a deformable body: "
                      "its second differences along the surface over the load "
                      "itself, 1 for a load that alternates from control "
                      "point to control point.");
  }

  void
  Parameters::parse(ParameterHandler &prm, const bool rigid_bodies)
  {
    const ParameterHandler::Section section(prm, "Immersed boundary");
    marker_spacing           = prm.get_double("Marker spacing");
    largest_spacing          = prm.get_double("Largest marker spacing");
    const std::string chosen = prm.get("Weight function");
    weight = chosen == "cubic spline" || (chosen == "automatic" && rigid_bodies)
               ? WeightFunction::cubic_spline
               : WeightFunction::exponential;
    half_width               = prm.get_double("Half width");
    exponential_width        = prm.get_double("Exponential width");
    const std::string solver = prm.get("Forcing");
    forcing_solver =
      solver == "exact" ? ForcingSolver::exact
      : solver == "sweeps" || (solver == "automatic" && rigid_bodies)
        ? ForcingSolver::sweeps
        : ForcingSolver::scaled_sweeps;
    forcing_sweeps             = prm.get_integer("Forcing sweeps");
    inward_shift               = prm.get_double("Inward shift");
    const std::string kind     = prm.get("Load");
    load                       = kind == "probes"    ? Load::probes
                                 : kind == "forcing" ? Load::forcing
                                                     : Load::automatic;
    no_slip_iterations         = prm.get_integer("No-slip iterations");
    no_slip_tolerance          = prm.get_double("No-slip tolerance");
    probe_length               = prm.get_double("Probe length");
    const std::string pressure = prm.get("Wall pressure");
    wall_pressure =
      pressure == "probe" ? WallPressure::probe
      : pressure == "linear" || (pressure == "automatic" && rigid_bodies)
        ? WallPressure::linear
        : WallPressure::acceleration;
    const std::string formula = prm.get("Friction");
    friction       = formula == "one-point"   ? FrictionFormula::one_point
                     : formula == "quadratic" ? FrictionFormula::quadratic
                                              : FrictionFormula::extrapolated;
    surface_slip   = prm.get_bool("Surface slip");
    load_roughness = prm.get_bool("Load roughness");
  }

  std::string
  Parameters::description() const
  {
    const std::string sweeps = std::to_string(forcing_sweeps);
    return std::string("weight function ") +
           (weight == WeightFunction::exponential ? "exponential"
                                                  : "cubic spline") +
           ", " +
           (forcing_solver == ForcingSolver::exact ? "exact forcing"
            : forcing_solver == ForcingSolver::sweeps
              ? sweeps + " forcing sweeps"
              : sweeps + " scaled forcing sweeps");
  }
} // namespace ephyra::immersed_boundary
