#include "ephyra/geometry/simple_bodies.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/geometry/conic.h"

#include <cmath>

namespace ephyra::geometry
{
  namespace
  {
    void
    check_radii(const std::string &shape,
                const double       inner_radius,
                const double       outer_radius)
    {
      EphyraThrowIf(!(inner_radius < outer_radius),
                    InputError,
                    "The inner radius of the "
                      << shape << ", " << inner_radius
                      << " m, is not less than the outer one, " << outer_radius
                      << " m.");
    }
  } // namespace

  BodyPatch
  make_tube(const double          inner_radius,
            const double          outer_radius,
            const double          length,
            const double          bottom,
            const Discretization &discretization)
  {
    const std::string shape = inner_radius == 0. ? "rod" : "tube";
    if (inner_radius != 0.)
      check_length("inner radius of the tube", inner_radius);
    check_length("outer radius of the " + shape, outer_radius);
    check_length("length of the " + shape, length);
    check_radii(shape, inner_radius, outer_radius);
    const double        top = bottom + length;
    const NurbsPatch<2> patch =
      ruled_patch(line({inner_radius, top}, {inner_radius, bottom}),
                  line({outer_radius, top}, {outer_radius, bottom}));
    return make_body(shape, refined(patch, discretization, shape));
  }

  BodyPatch
  make_disk(const double          radius,
            const double          thickness,
            const double          bottom,
            const Discretization &discretization)
  {
    check_length("radius of the disk", radius);
    check_length("thickness of the disk", thickness);
    const NurbsPatch<2> patch =
      ruled_patch(line({0., bottom}, {radius, bottom}),
                  line({0., bottom + thickness}, {radius, bottom + thickness}));
    return make_body("disk", refined(patch, discretization, "disk"));
  }

  BodyPatch
  make_hollow_sphere(const double          inner_radius,
                     const double          outer_radius,
                     const SphereSection   section,
                     const double          center,
                     const Discretization &discretization)
  {
    const std::string shape = "hollow sphere";
    check_length("inner radius of the " + shape, inner_radius);
    check_length("outer radius of the " + shape, outer_radius);
    check_radii(shape, inner_radius, outer_radius);
    const int    quarters = section == SphereSection::quarter ? 1 : 2;
    const double end      = quarters * std::acos(0.);
    const auto   arc      = [&](const double radius) {
      return ellipse_arc({0., center}, radius, radius, 0., end, quarters);
    };
    std::vector<Side> dry;
    if (section == SphereSection::quarter)
      dry.push_back(Side::theta1_1);
    return make_body(shape,
                     refined(ruled_patch(arc(inner_radius), arc(outer_radius)),
                             discretization,
                             shape),
                     dry);
  }
} // namespace ephyra::geometry
