#pragma once

#include "ephyra/fluid/grid_generation.h"
#include "ephyra/fluid/moving_window.h"

#include <string>

namespace ephyra
{
  class ParameterHandler;
}

namespace ephyra::fluid
{
  /// What holds on one side of the domain (the axis r = 0 needs no choice).
  enum class SideKind
  {
    no_slip,   ///< wall at rest
    free_slip, ///< no flow through, no friction
    velocity,  ///< both components given: moving wall, inflow
    pressure,  ///< pressure given, velocity free (zero normal gradient)
    outflow,   ///< convective outflow that balances the mass
    periodic   ///< lower and upper side together
  };

  struct SideParameters
  {
    SideKind kind = SideKind::no_slip;
    /// Formulas in (s, t), s = r on the lower and upper side, s = y on the
    /// outer side; m/s, m/s, Pa.
    std::string radial_velocity = "0";
    std::string axial_velocity  = "0";
    std::string pressure        = "0";
  };

  enum class TimeScheme
  {
    rk3, ///< three-step Runge-Kutta, eq. (77)
    ab2  ///< Adams-Bashforth, one projection a step
  };

  enum class ViscousTreatment
  {
    automatic, ///< explicit in each direction where the step allows it
    explicit_,
    implicit ///< Crank-Nicolson with approximate factorisation, eq. (78)
  };

  enum class PoissonKind
  {
    automatic, ///< the cheapest that fits the grid
    fft,
    hybrid,
    eigen
  };

  /// The subsection "Fluid". All values SI.
  struct FlowParameters
  {
    double           density   = 1000.; ///< kg/m^3
    double           viscosity = 1e-3;  ///< dynamic, Pa s; 0 is inviscid
    TimeScheme       scheme    = TimeScheme::rk3;
    bool             project_every_substep = true; ///< RK3; else once a step
    ViscousTreatment viscous               = ViscousTreatment::automatic;
    bool             convection            = true;
    bool             energy_budget         = false;
    PoissonKind      poisson               = PoissonKind::automatic;
    GridParameters   grid;
    SideParameters   outer, lower, upper;
    MovingWindowParameters window;
    std::string            initial_radial_velocity = "0"; ///< in (r, y), m/s
    std::string            initial_axial_velocity  = "0"; ///< in (r, y), m/s
    std::string            body_force = "0"; ///< axial, in t, N/m^3

    static void
    declare(ParameterHandler &prm);
    void
    parse(ParameterHandler &prm);

    bool
    periodic_y() const
    {
      return lower.kind == SideKind::periodic;
    }
    double
    kinematic_viscosity() const
    {
      return viscosity / density;
    }
    /// Largest nu dt (4/dr^2 + 4/dy^2) with explicit viscosity, a little below
    /// the measured limits of the schemes, 2.51 and 1.
    double
    explicit_viscous_number() const
    {
      return scheme == TimeScheme::rk3 ? 2.4 : 0.95;
    }
    /// Longest step with explicit viscosity, s; infinite without viscosity.
    double
    explicit_time_step_limit(const GridLine &r, const GridLine &y) const;
    /// Throws InputError where entries contradict each other.
    void
    check() const;
  };
} // namespace ephyra::fluid
