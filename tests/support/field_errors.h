#pragma once

#include "ephyra/elasticity/material.h"
#include "ephyra/splines/nurbs_patch.h"
#include "ephyra/splines/patch_quadrature.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace ephyra::test
{
  /// A displacement (m) and its gradient rr, ry, yr, yy, hoop.
  struct FieldValue
  {
    splines::Point                 u;
    elasticity::AxisymmetricTensor gradient;
  };

  using Field = std::function<FieldValue(const splines::Point &)>;

  /// Displacement and gradient that control values have at a point off the
  /// axis.
  inline FieldValue
  field_value(const splines::NurbsPatch<2> &patch,
              const std::vector<double>    &control_values,
              const std::array<double, 2>  &theta)
  {
    splines::BasisValues<2> basis;
    patch.evaluate_basis(theta, basis);
    const auto           g   = patch.tangents(theta);
    const double         det = g[0].r * g[1].y - g[0].y * g[1].r;
    const splines::Point x   = patch.point(theta);
    FieldValue           out{};
    for (std::size_t a = 0; a < basis.index.size(); ++a)
      {
        const double d1 = basis.derivative[0][a], d2 = basis.derivative[1][a];
        const double d_r = (d1 * g[1].y - d2 * g[0].y) / det;
        const double d_y = (d2 * g[0].r - d1 * g[1].r) / det;
        const double u_r = control_values[2 * basis.index[a]];
        const double u_y = control_values[2 * basis.index[a] + 1];
        out.u.r += basis.value[a] * u_r;
        out.u.y += basis.value[a] * u_y;
        out.gradient[0] += d_r * u_r;
        out.gradient[1] += d_y * u_r;
        out.gradient[2] += d_r * u_y;
        out.gradient[3] += d_y * u_y;
      }
    out.gradient[4] = out.u.r / x.r;
    return out;
  }

  /// Relative errors of a displacement over the volume: in L2, and in the
  /// energy norm of small strain of a material, (int eps : C : eps)^1/2.
  struct FieldErrors
  {
    double l2, energy;
  };

  inline FieldErrors
  field_errors(const splines::NurbsPatch<2> &patch,
               const std::vector<double>    &control_values,
               const Field                  &exact,
               elasticity::Material          material)
  {
    material.small_strain = true;
    const auto energy     = [&](elasticity::AxisymmetricTensor H) {
      for (const int i : {0, 3, 4})
        H[i] += 1.;
      return elasticity::evaluate(material, H).energy;
    };
    const int n = std::max(patch.degree(0), patch.degree(1)) + 4;
    const splines::PatchQuadrature<2> quadrature(patch, {{n, n}});
    double                            error[2] = {0., 0.}, norm[2] = {0., 0.};
    for (int e = 0; e < quadrature.n_elements(); ++e)
      for (int q = 0; q < quadrature.n_points(); ++q)
        {
          const auto           theta = quadrature.theta(e, q);
          const splines::Point x     = patch.point(theta);
          const auto           g     = patch.tangents(theta);
          const double         w     = quadrature.weight(e, q) * x.r *
                           std::abs(g[0].r * g[1].y - g[0].y * g[1].r);
          const FieldValue wanted = exact(x);
          FieldValue       found  = field_value(patch, control_values, theta);
          norm[0] += w * (wanted.u.r * wanted.u.r + wanted.u.y * wanted.u.y);
          norm[1] += w * energy(wanted.gradient);
          for (int i = 0; i < 5; ++i)
            found.gradient[i] -= wanted.gradient[i];
          error[0] += w * (std::pow(found.u.r - wanted.u.r, 2) +
                           std::pow(found.u.y - wanted.u.y, 2));
          error[1] += w * energy(found.gradient);
        }
    return {std::sqrt(error[0] / norm[0]), std::sqrt(error[1] / norm[1])};
  }
} // namespace ephyra::test
