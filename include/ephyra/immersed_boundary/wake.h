#pragma once

#include "ephyra/fluid/velocity_field.h"
#include "ephyra/immersed_boundary/rigid_body.h"
#include "ephyra/immersed_boundary/surface_loads.h"

#include <string>
#include <vector>

namespace ephyra::immersed_boundary
{
  /// Axial velocity on the axis at the faces of y, m/s, by the even parabola in
  /// r through the two rows beside it; collective.
  std::vector<double>
  velocity_on_axis(const fluid::VelocityField &velocity);

  /// The stretch of the axis behind a body on which the fluid runs towards it:
  /// distances from the rear end of the body, m; both 0 where there is none.
  /// `begin` is 0 where the stretch starts within one cell of the rear.
  struct ReversedFlow
  {
    double begin = 0, end = 0;
  };

  /// @p rear is the y of the rear end, @p direction +1 where the wake lies
  /// above it (towards larger y), -1 below, @p body_velocity along y. The ends
  /// of the stretch are interpolated linearly; one that leaves the grid ends
  /// there.
  ReversedFlow
  reversed_flow(const fluid::GridLine     &y,
                const std::vector<double> &velocity_on_axis,
                double                     rear,
                double                     direction,
                double                     body_velocity);

  /// Where the flow leaves the surface: the wall friction changes its sign, from
  /// downstream in front of the point to upstream behind it.
  struct Separation
  {
    std::string where; ///< empty, or the branch of a closed section
    double      angle; ///< from the front, seen from the centre, degrees; 180
                       ///< where the flow stays attached
  };

  /// Separation on a body whose section is one smooth curve (sphere, spheroid,
  /// torus; nothing for others), its curve being @p curve of the markers. On a
  /// torus the outer and the inner branch, angles around the core.
  std::vector<Separation>
  separation(const RigidBody    &body,
             int                 curve,
             const Markers      &markers,
             const SurfaceLoads &loads,
             double              direction);

  /// Wall pressure and friction (traction along the tangent of the curve), Pa,
  /// over the arc length from the start of the first curve, m.
  struct SurfaceProfile
  {
    std::vector<double> arc, pressure, friction;
  };

  SurfaceProfile
  surface_profile(const Markers      &markers,
                  const SurfaceLoads &loads,
                  int                 first_curve,
                  int                 last_curve);
} // namespace ephyra::immersed_boundary
