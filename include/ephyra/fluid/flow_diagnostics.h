#pragma once

#include "ephyra/fluid/velocity_field.h"

#include <limits>

namespace ephyra::fluid
{
  // Integrals over the whole domain, the angle included, unless said
  // otherwise. All are collective; ghosts and halo rows must be valid.

  /// Largest |div v|, 1/s.
  double
  max_divergence(const VelocityField &velocity);

  /// Largest |div v| over (largest |v_r|/dr + |v_y|/dy): dimensionless.
  double
  relative_divergence(const VelocityField &velocity);

  /// rho/2 int v^2 dV with the weights in which convection conserves it, J.
  double
  kinetic_energy(const VelocityField &velocity, double density);

  /// rho int v_y dV, kg m/s.
  double
  axial_momentum(const VelocityField &velocity, double density);

  /// int 2 mu e:e dV, e the rate of strain, W.
  double
  dissipation(const VelocityField &velocity, double viscosity);

  /// A rectangle of the half plane, m; sides may be infinite.
  struct Region
  {
    double r_min = 0, r_max = std::numeric_limits<double>::infinity();
    double y_min = -std::numeric_limits<double>::infinity();
    double y_max = std::numeric_limits<double>::infinity();

    bool
    contains(const double r, const double y) const
    {
      return r >= r_min && r <= r_max && y >= y_min && y <= y_max;
    }
  };

  /// Integrals over the half plane with omega = d v_r/dy - d v_y/dr.
  struct VorticityIntegrals
  {
    double positive = 0; ///< int max(omega, 0) dr dy, m^2/s
    double negative = 0; ///< int min(omega, 0) dr dy, m^2/s
    double impulse  = 0; ///< pi rho int omega r^2 dr dy, axial, kg m/s
    double
    circulation() const ///< int omega dr dy, m^2/s
    {
      return positive + negative;
    }
  };

  /// Over the cells with their centre in the region, in one pass.
  VorticityIntegrals
  vorticity_integrals(const VelocityField &velocity,
                      double               density,
                      const Region        &region = {});

  enum class Side
  {
    lower,
    upper,
    outer
  };

  /// Which sign of the vorticity counts.
  enum class VorticitySign
  {
    all,
    positive,
    negative
  };

  /// int omega dr dy of one sign, m^2/s.
  double
  circulation(const VelocityField &velocity,
              const Region        &region = {},
              VorticitySign        sign   = VorticitySign::all);

  /// Circulation that the flow carries into a region through one of its sides,
  /// with v_n into the region and s along the side, m^2/s^2.
  struct VorticityFlux
  {
    double total = 0; ///< int v_n omega ds
    /// The part of omega from the change of v_n along the side: +-int v_n
    /// d v_n/ds ds. U^2/2 for a jet of the speed U on the axis, whatever its
    /// profile; the rest of the total is the fluid turning at the side.
    double shear = 0;
  };

  /// The side is the line of cell faces next to that limit of the region.
  VorticityFlux
  vorticity_flux(const VelocityField &velocity,
                 const Region        &region,
                 Side                 side);
} // namespace ephyra::fluid
