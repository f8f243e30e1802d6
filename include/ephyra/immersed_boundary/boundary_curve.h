#pragma once

#include "ephyra/geometry/body_patch.h"

#include <string>
#include <vector>

namespace ephyra::immersed_boundary
{
  /// A piece of the wetted surface of a body: a NURBS curve in the meridional
  /// plane whose control points are entries of a control vector x with
  /// component c of point i at x[2 i + c] (c = 0: r, c = 1: y). Knots and
  /// weights are fixed, the control points move.
  struct BoundaryCurve
  {
    splines::NurbsPatch<1> curve;          ///< reference geometry
    std::vector<int>       control_points; ///< where they are in x
    /// +1 where the fluid lies to the right of the curve as it is run through,
    /// so that the outward normal is (t_y, -t_r); -1 where it lies to the left.
    int         orientation = 1;
    std::string name;
  };

  /// The surface of a body with the reference positions of its control points.
  struct Outline
  {
    std::vector<BoundaryCurve>  curves;
    std::vector<splines::Point> control_points;
  };

  /// A side of a patch, the control points being numbered from
  /// @p first_control_point on as in the patch. The orientation follows from
  /// the geometry.
  BoundaryCurve
  side_curve(const splines::NurbsPatch<2> &patch,
             splines::Side                 side,
             const std::string            &name,
             int                           first_control_point = 0);

  /// The given sides of a patch.
  Outline
  patch_outline(const splines::NurbsPatch<2>     &patch,
                const std::vector<splines::Side> &sides,
                const std::string                &name);

  /// All wet sides of a body.
  Outline
  body_outline(const geometry::BodyPatch &body, const std::string &name);

  /// An outline given as one curve, e.g. of a sphere.
  Outline
  curve_outline(const geometry::BodyCurve &curve, const std::string &name);

  /// Control vector of the outline, moved by @p shift along y.
  std::vector<double>
  control_vector(const Outline &outline, double shift = 0);

  /// What the closed surface of revolution holds.
  struct Enclosed
  {
    double volume     = 0; ///< integral of pi r^2 dy, m^3
    double centroid_y = 0; ///< m
  };

  /// Gauss quadrature of the surface integrals, exact to round-off for the
  /// polynomial case. The curves together must close the body, except for a
  /// part on the axis. Throws InputError where the volume is not positive.
  Enclosed
  enclosed(const std::vector<BoundaryCurve> &curves,
           const std::vector<double>        &x);
} // namespace ephyra::immersed_boundary
