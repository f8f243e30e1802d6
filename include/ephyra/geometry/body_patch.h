#pragma once

#include "ephyra/splines/nurbs_patch.h"

#include <string>
#include <vector>

namespace ephyra::geometry
{
  using splines::NurbsPatch;
  using splines::Point;
  using splines::Side;

  /// A side of a patch that the flow touches. Walking along the wet sides in
  /// their order, each against its parameter where `reversed`, keeps the body
  /// on the left and the flow on the right.
  struct WetSide
  {
    Side side;
    bool reversed;
  };

  /// Unit normal that points out of the body, from the tangent by increasing
  /// parameter of a wet side: (t_y, -t_r)/|t|, or its opposite where reversed.
  Point
  outward_normal(const Point &tangent, bool reversed);

  /// The meridional section of a deformable body.
  ///
  /// The map has a positive Jacobian: theta^2 is to the left of theta^1.
  struct BodyPatch
  {
    std::string       shape; ///< name, e.g. "bell"
    NurbsPatch<2>     patch;
    std::vector<Side> axis_sides; ///< that lie on the axis r = 0
    /// In the order of a walk round the body; a chain breaks where a side is
    /// neither on the axis nor wet (a plane of symmetry).
    std::vector<WetSide> wet_sides;
  };

  /// Completes a patch to a body: finds the sides on the axis, whose radii
  /// become exactly zero, and orders the others, without the @p dry ones, to
  /// the wet chain, which starts behind an axis or dry side. Throws InputError
  /// where a radius is negative, or the Jacobian is not positive at some Gauss
  /// point, with the place.
  BodyPatch
  make_body(const std::string       &shape,
            NurbsPatch<2>            patch,
            const std::vector<Side> &dry = {});

  /// A line in the meridional plane: the outline of a rigid body or a surface
  /// that carries a nerve net.
  struct BodyCurve
  {
    std::string   shape;
    NurbsPatch<1> curve;
    /// Whether walking along the parameter has the body to the right; to be
    /// given to outward_normal().
    bool reversed;
    bool closed; ///< ends where it begins (a torus)
  };
} // namespace ephyra::geometry
