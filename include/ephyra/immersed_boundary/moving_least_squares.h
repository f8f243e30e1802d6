#pragma once

#include "ephyra/fluid/distributed_array.h"
#include "ephyra/immersed_boundary/parameters.h"

#include <array>

namespace ephyra::immersed_boundary
{
  /// Nodes and values of a shape function phi or of its derivative: the field
  /// at the point is sum over a, b of value[a][b] u(row[a], column[b]). Near
  /// the axis rows may occur twice (mirrored ghost rows are folded back).
  struct Stencil
  {
    std::array<int, 3>                   row, column;
    std::array<std::array<double, 3>, 3> value;

    /// The part of the sum over the rows [begin, end); the rows of all ranks
    /// add up to the field at the point.
    double
    apply(const fluid::DistributedArray &u, int begin, int end) const;
  };

  /// Moving least squares on 3 x 3 nodes around the node nearest to a point,
  /// with the linear basis (1, r, y) and the weight W_i(r) W_j(y) (Vanella &
  /// Balaras 2009, 10.1016/j.jcp.2009.06.003; de Tullio & Pascazio 2016,
  /// 10.1016/j.jcp.2016.08.020).
  ///
  /// For a separable weight the 3 x 3 moment matrix is diagonal about the
  /// weighted centroid. With w_i normalised to sum 1, centroid m = sum w_i xi_i
  /// and variance s = sum w_i (xi_i - m)^2 in each direction (xi from the
  /// point), and q_i = -m (xi_i - m) w_i / s,
  ///   phi_ij = w_i w_j + q_i w_j + w_i q_j,
  /// and the gradient of the fitted plane is
  ///   dphi_ij/dr = (xi_i - m) w_i w_j / s, and likewise along y.
  /// Both are exact for linear fields on any tensor grid.
  ///
  /// The support is moved inwards at the outer wall and at the ends in y, and
  /// wraps around in a periodic y. At the axis the radial velocity is odd, the
  /// axial velocity and the pressure even.
  class MovingLeastSquares
  {
  public:
    MovingLeastSquares(const fluid::StaggeredGrid &grid,
                       const Parameters           &parameters);

    /// Shape functions of one direction.
    struct Line
    {
      std::array<int, 3>    index;
      std::array<double, 3> weight;     ///< w_i
      std::array<double, 3> correction; ///< q_i
      std::array<double, 3> slope;      ///< (xi_i - m) w_i / s, 1/m
    };
    Line
    r_faces(double r) const; ///< odd at the axis: radial velocity
    Line
    r_centres(double r) const; ///< even at the axis
    Line
    y_faces(double y) const;
    Line
    y_centres(double y) const;

    static Stencil
    value(const Line &r, const Line &y);
    static Stencil
    derivative_r(const Line &r, const Line &y);
    static Stencil
    derivative_y(const Line &r, const Line &y);

    /// Whether the point lies in the grid, r >= 0.
    bool
    contains(double r, double y) const;

    /// Local width of the cells along the unit vector (n_r, n_y): the root of
    /// (n_r Delta_r)^2 + (n_y Delta_y)^2, interpolated at a point given by its
    /// shape functions on the centres.
    double
    cell_size(const Line &r_centres,
              const Line &y_centres,
              double      n_r,
              double      n_y) const;

    const fluid::StaggeredGrid &
    grid() const
    {
      return *the_grid;
    }

  private:
    template <class Position>
    Line
    line(
      double x, int nearest, int lowest, int highest, const Position &) const;
    double
    weight(double distance) const;
    double
    wrapped(double y) const;

    const fluid::StaggeredGrid *the_grid;
    WeightFunction              weight_function;
    double                      half_width;
    double                      exponential_width;
  };
} // namespace ephyra::immersed_boundary
