#include "ephyra/geometry/simple_curves.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/geometry/conic.h"

#include <cmath>

namespace ephyra::geometry
{
  namespace
  {
    const double pi = std::acos(-1.);

    /// Ends that lie on the axis get the radius zero exactly.
    NurbsPatch<1>
    with_ends_on_axis(const NurbsPatch<1> &curve, const bool last)
    {
      std::vector<Point> points = curve.control_points();
      points.front().r          = 0.;
      if (last)
        points.back().r = 0.;
      return NurbsPatch<1>(
        {curve.knot_vector(0)}, std::move(points), curve.weights());
    }
  } // namespace

  BodyCurve
  make_disk_surface(const double          radius,
                    const double          y,
                    const Discretization &discretization)
  {
    check_length("radius of the disk", radius);
    return {"disk",
            refined(line({0., y}, {radius, y}), discretization, "disk"),
            true,
            false};
  }

  BodyCurve
  make_cylinder_surface(const double          radius,
                        const double          length,
                        const double          bottom,
                        const Discretization &discretization)
  {
    check_length("radius of the cylinder", radius);
    check_length("length of the cylinder", length);
    return {"cylinder",
            refined(line({radius, bottom}, {radius, bottom + length}),
                    discretization,
                    "cylinder"),
            false,
            false};
  }

  BodyCurve
  make_hemi_ellipsoid(const double          a,
                      const double          b,
                      const double          center,
                      const Discretization &discretization)
  {
    check_length("radial half axis of the hemi-ellipsoid", a);
    check_length("axial half axis of the hemi-ellipsoid", b);
    const NurbsPatch<1> arc = ellipse_arc({0., center}, a, b, 0., pi / 2., 1);
    return {
      "hemi-ellipsoid",
      with_ends_on_axis(refined(arc, discretization, "hemi-ellipsoid"), false),
      true,
      false};
  }

  BodyCurve
  make_spheroid(const double          a,
                const double          b,
                const double          center,
                const Discretization &discretization)
  {
    check_length("radial half axis of the spheroid", a);
    check_length("axial half axis of the spheroid", b);
    const NurbsPatch<1> arc = ellipse_arc({0., center}, a, b, 0., pi, 2);
    return {"spheroid",
            with_ends_on_axis(refined(arc, discretization, "spheroid"), true),
            true,
            false};
  }

  BodyCurve
  make_torus(const double          ring_radius,
             const double          core_radius,
             const double          center,
             const Discretization &discretization)
  {
    check_length("core radius of the torus", core_radius);
    EphyraThrowIf(!(ring_radius > core_radius),
                  InputError,
                  "The ring radius of the torus, "
                    << ring_radius << " m, is not larger than its core radius, "
                    << core_radius << " m; the torus would have no hole.");
    NurbsPatch<1> circle = refined(
      ellipse_arc(
        {ring_radius, center}, core_radius, core_radius, 0., 2. * pi, 4),
      discretization,
      "torus");
    std::vector<Point> points = circle.control_points();
    points.back()             = points.front(); // closed to the last bit
    circle                    = NurbsPatch<1>(
      {circle.knot_vector(0)}, std::move(points), circle.weights());
    return {"torus", std::move(circle), true, true};
  }
} // namespace ephyra::geometry
