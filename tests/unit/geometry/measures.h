#pragma once

#include "ephyra/splines/patch_quadrature.h"

#include <cmath>

namespace ephyra::tests
{
  /// Volume that a patch sweeps round the axis, n Gauss points per element.
  inline double
  volume_of_revolution(const splines::NurbsPatch<2> &patch, const int n)
  {
    const splines::PatchQuadrature<2> quadrature(patch, {{n, n}});
    double                            sum = 0.;
    for (int e = 0; e < quadrature.n_elements(); ++e)
      for (int q = 0; q < quadrature.n_points(); ++q)
        {
          const auto &theta = quadrature.theta(e, q);
          const auto  g     = patch.tangents(theta);
          sum += quadrature.weight(e, q) * patch.point(theta).r *
                 (g[0].r * g[1].y - g[0].y * g[1].r);
        }
    return 2. * std::acos(-1.) * sum;
  }

  /// Area that a curve sweeps round the axis, n Gauss points per element.
  inline double
  area_of_revolution(const splines::NurbsPatch<1> &curve, const int n)
  {
    const splines::PatchQuadrature<1> quadrature(curve, {{n}});
    double                            sum = 0.;
    for (int e = 0; e < quadrature.n_elements(); ++e)
      for (int q = 0; q < quadrature.n_points(); ++q)
        {
          const auto          &theta = quadrature.theta(e, q);
          const splines::Point g     = curve.tangents(theta)[0];
          sum += quadrature.weight(e, q) * curve.point(theta).r *
                 std::hypot(g.r, g.y);
        }
    return 2. * std::acos(-1.) * sum;
  }
} // namespace ephyra::tests
