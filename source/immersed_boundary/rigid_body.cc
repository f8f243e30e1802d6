#include "ephyra/immersed_boundary/rigid_body.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/parameter_handler.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace ephyra::immersed_boundary
{
  namespace
  {
    Outline
    make_outline(const RigidBody::Parameters &p)
    {
      switch (p.shape)
        {
        case RigidBody::Shape::spheroid:
          return spheroid_outline(p.radius, p.half_length, p.name);
        case RigidBody::Shape::torus:
          return torus_outline(p.radius, p.core_radius, p.name);
        case RigidBody::Shape::disk:
          return disk_outline(p.radius, p.thickness, p.name);
        default:
          return spheroid_outline(p.radius, p.radius, p.name);
        }
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
    prm.declare_entry("Shape",
                      "sphere",
                      patterns::Selection("sphere|spheroid|torus|disk"),
                      "Shape of the body.");
    prm.declare_entry("Radius",
                      "0.5 m",
                      patterns::Positive("m"),
                      "Radius of a sphere, a spheroid (at its equator) or a "
                      "disk; radius of the centre line of a torus.");
    prm.declare_entry("Half length",
                      "0.5 m",
                      patterns::Positive("m"),
                      "Half the length of a spheroid along the axis.");
    prm.declare_entry("Core radius",
                      "0.1 m",
                      patterns::Positive("m"),
                      "Radius of the circular section of a torus.");
    prm.declare_entry("Thickness",
                      "0.1 m",
                      patterns::Positive("m"),
                      "Thickness of a disk; its rim is rounded.");
    prm.declare_entry("Centre",
                      "0 m",
                      patterns::Double("m"),
                      "Height y of the centre at the beginning.");
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
                      "measures below 1.2 times the density of the fluid.");
    prm.declare_entry("Reference velocity",
                      "0 m/s",
                      patterns::Double("m/s", 0.),
                      "Velocity of the drag coefficients; 0: none are given.");
    prm.declare_entry("Reference area",
                      "0 m^2",
                      patterns::Double("m^2", 0.),
                      "Area of the drag coefficients; 0: largest section.");
  }

  void
  RigidBody::Parameters::parse(ParameterHandler &prm)
  {
    const std::map<std::string, Shape>  shapes{{"sphere", Shape::sphere},
                                              {"spheroid", Shape::spheroid},
                                              {"torus", Shape::torus},
                                              {"disk", Shape::disk}};
    const std::map<std::string, Motion> motions{
      {"fixed", Motion::fixed},
      {"prescribed", Motion::prescribed},
      {"free", Motion::free}};
    const std::map<std::string, InteriorFluid> interiors{
      {"automatic", InteriorFluid::automatic},
      {"rigid", InteriorFluid::rigid},
      {"measured", InteriorFluid::measured}};
    shape              = shapes.at(prm.get("Shape"));
    radius             = prm.get_double("Radius");
    half_length        = prm.get_double("Half length");
    core_radius        = prm.get_double("Core radius");
    thickness          = prm.get_double("Thickness");
    centre_y           = prm.get_double("Centre");
    motion             = motions.at(prm.get("Motion"));
    velocity           = prm.get("Velocity");
    density            = prm.get_double("Density");
    gravity            = prm.get_double("Gravity");
    interior           = interiors.at(prm.get("Interior fluid"));
    reference_velocity = prm.get_double("Reference velocity");
    reference_area     = prm.get_double("Reference area");
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
    , position(parameters.centre_y)
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
