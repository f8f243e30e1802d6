#pragma once

#include "ephyra/geometry/body_patch.h"
#include "ephyra/geometry/discretization.h"

namespace ephyra::geometry
{
  /// A tube about the axis with its lower end at the height @p bottom, m.
  /// theta^1 runs downwards from the upper end, theta^2 outwards. An inner
  /// radius of zero makes a solid rod, whose side theta^2 = 0 is on the axis.
  BodyPatch
  make_tube(double                inner_radius,
            double                outer_radius,
            double                length,
            double                bottom,
            const Discretization &discretization);

  /// A plate with its lower face at the height @p bottom, m. theta^1 runs from
  /// the axis to the rim, theta^2 upwards.
  BodyPatch
  make_disk(double                radius,
            double                thickness,
            double                bottom,
            const Discretization &discretization);

  enum class SphereSection
  {
    quarter, ///< from the upper axis to the plane y = center, a dry side
    half     ///< from the upper axis to the lower one
  };

  /// A shell between two spheres of one centre at the height @p center, m.
  /// theta^1 runs from the upper axis clockwise, theta^2 outwards. The half
  /// section has a knot of multiplicity degree at the equator.
  BodyPatch
  make_hollow_sphere(double                inner_radius,
                     double                outer_radius,
                     SphereSection         section,
                     double                center,
                     const Discretization &discretization);
} // namespace ephyra::geometry
