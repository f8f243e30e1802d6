#pragma once

#include "ephyra/fluid/velocity_field.h"
#include "ephyra/immersed_boundary/markers.h"
#include "ephyra/immersed_boundary/moving_least_squares.h"

#include <Eigen/SparseCore>

#include <array>
#include <memory>
#include <vector>

namespace ephyra::immersed_boundary
{
  /// Direct forcing (Uhlmann 2005, 10.1016/j.jcp.2005.03.017) with repeated
  /// sweeps (Breugem 2012, 10.1016/j.jcp.2012.02.026): brings the provisional
  /// velocity u* to the velocity V of the markers,
  ///   F = T (V - J u*),   u = u* + S F.
  /// J interpolates with the moving-least-squares functions phi, S spreads:
  ///   (J u)_l = sum_k phi_k^l u_k,        (S F)_k = sum_l c_l phi_k^l F_l,
  ///   c_l = r_l ds_l eta_l / sum_k phi_k^l r_k dA_k,
  ///   eta_l = sqrt((n_r Delta_r)^2 + (n_y Delta_y)^2).
  /// F is a velocity increment (m/s) on a shell of thickness eta_l, so that the
  /// impulse given to the fluid is exactly that of the shell,
  ///   rho sum_k (S F)_k 2 pi r_k dA_k = rho sum_l w_l F_l,
  ///   w_l = 2 pi r_l ds_l eta_l.
  /// eta_l is the cell size for square cells; along a surface that follows flat
  /// cells it is their thickness, which keeps the spectrum of M = J S within
  /// [0, 1]. Nodes on the boundary of the grid, whose values are prescribed,
  /// take no part in S.
  ///
  /// `sweeps`: r = V - J u*, then n times F += r, r -= M r; that is
  /// T = sum_{k<n} (I - M)^k, done among the markers. `exact`: T = M^-1, by the
  /// symmetric form of M (c_l^1/2 Phi Phi^T c_l^1/2), with a shift of 1e-8 that
  /// lets it be factored where markers are denser than nodes can tell apart.
  ///
  /// Marker vectors hold all radial components first, then all axial ones.
  class DirectForcing
  {
  public:
    using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    DirectForcing(const fluid::StaggeredGrid &grid,
                  const Parameters           &parameters = Parameters());
    ~DirectForcing();

    /// Stencils and M for the present marker positions. Throws DivergedError
    /// where a marker has left the grid or the markers are too far apart.
    void
    update(const Markers &markers);

    /// J u from the rows held here, completed by one reduction; collective.
    /// Boundary values of u have to be set, halo rows are not used.
    void
    interpolate(const fluid::VelocityField &u, std::vector<double> &Ju) const;

    /// F = T residual; every rank for itself.
    void
    solve(const std::vector<double> &residual, std::vector<double> &F) const;

    /// Adds S F to the rows held here; not collective, halo rows are left.
    void
    spread(const std::vector<double> &F, fluid::VelocityField &u) const;

    /// w_l, m^3: the impulse on the fluid (N s, all around the axis) of marker
    /// l is density * w_l * F.
    const std::vector<double> &
    impulse_weights() const
    {
      return w;
    }

    /// M = J S of a component (0: radial, 1: axial).
    const Matrix &
    marker_matrix(const int component) const
    {
      return M[component];
    }
    /// T of a component, assembled on the first call after update().
    const Matrix &
    transfer(int component) const;

    int
    n_markers() const
    {
      return static_cast<int>(w.size());
    }

  private:
    struct Nodes /// of one marker and component
    {
      Stencil               phi;
      std::array<double, 9> spread; ///< c_l phi, 0 at prescribed nodes
    };
    struct Inverse; ///< factors of the symmetric form of M

    /// Fills Nodes::spread and returns c_l.
    double
    set_spreading(int component, double shell, Nodes &node) const;
    void
    assemble(int component);

    MovingLeastSquares                      mls;
    Parameters                              parameters;
    std::array<std::vector<Nodes>, 2>       nodes;
    std::vector<double>                     w;
    std::array<std::vector<double>, 2>      scale; ///< c_l
    std::array<Matrix, 2>                   M;
    mutable std::array<Matrix, 2>           T;
    mutable std::array<bool, 2>             T_valid{{false, false}};
    std::array<std::unique_ptr<Inverse>, 2> inverse;
  };
} // namespace ephyra::immersed_boundary
