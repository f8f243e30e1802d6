#pragma once

#include "ephyra/fluid/velocity_field.h"
#include "ephyra/immersed_boundary/markers.h"
#include "ephyra/immersed_boundary/moving_least_squares.h"

#include <array>
#include <vector>

namespace ephyra::immersed_boundary
{
  /// Loads of the fluid on the surface through probes along the outward normal
  /// (Nitti et al. 2020, 10.1016/j.cma.2020.112977): with a probe at
  /// x + h n, h = `probe_length` cells, the pressure at the wall is
  ///   p(h)                    `probe`,
  ///   p(h) + rho h a.n        `acceleration`: the momentum equation at a wall
  ///                           with acceleration a, friction left out,
  ///   2 p(h) - p(2h)          `linear`.
  /// The viscous traction is mu (L + L^T) n with the velocity gradient L either
  /// at the probe (`one_point`), or at the wall, L = (dv/dn) n^T + (dV/ds) t^T,
  /// with dV/ds of the wall and a parabola through the wall, h and 2h
  /// (`quadratic`),
  ///   dv/dn = (-3 V + 4 v(h) - v(2h)) / (2h).
  /// A probe that would lie outside of the grid or in a body is drawn towards
  /// the wall by halves (counted; see n_shortened_probes()); where only the
  /// point at 2h does, h alone is used: the difference from the wall for the
  /// friction, `acceleration` for the pressure.
  class SurfaceLoads
  {
  public:
    /// @p density kg/m^3 and dynamic @p viscosity Pa s of the fluid.
    SurfaceLoads(const fluid::StaggeredGrid &grid,
                 double                      density,
                 double                      viscosity,
                 const Parameters           &parameters = Parameters());

    /// Probes for the present positions of the markers. Throws DivergedError
    /// where no probe fits between the surface and what is opposite.
    void
    update(const Markers &markers);

    /// Evaluates the traction; markers as in update(), pressure in Pa, velocity
    /// in m/s, boundary values set; collective.
    void
    evaluate(const Markers                 &markers,
             const fluid::DistributedArray &pressure,
             const fluid::VelocityField    &velocity);

    /// Traction on the surface, Pa: all radial components, then all axial ones.
    const std::vector<double> &
    traction() const
    {
      return t;
    }
    const std::vector<double> &
    wall_pressure() const
    {
      return p_wall;
    }

    /// Force of each marker all around the axis, traction times 2 pi r ds, N;
    /// Markers::to_control_points() makes consistent nodal loads of it.
    std::vector<double>
    marker_forces(const Markers &markers) const;

    /// Axial force, N, on the markers of the curves [first, last): by pressure
    /// and by friction.
    struct AxialForce
    {
      double pressure = 0, friction = 0;
      double
      total() const
      {
        return pressure + friction;
      }
    };
    AxialForce
    axial_force(const Markers &markers, int first_curve, int last_curve) const;

    int
    n_shortened_probes() const
    {
      return n_shortened;
    }

  private:
    struct Probe
    {
      std::array<Stencil, 2> p; ///< at h and 2h
      std::array<Stencil, 4> v; ///< see source
      double                 h;
      bool                   has_second;
    };

    MovingLeastSquares  mls;
    double              density, viscosity;
    Parameters          parameters;
    std::vector<Probe>  probes;
    std::vector<double> t, p_wall, sums;
    int                 n_shortened = 0;
  };
} // namespace ephyra::immersed_boundary
