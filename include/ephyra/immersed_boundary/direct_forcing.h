#pragma once

#include "ephyra/fluid/flow_solver.h"
#include "ephyra/immersed_boundary/markers.h"
#include "ephyra/immersed_boundary/moving_least_squares.h"

#include <Eigen/LU>
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
  /// T = sum_{k<n} (I - M)^k, done among the markers. In a force that changes
  /// little along the surface M acts like a factor m < 1, the sum of its row, and
  /// (1 - m)^n is left. Held against a steady pressure difference across the
  /// wall such a force lets fluid through. `scaled sweeps`: T = sum_{k<n}
  /// (I - D M)^k D, D = diag(1 / m), which leaves nothing. `exact`: T = M^-1, by the
  /// symmetric form of M (c_l^1/2 Phi Phi^T c_l^1/2), with a shift of 1e-8 that
  /// lets it be factored where markers are denser than nodes can tell apart.
  ///
  /// Where viscosity is implicit, forces act through A^-1, A = (1 - a L_r)
  /// (1 - a L_y), like every other term of the momentum equation:
  ///   u = u* + A^-1 S F,   [G + theta (T^-1 - M)] F = V - J u*,   G = J A^-1 S,
  /// that is F = T B^-1 (V - J u*), B = G T + theta (I - M T). The slip that
  /// is left for a force is theta (T^-1 - M) F, as with explicit viscosity
  /// (where G = M and B = I); theta = min(1, h_e / h) with a stage h_e at the
  /// explicit limit keeps it, for a given force in time, from growing with
  /// the step h. G is dense among the markers, made of the responses of single
  /// lines since A^-1 is a product.
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

    /// The viscous operator of a stage, for solve() and add(). After update(),
    /// before each stage. Every rank for itself.
    void
    prepare(const fluid::FlowSolver &flow, unsigned int stage);

    /// J u from the rows held here, completed by one reduction; collective.
    /// Boundary values of u have to be set, halo rows are not used.
    void
    interpolate(const fluid::VelocityField &u, std::vector<double> &Ju) const;

    /// F = T residual, or T B^-1 residual; every rank for itself.
    void
    solve(const std::vector<double> &residual, std::vector<double> &F) const;

    /// Adds S F to the rows held here; not collective, halo rows are left.
    void
    spread(const std::vector<double> &F, fluid::VelocityField &u) const;

    /// Work of the increments S F on a fluid of density one in a stage between
    /// two velocities, m^5/s^2: the change of its kinetic energy that they make
    /// up, the sum of S F times the mean velocity over all control volumes;
    /// collective.
    double
    work(const std::vector<double>  &F,
         const fluid::VelocityField &before,
         const fluid::VelocityField &after) const;

    /// velocity() of the flow += A^-1 S F in the stage of prepare();
    /// collective.
    void
    add(const std::vector<double> &F,
        fluid::FlowSolver         &flow,
        unsigned int               stage) const;

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
    /// The forces of a component for residuals that are the columns of @p R,
    /// as solve() finds them: T R, or T B^-1 R, which is dense.
    Matrix
    forces(int component, const Matrix &R) const;

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
    struct Viscous  /// factors of B for one length of a stage
    {
      double                               step; ///< s
      Eigen::PartialPivLU<Eigen::MatrixXd> B[2];
    };

    /// Fills Nodes::spread and returns c_l.
    double
    set_spreading(int component, double shell, Nodes &node) const;
    void
    assemble(int component);
    /// G of a component, dense.
    Eigen::MatrixXd
    viscous_matrix(const fluid::FlowSolver &flow,
                   unsigned int             stage,
                   int                      component) const;

    MovingLeastSquares                 mls;
    Parameters                         parameters;
    std::array<std::vector<Nodes>, 2>  nodes;
    std::vector<double>                w;
    std::vector<double>                rate;  ///< 1 / Delta_r^2 + 1 / Delta_y^2
    std::array<std::vector<double>, 2> scale; ///< c_l
    std::array<Matrix, 2>              M;
    std::array<Eigen::VectorXd, 2>     relaxation; ///< D
    mutable std::array<Matrix, 2>      T;
    mutable std::array<bool, 2>        T_valid{{false, false}};
    std::array<std::unique_ptr<Inverse>, 2> inverse;
    std::vector<std::unique_ptr<Viscous>>   viscous; ///< since update()
    const Viscous *present_viscous = nullptr; ///< of prepare(); or explicit
  };
} // namespace ephyra::immersed_boundary
