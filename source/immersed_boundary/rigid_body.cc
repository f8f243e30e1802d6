#include "ephyra/immersed_boundary/rigid_body.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/parameter_handler.h"
#include "ephyra/geometry/shapes.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace ephyra::immersed_boundary
{
  namespace
  {
    /// With the reference point at y = 0.
    Outline
    make_outline(const RigidBody::Parameters &p)
    {
      geometry::Discretization discretization;
      discretization.degree     = {3, 3};
      discretization.n_elements = {8, 1};
      if (p.shape == "sphere" || p.shape == "spheroid" || p.shape == "torus")
        {
          geometry::CurveParameters curve;
          curve.shape          = p.shape;
          curve.radius         = p.radius;
          curve.half_height    = p.half_height;
          curve.ring_radius    = p.ring_radius;
          curve.core_radius    = p.core_radius;
          curve.discretization = discretization;
          return curve_outline(geometry::create_curve(curve), p.name);
        }
      geometry::BodyParameters body;
      body.shape          = p.shape;
      body.radius         = p.radius;
      body.outer_radius   = p.radius;
      body.inner_radius   = p.inner_radius;
      body.length         = p.length;
      body.thickness      = p.thickness;
      body.bell           = p.bell;
      body.file_name      = p.file_name;
      body.discretization = discretization;
      return body_outline(geometry::create_body(body), p.name);
    }

    /// Of the control points, which lie on the surface or its tangents there.
    double
    largest_section(const Outline &outline)
    {
      double r = 0;
      for (const splines::Point &p : outline.control_points)
        r = std::max(r, p.r);
      return M_PI * r * r;
    }
  } // namespace

  void
  RigidBody::Parameters::declare(ParameterHandler &prm)
  {
    const auto length = [&prm](const std::string &name,
                               const std::string &value,
                               const std::string &text) {
      prm.declare_entry(name, value, patterns::Positive("m"), text);
    };
    prm.declare_entry(
      "Shape",
      "sphere",
      patterns::Selection("sphere|spheroid|torus|disk|rod|tube|bell|file"),
      "Shape of the body; its dimensions follow below, those of other shapes "
      "are ignored.");
    length("Radius",
           "0.5 m",
           "Radius of a sphere, disk or rod, of the equator of a spheroid, "
           "outer radius of a tube.");
    length("Half height", "0.5 m", "Axial half axis of a spheroid.");
    length("Ring radius",
           "0.75 m",
           "Distance of the core of a torus from the axis.");
    length("Core radius", "0.25 m", "Radius of the core of a torus.");
    length("Inner radius", "0.25 m", "Inner radius of a tube.");
    length("Length", "1 m", "Length of a rod or tube.");
    length("Thickness", "0.1 m", "Thickness of a disk.");
    prm.declare_entry("Patch file",
                      "",
                      patterns::Anything(),
                      "File of control points, for the shape 'file'.");
    prm.declare_entry("Position",
                      "0 m",
                      patterns::Double("m"),
                      "Height y at the beginning of the centre of a sphere, "
                      "spheroid or torus, the lower end of a disk, rod or "
                      "tube, the apex of a bell, y = 0 of a patch file.");
    {
      const ParameterHandler::Section section(prm, "Bell");
      geometry::BellParameters::declare(prm);
    }
    prm.declare_entry("Motion",
                      "fixed",
                      patterns::Selection("fixed|prescribed|free"),
                      "Fixed, moved along the axis by a law, or free to move "
                      "along the axis under gravity and the loads.");
    prm.declare_entry("Velocity",
                      "0",
                      patterns::Expression({"t"}, "m/s"),
                      "Velocity along y of a body that is moved by a law.");
    prm.declare_entry("Density",
                      "1000 kg/m^3",
                      patterns::Positive("kg/m^3"),
                      "Density of a free body.");
    prm.declare_entry("Gravity",
                      "-9.81 m/s^2",
                      patterns::Double("m/s^2"),
                      "Gravity along y that acts on a free body.");
    prm.declare_entry("Interior fluid",
                      "automatic",
                      patterns::Selection("automatic|rigid|measured"),
                      "Momentum of the fluid inside of a free body: of a "
                      "rigid body, or integrated after the projection, which "
                      "costs more and holds for light bodies too. Automatic "
                      "measures for bodies lighter than the fluid.");
    prm.declare_entry("Reference velocity",
                      "0 m/s",
                      patterns::Double("m/s", 0.),
                      "Velocity of the drag coefficients; 0: none are given.");
    prm.declare_entry("Reference area",
                      "0 m^2",
                      patterns::Double("m^2", 0.),
                      "Area of the drag coefficients; 0: largest section.");
    prm.declare_entry("Wake",
                      "none",
                      patterns::Selection("none|above|below"),
                      "Side of the body, along y, on which its wake lies: the "
                      "statistics then have the stretch of reversed flow on "
                      "the axis behind the body and, for sphere, spheroid and "
                      "torus, the angle at which the flow separates.");
    prm.declare_entry("Surface profiles",
                      "false",
                      patterns::Bool(),
                      "Wall pressure and friction by the probes along the "
                      "surface, in profiles/NAME_pressure.csv and "
                      "profiles/NAME_friction.csv.");
  }

  void
  RigidBody::Parameters::parse(ParameterHandler &prm)
  {
    const std::map<std::string, Motion> motions{
      {"fixed", Motion::fixed},
      {"prescribed", Motion::prescribed},
      {"free", Motion::free}};
    const std::map<std::string, InteriorFluid> interiors{
      {"automatic", InteriorFluid::automatic},
      {"rigid", InteriorFluid::rigid},
      {"measured", InteriorFluid::measured}};
    shape        = prm.get("Shape");
    radius       = prm.get_double("Radius");
    half_height  = prm.get_double("Half height");
    ring_radius  = prm.get_double("Ring radius");
    core_radius  = prm.get_double("Core radius");
    inner_radius = prm.get_double("Inner radius");
    length       = prm.get_double("Length");
    thickness    = prm.get_double("Thickness");
    file_name    = prm.get("Patch file");
    position     = prm.get_double("Position");
    {
      const ParameterHandler::Section section(prm, "Bell");
      bell.parse(prm);
    }
    motion             = motions.at(prm.get("Motion"));
    velocity           = prm.get("Velocity");
    density            = prm.get_double("Density");
    gravity            = prm.get_double("Gravity");
    interior           = interiors.at(prm.get("Interior fluid"));
    reference_velocity = prm.get_double("Reference velocity");
    reference_area     = prm.get_double("Reference area");
    const std::map<std::string, Wake> wakes{
      {"none", Wake::none}, {"above", Wake::above}, {"below", Wake::below}};
    wake             = wakes.at(prm.get("Wake"));
    surface_profiles = prm.get_bool("Surface profiles");
  }

  RigidBody::RigidBody(const Parameters &parameters)
    : RigidBody(parameters, make_outline(parameters))
  {
  }

  RigidBody::RigidBody(const Parameters &parameters, Outline outline_in)
    : parameters(parameters)
    , outline(std::move(outline_in))
    , volume(enclosed(outline.curves, control_vector(outline)).volume)
    , mass(parameters.density * volume)
    , reference_area(parameters.reference_area > 0 ? parameters.reference_area
                                                   : largest_section(outline))
    , position(parameters.position)
    , velocity_law(parameters.velocity, {"t"})
  {
    velocity = law(0.);
  }

  double
  RigidBody::law(const double time) const
  {
    return parameters.motion == Motion::prescribed ? velocity_law(time) : 0.;
  }

  double
  RigidBody::displacement(const double from, const double to) const
  {
    if (parameters.motion != Motion::prescribed)
      return 0.;
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    const double x = 0.7745966692414834; // three-point Gauss rule
    return half / 9. *
           (5. * law(middle - x * half) + 8. * law(middle) +
            5. * law(middle + x * half));
  }

  void
  RigidBody::serialize(Archive &archive)
  {
    const Archive::Group group(archive, "rigid body " + parameters.name);
    archive.value("position", position);
    archive.value("velocity", velocity);
    archive.value("acceleration", acceleration);
  }
} // namespace ephyra::immersed_boundary
