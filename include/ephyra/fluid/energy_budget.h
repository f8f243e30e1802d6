#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/base/record.h"
#include "ephyra/fluid/boundary.h"
#include "ephyra/fluid/flow_parameters.h"
#include "ephyra/fluid/velocity_field.h"

namespace ephyra::fluid
{
  /// Energy of a flow since its start, J, all around the axis:
  ///   change of kinetic energy
  ///     = work of the forcing - dissipation + work at the sides
  ///       + work of the body force + energy through the moving window
  ///       + imbalance.
  /// The kinetic energy of the staggered grid (weights w of the faces' control
  /// volumes) changes over a stage by rho sum w (u' - u).(u' + u)/2. So every
  /// term is the work of its operator on the mean velocity (u' + u)/2, summed
  /// by parts to what acts inside and what acts through the sides. Pressure and
  /// convection act through the sides alone (the mean velocity is free of
  /// divergence, convection is skew-symmetric), viscosity inside by
  ///   mu sum [(d(r v_r)/dr / r)^2 + (dv_r/dy)^2 + (dv_y/dr)^2 + (dv_y/dy)^2],
  /// whose integral is that of 2 mu e:e up to terms at the sides. Nothing is
  /// approximate in space: the imbalance is what convection and viscosity
  /// extrapolated in time do beside those of the mean velocity.
  class EnergyBudget
  {
  public:
    EnergyBudget(const FlowParameters &parameters,
                 const StaggeredGrid  &grid,
                 const Boundary       &boundary);

    /// The energy at the start of the run; collective.
    void
    start(const VelocityField &velocity);
    /// What the pressure did in a stage: factors of the one at its start and of
    /// its correction, s.
    struct Pressure
    {
      const DistributedArray &start, &correction;
      double                  time_of_start, time_of_correction;
    };
    /// One stage of @p step (s), from a velocity to another, ghosts of all
    /// fields valid; @p body_force per volume (N/m^3). Collective.
    void
    add_stage(const VelocityField &before,
              const VelocityField &after,
              const Pressure      &pressure,
              double               step,
              double               body_force);
    /// Work of the forces of bodies on the fluid, J.
    void
    add_forcing(const double work)
    {
      forcing += work;
    }
    /// A moving window has taken up and left behind fluid: the change of energy
    /// in it, J.
    void
    add_window(const double energy)
    {
      window += energy;
    }
    double
    work_of_forcing() const
    {
      return forcing;
    }

    /// Of the present velocity, collective: adds all terms, that of the forcing
    /// where there are @p bodies. Returns the imbalance, J.
    double
    evaluate(const VelocityField &velocity, bool bodies, Record &record) const;
    /// Without the energy through the window where the fields keep its motion.
    void
    serialize(Archive &archive, bool with_window);

  private:
    struct Powers
    {
      double dissipation = 0, sides = 0, body_force = 0;
    };
    void
    add_inside(const VelocityField &before,
               const VelocityField &after,
               Powers              &power) const;
    void
    add_lower_or_upper(bool                 upper,
                       const VelocityField &before,
                       const VelocityField &after,
                       const Pressure      &pressure,
                       double               step,
                       Powers              &work) const;
    void
    add_outer(const VelocityField &before,
              const VelocityField &after,
              const Pressure      &pressure,
              double               step,
              Powers              &work) const;

    const StaggeredGrid &grid;
    const Boundary      &boundary;
    const double         density, viscosity; ///< kg/m^3, Pa s
    const bool           convection, has_window, has_body_force;
    const bool           open_lower, open_upper, open_outer; ///< pressure given

    double start_energy = 0, forcing = 0, dissipation = 0, sides = 0,
           body_force_work = 0, window = 0; ///< J
  };
} // namespace ephyra::fluid
