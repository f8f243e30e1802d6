#pragma once

#include "ephyra/fluid/velocity_field.h"
#include "ephyra/immersed_boundary/markers.h"
#include "ephyra/immersed_boundary/moving_least_squares.h"
#include "ephyra/splines/nurbs_patch.h"

#include <array>
#include <vector>

namespace ephyra::immersed_boundary
{
  /// The fluid inside a deformable body, which the forcing on its surface drives
  /// like the fluid outside. What the body receives is the opposite of the
  /// forcing and what the fluid inside takes of it (Uhlmann 2005,
  /// 10.1016/j.jcp.2005.03.017, for rigid bodies). For a basis function R_i of
  /// the body, by the momentum equation of the fluid inside,
  ///   int sigma n R_i dS = int [rho Du/Dt R_i + sigma grad R_i] dV,
  /// sigma = -p + mu (grad u + grad u^T), taken from the computed flow: exact
  /// whether or not the fluid inside moves with the body. The integral is over
  /// the deformed section by the midpoint rule on pieces of half a cell.
  class InteriorFluid
  {
  public:
    /// @p density kg/m^3 and dynamic @p viscosity Pa s of the fluid.
    InteriorFluid(const splines::NurbsPatch<2> &patch,
                  const fluid::StaggeredGrid   &grid,
                  double                        density,
                  double                        viscosity,
                  const Parameters             &parameters);

    /// Moves the points to the control positions @p x.
    void
    update(const std::vector<double> &x);
    /// The velocity at the start of a step, at the points of update(), which
    /// have to be those at the start, too; collective.
    void
    start(const fluid::VelocityField &velocity);
    /// Adds the integral, N all around the axis, for a step of length @p dt
    /// from start() to the present points and flow; the stress is the mean over
    /// the step. Collective.
    void
    add_load(double                         dt,
             const fluid::DistributedArray &pressure,
             const fluid::VelocityField    &velocity,
             std::vector<double>           &load);

  private:
    static constexpr int n_values = 7; ///< v, grad v, p at a point

    /// Velocity, its gradient and the pressure (if given) at the points.
    void
    sample(const fluid::VelocityField    &velocity,
           const fluid::DistributedArray *pressure,
           std::vector<double>           &values) const;
    int
    size() const
    {
      return static_cast<int>(weight.size());
    }

    struct Point
    {
      double  r, y, area;    ///< m, m, m^2
      double  inverse[2][2]; ///< d theta^k / d x_c
      Stencil v_r, v_r_r, v_r_y, v_y, v_y_r, v_y_y, p;
    };

    MovingLeastSquares                 mls;
    double                             density, viscosity;
    SparseRows                         R;      ///< points by control points
    std::array<std::vector<double>, 2> dR;     ///< by theta^k, pattern of R
    std::vector<double>                weight; ///< dtheta^1 dtheta^2
    std::vector<Point>                 points;
    std::vector<double>                old_r, old_y, old_values;
  };
} // namespace ephyra::immersed_boundary
