#pragma once

#include "ephyra/fluid/boundary.h"
#include "ephyra/fluid/velocity_field.h"

namespace ephyra::fluid
{
  /// Directions in which the viscous terms are implicit.
  struct ImplicitDirections
  {
    bool r = false, y = false;
    bool
    any() const
    {
      return r || y;
    }
  };

  /// One row of a viscous operator along r:
  /// plus u_(i+1) - centre u_i + minus u_(i-1), 1/m^2.
  struct ViscousStencil
  {
    double minus, centre, plus;
  };
  /// d/dr (1/r d(r v_r)/dr) at the face i > 0.
  ViscousStencil
  radial_stencil_of_v_r(const StaggeredGrid &grid, int i);
  /// 1/r d/dr (r d v_y/dr) in row i.
  ViscousStencil
  radial_stencil_of_v_y(const StaggeredGrid &grid, int i);

  /// Convective, viscous and pressure terms of eq. (47) on the staggered grid.
  ///
  /// Control volumes of v_r hold half of the cells on either side, r gap dy;
  /// those of v_y likewise, rc dr gap. The mass fluxes through their faces are
  /// means of the fluxes through cell faces, so each control volume keeps its
  /// mass where the cells do, and velocities on them are plain means of the
  /// two neighbours: convection is skew-symmetric, momentum and kinetic energy
  /// (weights as above) are conserved on any tensor grid (Verzicco & Orlandi
  /// 1996, 10.1006/jcph.1996.0033). Second order on smooth grids.
  ///   L v_r = d/dr (1/r d(r v_r)/dr) + d2 v_r/dy2
  ///   L v_y = 1/r d/dr (r d v_y/dr) + d2 v_y/dy2
  class Momentum
  {
  public:
    Momentum(const FlowParameters &parameters,
             const StaggeredGrid  &grid,
             const Boundary       &boundary);

    /// Factors of one update
    ///   out = u - pressure grad p + beta H(u) + gamma H_old,
    /// H = -convection + explicit viscous terms + body_force e_y. With
    /// implicit directions, out = ... - u + implicit nu L_i u: the increment
    /// that ImplicitViscosity finishes.
    struct Factors
    {
      double             pressure;      ///< alpha dt / rho
      double             beta, gamma;   ///< with dt, s
      double             body_force;    ///< per mass, m/s^2
      bool               store_history; ///< history = H(u)
      double             implicit;      ///< alpha dt, s
      ImplicitDirections directions;
    };

    /// Ghosts and halo rows of u and p must be valid. Sets the faces that
    /// follow from the momentum equation, see Boundary::first_r_face() ...
    void
    update(const VelocityField    &u,
           const DistributedArray &p,
           VelocityField          &history,
           VelocityField          &out,
           const Factors          &factors) const;

    /// u -= factor grad phi on the same faces; @p i: faces between the rows
    /// i - 1 and i, and the axial ones of row i.
    void
    correct_radial(VelocityField          &u,
                   const DistributedArray &phi,
                   double                  factor,
                   int                     i) const;
    void
    correct_axial(VelocityField          &u,
                  const DistributedArray &phi,
                  double                  factor,
                  int                     i) const;

    /// 1/(rc dr) [r_(i+1) v_r(i+1) - r_i v_r(i)] + [v_y(j+1) - v_y(j)]/dy of
    /// row i, times @p factor.
    void
    divergence(const VelocityField &u, double factor, int i, double *row) const;

    /// Viscous operator along y: up (u_(j+1) - u_j) - down (u_j - u_(j-1)) with
    /// these factors, 1/m^2; of v_r in cells j, of v_y on faces j.
    AlignedVector cell_down, cell_up, face_down, face_up;

  private:
    template <bool convection, bool split, bool use_history, bool store_history>
    void
    update_rows(const VelocityField    &u,
                const DistributedArray &p,
                VelocityField          &history,
                VelocityField          &out,
                const Factors          &factors) const;

    const StaggeredGrid &grid;
    const Boundary      &boundary;
    const double         nu;
    const bool           convection;

    AlignedVector inv_width, inv_gap;     ///< 1/dy_j, 1/gap_j
    AlignedVector mean_below, mean_above; ///< of v_r in the radial mass flux
    AlignedVector gradient; ///< of phi: 1/gap, ghosts mirrored at the sides
  };
} // namespace ephyra::fluid
