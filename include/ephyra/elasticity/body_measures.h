#pragma once

#include "ephyra/elasticity/material.h"
#include "ephyra/splines/nurbs_patch.h"

#include <array>

namespace ephyra::elasticity
{
  /// Integrals of a body over the full revolution.
  struct BodyMeasures
  {
    double mass;           ///< kg
    double volume;         ///< m^3, deformed
    double volume_change;  ///< relative to the volume at rest
    double centre_of_mass; ///< axial position, m
    double momentum;       ///< axial, kg m/s
    double elastic_energy; ///< J
    double kinetic_energy; ///< J
    double smallest_J;     ///< over the Gauss points
    double largest_J;
  };

  /// What is known at one parametric point, for output.
  struct PointFields
  {
    splines::Point displacement; ///< m
    double         pattern;      ///< f_a
    double         activation;   ///< gamma, between the Gauss lines linear
    double         J;
    /// Of material lines along theta^1, theta^2 and the hoop.
    std::array<double, 3> stretch;
    AxisymmetricTensor    cauchy; ///< Pa: rr, ry, yr, yy, hoop
  };
} // namespace ephyra::elasticity
