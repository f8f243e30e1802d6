#pragma once

#include "ephyra/splines/nurbs_patch.h"
#include "ephyra/splines/quadrature.h"

#include <array>
#include <vector>

namespace ephyra::splines
{
  /// The basis of a patch tabulated at the Gauss points of all elements:
  /// everything an assembly loop reads that does not change. Element e of a
  /// bivariate patch is e1 * n_elements(1) + e2, point q is q1 * n2 + q2 and
  /// local function a is a1 * (degree(1) + 1) + a2: the second direction is
  /// the fastest, as for control points.
  ///
  /// All numbers of one Gauss point lie together (values, then the derivatives
  /// along each direction), Gauss points and elements follow one another.
  template <int dim>
  class PatchQuadrature
  {
  public:
    /// Gauss rule with the given number of points in each direction.
    PatchQuadrature(const NurbsPatch<dim>      &patch,
                    const std::array<int, dim> &points_per_direction);

    int
    n_elements() const
    {
      return static_cast<int>(indices.size()) / n_functions;
    }
    /// Gauss points of an element.
    int
    n_points() const
    {
      return n_quadrature_points;
    }
    /// Basis functions that live on an element.
    int
    n_local() const
    {
      return n_functions;
    }

    /// Indices of the n_local() control points of an element.
    const int *
    control_points(const int element) const
    {
      return &indices[static_cast<std::size_t>(element) * n_functions];
    }
    /// R_a at a Gauss point, n_local() values.
    const double *
    values(const int element, const int q) const
    {
      return &table[static_cast<std::size_t>(point_index(element, q)) *
                    (1 + dim) * n_functions];
    }
    /// dR_a / dtheta^(k+1), n_local() values.
    const double *
    derivatives(const int element, const int q, const int k) const
    {
      return values(element, q) + (1 + k) * n_functions;
    }
    /// Gauss weight times the parametric size of the element; times the
    /// Jacobian of the map it is the weight of an integral.
    double
    weight(const int element, const int q) const
    {
      return weights[point_index(element, q)];
    }
    const std::array<double, dim> &
    theta(const int element, const int q) const
    {
      return parameters[point_index(element, q)];
    }
    /// Position of a Gauss point among those of all elements.
    int
    point_index(const int element, const int q) const
    {
      return element * n_quadrature_points + q;
    }

  private:
    int                                  n_functions;
    int                                  n_quadrature_points;
    std::vector<int>                     indices;
    std::vector<double>                  table;
    std::vector<double>                  weights;
    std::vector<std::array<double, dim>> parameters;
  };

  extern template class PatchQuadrature<1>;
  extern template class PatchQuadrature<2>;
} // namespace ephyra::splines
