#pragma once

#include "ephyra/geometry/body_patch.h"
#include "ephyra/geometry/discretization.h"

namespace ephyra::geometry
{
  /// A flat surface at the height @p y, from the axis to the radius; its
  /// normal points upwards.
  BodyCurve
  make_disk_surface(double                radius,
                    double                y,
                    const Discretization &discretization);

  /// The surface of a cylinder from the height @p bottom upwards; its normal
  /// points away from the axis.
  BodyCurve
  make_cylinder_surface(double                radius,
                        double                length,
                        double                bottom,
                        const Discretization &discretization);

  /// The upper half of an ellipsoid of revolution, from its apex on the axis
  /// to its equator, a the radial and b the axial half axis.
  BodyCurve
  make_hemi_ellipsoid(double                a,
                      double                b,
                      double                center,
                      const Discretization &discretization);

  /// The outline of a spheroid, from the upper end of the axis to the lower; a
  /// sphere for a = b.
  BodyCurve
  make_spheroid(double                a,
                double                b,
                double                center,
                const Discretization &discretization);

  /// The outline of a torus: the circle of radius @p core_radius at the
  /// distance @p ring_radius from the axis, clockwise from its upper end.
  BodyCurve
  make_torus(double                ring_radius,
             double                core_radius,
             double                center,
             const Discretization &discretization);
} // namespace ephyra::geometry
