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
  /// The viscous traction is mu (L + L^T) n with the velocity gradient L at
  /// the probe (`one_point`), or at the wall, L = (dv/dn) n^T + (dV/ds) t^T with
  /// dV/ds of the wall and
  ///   dv/dn = (-3 V + 4 v(h) - v(2h)) / (2h)          `quadratic`,
  ///   dv/dn = (-5 v(h) + 8 v(2h) - 3 v(3h)) / (2h)    `extrapolated`,
  /// the slopes at the wall of parabolas through the wall and two points, or
  /// through three points beyond the zone over which the forcing is spread.
  /// A probe that would lie outside of the grid or in a body is drawn towards
  /// the wall by halves (counted; see n_shortened_probes()); where only the
  /// farther points do, the formulas with fewer points are used: `quadratic`,
  /// then the difference between h and the wall; `acceleration`.
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
      double                 h;
      int                    n_points; ///< at h, 2h, 3h that can be used
      std::array<Stencil, 2> p;
      /// Of each component: values at the points, or derivatives by r and y.
      std::array<std::array<Stencil, 3>, 2> v;
    };

    MovingLeastSquares  mls;
    double              density, viscosity;
    Parameters          parameters;
    std::vector<Probe>  probes;
    std::vector<double> t, p_wall, sums;
    int                 n_shortened = 0;
  };
} // namespace ephyra::immersed_boundary
