#pragma once

#include "ephyra/splines/nurbs_patch.h"

#include <cmath>

namespace ephyra::tests
{
  using namespace ephyra::splines;

  /// A quarter of the unit circle, from (1, 0) to (0, 1), as one conic arc.
  inline NurbsPatch<1>
  quarter_circle()
  {
    return NurbsPatch<1>({KnotVector(2, {0, 0, 0, 1, 1, 1})},
                         {{1, 0}, {1, 1}, {0, 1}},
                         {1, std::sqrt(0.5), 1});
  }

  /// A wavy rational curve of degree 3 with a repeated knot.
  inline NurbsPatch<1>
  wavy_curve()
  {
    return NurbsPatch<1>(
      {KnotVector(3, {0, 0, 0, 0, 0.2, 0.55, 0.55, 1, 1, 1, 1})},
      {{0.1, 0}, {0.4, 1}, {1.3, 0.8}, {1.7, -0.3}, {2, 0.2}, {2.2, 1}, {3, 2}},
      {1, 0.7, 1.9, 1.2, 0.6, 1.1, 1});
  }

  /// Quarter of an annulus, radii 1 and 2, warped weights in the thickness.
  inline NurbsPatch<2>
  annulus()
  {
    const double c = std::sqrt(0.5);
    return NurbsPatch<2>(
      {KnotVector(2, {0, 0, 0, 1, 1, 1}),
       KnotVector(2, {0, 0, 0, 0.4, 1, 1, 1})},
      {{1, 0},
       {1.2, 0},
       {1.7, 0},
       {2, 0},
       {1, 1},
       {1.2, 1.2},
       {1.7, 1.7},
       {2, 2},
       {0, 1},
       {0, 1.2},
       {0, 1.7},
       {0, 2}},
      {1, 1.5, 0.8, 1, c, 1.5 * c, 0.8 * c, c, 1, 1.5, 0.8, 1});
  }
} // namespace ephyra::tests
