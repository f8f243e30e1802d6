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
  };

  /// Which sign of the vorticity counts; omega = d v_r/dy - d v_y/dr.
  enum class VorticitySign
  {
    all,
    positive,
    negative
  };

  /// int omega dr dy over the cells with their centre in the region, m^2/s.
  double
  circulation(const VelocityField &velocity,
              const Region        &region = {},
              VorticitySign        sign   = VorticitySign::all);

  /// pi rho int omega r^2 dr dy, the axial impulse of vorticity, kg m/s.
  double
  vortex_impulse(const VelocityField &velocity,
                 double               density,
                 const Region        &region = {});
} // namespace ephyra::fluid
