#pragma once

#include <string>

namespace ephyra
{
  class ParameterHandler;
}

namespace ephyra::immersed_boundary
{
  /// Weight of the moving least squares in one direction, with d the distance
  /// over the half width of the support.
  enum class WeightFunction
  {
    exponential, ///< exp(-(d / width)^2)
    cubic_spline ///< 2/3 - 4d^2 + 4d^3, then 4/3 (1 - d)^3
  };

  /// How the marker forces follow from the missing velocities.
  enum class ForcingSolver
  {
    sweeps,        ///< a number of forcing sweeps
    scaled_sweeps, ///< the same, exact for forces that are equal all along
    exact          ///< no-slip at the markers before the projection
  };

  /// Friction at the wall from the velocity off the wall.
  enum class FrictionFormula
  {
    one_point,   ///< velocity gradient at the probe
    quadratic,   ///< parabola through the wall, h and 2h
    extrapolated ///< parabola through h, 2h and 3h
  };

  /// Pressure at the wall from the pressure off the wall.
  enum class WallPressure
  {
    probe,        ///< p(h)
    acceleration, ///< p(h) + rho h a.n
    linear        ///< 2 p(h) - p(2h)
  };

  /// Load of the fluid on a deformable body in the schemes that iterate.
  enum class Load
  {
    automatic, ///< forcing where the flow takes one projection a step
    probes,    ///< traction at the probes
    forcing ///< opposite of the forcing, with the momentum of the fluid inside
  };

  /// Parameters of the immersed boundary, section "Immersed boundary" of a
  /// scene. Lengths are multiples of the local cell size.
  struct Parameters
  {
    double         marker_spacing    = 0.5;
    double         largest_spacing   = 1.;
    WeightFunction weight            = WeightFunction::exponential;
    double         half_width        = 1.6;
    double         exponential_width = 0.3;

    ForcingSolver forcing_solver = ForcingSolver::scaled_sweeps;
    int           forcing_sweeps = 3;
    double        inward_shift   = 0.25;

    /// Of converge_no_slip(), for rigid bodies that are not free and for
    /// deformable bodies in schemes that iterate; 0: off.
    int    no_slip_iterations = 0;
    double no_slip_tolerance  = 1e-3; ///< m/s

    Load            load          = Load::automatic;
    double          probe_length  = 1.5;
    WallPressure    wall_pressure = WallPressure::acceleration;
    FrictionFormula friction      = FrictionFormula::quadratic;

    /// Report slip and leakage on the surface as well.
    bool surface_slip = false;
    /// Report the roughness of the load on a deformable body.
    bool load_roughness = false;

    static void
    declare(ParameterHandler &prm);
    /// Automatic choices: cubic spline, sweeps and linear pressure for
    /// @p rigid_bodies, else exponential, scaled sweeps and acceleration.
    void
    parse(ParameterHandler &prm, bool rigid_bodies = false);

    /// Weight function and forcing in words, for the log.
    std::string
    description() const;
  };
} // namespace ephyra::immersed_boundary
