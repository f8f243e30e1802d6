#pragma once

#include "ephyra/splines/nurbs_patch.h"

#include <array>
#include <cmath>

namespace ephyra::test
{
  using splines::KnotVector;
  using splines::NurbsPatch;
  using splines::Point;

  inline NurbsPatch<2>
  refined(NurbsPatch<2> patch, const int degree, const std::array<int, 2> &n)
  {
    for (int d = 0; d < 2; ++d)
      {
        if (degree > patch.degree(d))
          patch = patch.with_elevated_degree(d, degree - patch.degree(d));
        if (n[d] > 1)
          patch = patch.with_split_elements(d, n[d]);
      }
    return patch;
  }

  /// Tube a < r < b, 0 < y < h; theta1 along y, theta2 along r.
  inline NurbsPatch<2>
  tube(const double              a,
       const double              b,
       const double              h,
       const int                 degree,
       const std::array<int, 2> &n)
  {
    return refined({{KnotVector::uniform(1, 1), KnotVector::uniform(1, 1)},
                    {{a, 0}, {b, 0}, {a, h}, {b, h}},
                    {1, 1, 1, 1}},
                   degree,
                   n);
  }

  /// Upper half of a hollow ellipsoid of revolution from the axis (theta1 = 0)
  /// to the equator (theta1 = 1), theta2 outwards; exact.
  inline NurbsPatch<2>
  hollow_ellipsoid(const Point              &inner,
                   const Point              &outer,
                   const int                 degree,
                   const std::array<int, 2> &n)
  {
    const double w = std::sqrt(0.5);
    return refined({{KnotVector::uniform(2, 1), KnotVector::uniform(1, 1)},
                    {{0, inner.y},
                     {0, outer.y},
                     {inner.r, inner.y},
                     {outer.r, outer.y},
                     {inner.r, 0},
                     {outer.r, 0}},
                    {1, 1, w, w, 1, 1}},
                   degree,
                   n);
  }

  inline NurbsPatch<2>
  hollow_sphere(const double              a,
                const double              b,
                const int                 degree,
                const std::array<int, 2> &n)
  {
    return hollow_ellipsoid({a, a}, {b, b}, degree, n);
  }
} // namespace ephyra::test
