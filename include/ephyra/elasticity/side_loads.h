#pragma once

#include "ephyra/elasticity/boundary_conditions.h"
#include "ephyra/linear_algebra/sparse_matrix.h"
#include "ephyra/splines/patch_quadrature.h"

namespace ephyra::elasticity
{
  /// Pressure and traction on one side of a patch, over the full revolution:
  ///   F_a = 2 pi int R_a (-p n r ds + t_0 R dS),
  /// the first on the deformed surface (follower) or the reference one (dead),
  /// n the outward normal, the second on the reference surface. The force and
  /// its derivative are exact for the follower pressure, which makes an
  /// unsymmetric matrix.
  class SideLoad
  {
  public:
    /// @p orientation of the patch, see PatchTables. @p reference_only: all
    /// loads act on the reference shape (small strain).
    SideLoad(const splines::NurbsPatch<2> &patch,
             splines::Side                 side,
             const SideCondition          &condition,
             double                        orientation,
             int                           points_per_element,
             bool                          reference_only);

    /// Loads at time t times @p factor.
    void
    set_time(double t, double factor);

    /// Number of elements along the side; a caller shares them among ranks.
    int
    n_elements() const
    {
      return quadrature.n_elements();
    }
    /// Subtracts the force of elements first, first + stride, ... at the
    /// current positions x (2 * point + component) and adds its absolute
    /// values, element by element, to @p scale.
    void
    subtract_force(const std::vector<double> &x,
                   int                        first,
                   int                        stride,
                   std::vector<double>       &residual,
                   std::vector<double>       &scale) const;
    /// Adds factor * d(-F)/dx; does nothing for dead loads.
    void
    add_tangent(const std::vector<double>    &x,
                int                           first,
                int                           stride,
                double                        factor,
                const Constraints            &constraints,
                linear_algebra::SparseMatrix &matrix) const;

  private:
    struct Surface
    {
      double r, dr, dy; ///< radius and tangent
    };
    Surface
    surface(const std::vector<double> &x, int element, int q) const;

    SideCondition                      condition;
    std::vector<int>                   points; ///< control points of the side
    splines::PatchQuadrature<1>        quadrature;
    std::vector<double>                reference; ///< positions, 2 * point + i
    std::vector<splines::Point>        position;  ///< of the Gauss points
    double                             sign;      ///< of the outward normal
    bool                               follower;
    std::vector<double>                pressure; ///< at the Gauss points
    std::array<std::vector<double>, 2> traction;
  };
} // namespace ephyra::elasticity
