#include "ephyra/elasticity/side_loads.h"

#include <cmath>

namespace ephyra::elasticity
{
  SideLoad::SideLoad(const splines::NurbsPatch<2> &patch,
                     const splines::Side           side,
                     const SideCondition          &condition,
                     const double                  orientation,
                     const int                     points_per_element,
                     const bool                    reference_only)
    : condition(condition)
    , points(patch.side_control_points(side))
    , quadrature(patch.side(side), {{points_per_element}})
    , sign(side == splines::Side::theta2_0 || side == splines::Side::theta1_1
             ? orientation
             : -orientation)
    , follower(condition.follower && !reference_only)
  {
    for (const splines::Point &x : patch.control_points())
      {
        reference.push_back(x.r);
        reference.push_back(x.y);
      }
    const splines::NurbsPatch<1> curve = patch.side(side);
    for (int e = 0; e < quadrature.n_elements(); ++e)
      for (int q = 0; q < quadrature.n_points(); ++q)
        position.push_back(curve.point(quadrature.theta(e, q)));
    set_time(0., 1.);
  }

  void
  SideLoad::set_time(const double t, const double factor)
  {
    const auto evaluate = [&](const Expression    &formula,
                              std::vector<double> &values) {
      values.assign(position.size(), 0.);
      if (formula.is_zero())
        return;
      for (int e = 0; e < quadrature.n_elements(); ++e)
        for (int q = 0; q < quadrature.n_points(); ++q)
          {
            const int k = quadrature.point_index(e, q);
            values[k] =
              factor *
              formula(
                {quadrature.theta(e, q)[0], position[k].r, position[k].y, t});
          }
    };
    evaluate(condition.pressure, pressure);
    evaluate(condition.traction[0], traction[0]);
    evaluate(condition.traction[1], traction[1]);
  }

  SideLoad::Surface
  SideLoad::surface(const std::vector<double> &x,
                    const int                  element,
                    const int                  q) const
  {
    const double *R  = quadrature.values(element, q);
    const double *dR = quadrature.derivatives(element, q, 0);
    const int    *a  = quadrature.control_points(element);
    Surface       s{0., 0., 0.};
    for (int k = 0; k < quadrature.n_local(); ++k)
      {
        const double *point = &x[2 * points[a[k]]];
        s.r += R[k] * point[0];
        s.dr += dR[k] * point[0];
        s.dy += dR[k] * point[1];
      }
    return s;
  }

  void
  SideLoad::subtract_force(const std::vector<double> &x,
                           const int                  first,
                           const int                  stride,
                           std::vector<double>       &residual,
                           std::vector<double>       &scale) const
  {
    const int           n = quadrature.n_local();
    std::vector<double> force(2 * n);
    for (int e = first; e < quadrature.n_elements(); e += stride)
      {
        std::fill(force.begin(), force.end(), 0.);
        for (int q = 0; q < quadrature.n_points(); ++q)
          {
            const int     k    = quadrature.point_index(e, q);
            const Surface s    = surface(follower ? x : reference, e, q);
            const Surface s0   = follower ? surface(reference, e, q) : s;
            const double  w    = 2. * M_PI * quadrature.weight(e, q);
            const double  p    = w * sign * pressure[k] * s.r;
            const double  area = w * s0.r * std::hypot(s0.dr, s0.dy);
            const double  f_r  = -p * s.dy + area * traction[0][k];
            const double  f_y  = p * s.dr + area * traction[1][k];
            const double *R    = quadrature.values(e, q);
            for (int a = 0; a < n; ++a)
              {
                force[2 * a] += R[a] * f_r;
                force[2 * a + 1] += R[a] * f_y;
              }
          }
        for (int a = 0; a < n; ++a)
          for (int i = 0; i < 2; ++i)
            {
              const int unknown =
                2 * points[quadrature.control_points(e)[a]] + i;
              residual[unknown] -= force[2 * a + i];
              scale[unknown] += std::abs(force[2 * a + i]);
            }
      }
  }

  void
  SideLoad::add_tangent(const std::vector<double>    &x,
                        const int                     first,
                        const int                     stride,
                        const double                  factor,
                        const Constraints            &constraints,
                        linear_algebra::SparseMatrix &matrix) const
  {
    if (!follower || condition.pressure.is_zero())
      return;
    const int           n = quadrature.n_local();
    std::vector<double> K(4 * n * n);
    std::vector<int>    unknowns(2 * n);
    for (int e = first; e < quadrature.n_elements(); e += stride)
      {
        std::fill(K.begin(), K.end(), 0.);
        for (int q = 0; q < quadrature.n_points(); ++q)
          {
            const Surface s = surface(x, e, q);
            const double  p = factor * 2. * M_PI * quadrature.weight(e, q) *
                             sign * pressure[quadrature.point_index(e, q)];
            const double *R  = quadrature.values(e, q);
            const double *dR = quadrature.derivatives(e, q, 0);
            for (int a = 0; a < n; ++a)
              for (int b = 0; b < n; ++b)
                {
                  double *k = &K[4 * n * a + 2 * b];
                  k[0] += p * R[a] * R[b] * s.dy;
                  k[1] += p * R[a] * s.r * dR[b];
                  k[2 * n] -= p * R[a] * (R[b] * s.dr + s.r * dR[b]);
                }
          }
        for (int a = 0; a < n; ++a)
          for (int i = 0; i < 2; ++i)
            unknowns[2 * a + i] = constraints.equation(
              2 * points[quadrature.control_points(e)[a]] + i);
        matrix.add(unknowns.data(), 2 * n, K.data());
      }
  }
} // namespace ephyra::elasticity
