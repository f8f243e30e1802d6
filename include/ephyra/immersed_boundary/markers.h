#pragma once

#include "ephyra/base/exceptions.h"
#include "ephyra/fluid/staggered_grid.h"
#include "ephyra/immersed_boundary/boundary_curve.h"
#include "ephyra/immersed_boundary/parameters.h"

#include <vector>

namespace ephyra::immersed_boundary
{
  /// A body has come to the end of the flow grid: no shorter step helps.
  class LeftTheGrid : public DivergedError
  {
  public:
    using DivergedError::DivergedError;
  };

  /// Sparse rows of a small matrix that every rank holds.
  struct SparseRows
  {
    std::vector<int>    start{0}; ///< n_rows + 1
    std::vector<int>    column;
    std::vector<double> value;

    int
    n_rows() const
    {
      return static_cast<int>(start.size()) - 1;
    }
  };

  /// What is known at the markers, in SI units; replicated on all ranks.
  struct MarkerState
  {
    std::vector<double> r, y;             ///< position, m
    std::vector<double> v_r, v_y;         ///< velocity, m/s
    std::vector<double> a_r, a_y;         ///< acceleration, m/s^2
    std::vector<double> t_r, t_y;         ///< unit tangent along the curve
    std::vector<double> n_r, n_y;         ///< unit normal, into the fluid
    std::vector<double> length;           ///< of the marker's arc now, m
    std::vector<double> dv_r_ds, dv_y_ds; ///< dv/ds along the tangent, 1/s
  };

  /// The Lagrangian markers on the wetted surfaces. A marker stands for an arc
  /// [theta - dtheta/2, theta + dtheta/2] of its curve; arcs cover the curves
  /// without gap and never straddle a C0 knot. They are placed at equal
  /// distances in units of the local grid cell,
  ///   (ds/Delta)^2 = (dr/Delta_r)^2 + (dy/Delta_y)^2,
  /// so that cells of any aspect ratio see the same density. Position =
  /// sum_i R_i x_i by a precomputed matrix; arc length = |dx/dtheta| dtheta.
  class Markers
  {
  public:
    /// Places the markers for the control positions @p x (2 per point). Throws
    /// InputError where the surface lies outside the grid.
    Markers(std::vector<BoundaryCurve>  curves,
            const std::vector<double>  &x,
            const fluid::StaggeredGrid &grid,
            const Parameters           &parameters = Parameters());

    /// Places the markers anew, close enough for each of the @p shapes that a
    /// body takes; they are at rest in the last one until move().
    void
    distribute(const std::vector<std::vector<double>> &shapes,
               const fluid::StaggeredGrid             &grid);

    /// Position, velocity and acceleration of the control points to markers.
    /// Throws DivergedError where an arc has collapsed or is not finite.
    void
    move(const std::vector<double> &x,
         const std::vector<double> &velocity,
         const std::vector<double> &acceleration);

    int
    size() const
    {
      return static_cast<int>(theta_of.size());
    }
    const MarkerState &
    state() const
    {
      return now;
    }
    const std::vector<BoundaryCurve> &
    curves() const
    {
      return boundary;
    }
    int
    curve(const int marker) const
    {
      return curve_of[marker];
    }
    double
    theta(const int marker) const
    {
      return theta_of[marker];
    }
    /// Length of the arc in the parameter of its curve.
    double
    parametric_weight(const int marker) const
    {
      return dtheta[marker];
    }
    /// First marker of each curve, and one past the last.
    const std::vector<int> &
    first_of_curve() const
    {
      return first;
    }

    /// Rows: markers, columns: control points.
    const SparseRows &
    shape() const
    {
      return R;
    }

    /// Largest distance of neighbouring markers in units of the local cell.
    double
    largest_spacing(const fluid::StaggeredGrid &grid) const;
    /// Throws LeftTheGrid where a marker has left it, naming the curve and the
    /// place.
    void
    check_inside(const fluid::StaggeredGrid &grid) const;
    /// The same, and where the largest spacing exceeds the limit.
    void
    check(const fluid::StaggeredGrid &grid) const;

    /// Consistent loads: transposed shape matrix times the marker forces (all
    /// radial components, then all axial ones); result 2 per control point.
    void
    to_control_points(const std::vector<double> &marker_force,
                      std::vector<double>       &control_force) const;

  private:
    void
    place_on_curve(int                                     c,
                   const std::vector<std::vector<double>> &shapes,
                   const fluid::StaggeredGrid             &grid);

    std::vector<BoundaryCurve> boundary;
    Parameters                 parameters;
    std::vector<double>        theta_of, dtheta;
    std::vector<int>           curve_of, first;
    SparseRows                 R, dR; ///< dR: derivatives, same pattern
    MarkerState                now;
  };

  /// Length of the vector (a_r, a_y) in cells of the grid at (r, y).
  double
  length_in_cells(const fluid::StaggeredGrid &grid,
                  double                      r,
                  double                      y,
                  double                      a_r,
                  double                      a_y);
} // namespace ephyra::immersed_boundary
