#pragma once

#include "ephyra/splines/nurbs_patch.h"

namespace ephyra::geometry
{
  /// Arc of the ellipse r = r_c + a sin(phi), y = y_c + b cos(phi), from
  /// phi = @p from to @p to, as equal exact conic segments of less than 120
  /// degrees; phi is counted from the upper end of the axis clockwise. Degree
  /// 2, a double knot between two segments.
  splines::NurbsPatch<1>
  ellipse_arc(const splines::Point &center,
              double                a,
              double                b,
              double                from,
              double                to,
              int                   n_segments);

  /// A straight line, degree 1.
  splines::NurbsPatch<1>
  line(const splines::Point &from, const splines::Point &to);

  /// The surface ruled by straight lines from a curve (theta^2 = 0) to another
  /// (theta^2 = 1) with the same knots. Throws InputError where the knots
  /// differ.
  splines::NurbsPatch<2>
  ruled_patch(const splines::NurbsPatch<1> &from,
              const splines::NurbsPatch<1> &to);
} // namespace ephyra::geometry
