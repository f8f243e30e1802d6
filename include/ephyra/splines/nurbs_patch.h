#pragma once

#include "ephyra/splines/knot_vector.h"

#include <array>
#include <vector>

namespace ephyra::splines
{
  /// A point of the meridional half plane: r >= 0 from the axis, y along it, m.
  struct Point
  {
    double r = 0;
    double y = 0;
  };

  /// The non-zero rational basis functions at one parametric point.
  template <int dim>
  struct BasisValues
  {
    std::vector<int>                     index;      ///< of the control points
    std::vector<double>                  value;      ///< R_a
    std::array<std::vector<double>, dim> derivative; ///< dR_a / dtheta^k
    /// Second derivatives, filled on request: dim = 1: 11; dim = 2: 11, 22, 12.
    std::array<std::vector<double>, dim == 1 ? 1 : 3> second;
  };

  /// Sides of a bivariate patch.
  enum class Side : int
  {
    theta1_0 = 0,
    theta1_1 = 1,
    theta2_0 = 2,
    theta2_1 = 3
  };

  /// A NURBS patch in the meridional plane, univariate (a curve) or bivariate
  /// (a section of a solid), eq. (50) of Nitti et al. 2023
  /// (10.1016/j.apm.2023.08.003). Parameters run over [0, 1]. Control point
  /// (i, j) has the index i * n_basis(1) + j: the second direction, across the
  /// thickness of a thin body, is the fastest, which keeps matrices banded.
  template <int dim>
  class NurbsPatch
  {
  public:
    /// Parameters (theta^1, ...) of a point.
    using Parameter = std::array<double, dim>;

    /// Throws InputError where sizes do not match or a weight is not positive.
    NurbsPatch(std::vector<KnotVector> knot_vectors,
               std::vector<Point>      control_points,
               std::vector<double>     weights);

    const KnotVector &
    knot_vector(int direction) const
    {
      return kv[direction];
    }
    int
    degree(int direction) const
    {
      return kv[direction].degree();
    }
    int
    n_basis(int direction) const
    {
      return kv[direction].n_basis();
    }
    int
    n_control_points() const
    {
      return static_cast<int>(points.size());
    }
    int
    n_elements() const;
    const std::vector<Point> &
    control_points() const
    {
      return points;
    }
    const std::vector<double> &
    weights() const
    {
      return w;
    }

    /// Rational basis with first (and, if asked, second) derivatives.
    void
    evaluate_basis(const std::array<double, dim> &theta,
                   BasisValues<dim>              &out,
                   bool second_derivatives = false) const;

    Point
    point(const std::array<double, dim> &theta) const;
    /// Covariant base vectors g_k = dX / dtheta^k.
    std::array<Point, dim>
    tangents(const std::array<double, dim> &theta) const;

    /// Curve on a side, oriented by increasing parameter, and the indices of
    /// its control points in this patch; dim = 2 only.
    NurbsPatch<1>
    side(Side s) const;
    std::vector<int>
    side_control_points(Side s) const;

    // --- refinement: geometry and parametrisation are kept (to round-off) ---
    /// Inserts the knots (with multiplicity) in a direction; Boehm's
    /// algorithm, A5.4 of Piegl & Tiller.
    NurbsPatch
    with_inserted_knots(int                        direction,
                        const std::vector<double> &new_knots) const;
    /// Raises the degree by @p times in a direction; A5.9.
    NurbsPatch
    with_elevated_degree(int direction, int times) const;
    /// Cuts every element of a direction into n_parts of equal parametric
    /// length.
    NurbsPatch
    with_split_elements(int direction, int n_parts) const;

  private:
    std::vector<KnotVector> kv;
    std::vector<Point>      points;
    std::vector<double>     w;
  };

  extern template class NurbsPatch<1>;
  extern template class NurbsPatch<2>;
} // namespace ephyra::splines
