#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/base/record.h"
#include "ephyra/base/step_status.h"
#include "ephyra/fluid/flow_solver.h"
#include "ephyra/immersed_boundary/direct_forcing.h"
#include "ephyra/immersed_boundary/rigid_body.h"
#include "ephyra/immersed_boundary/surface_loads.h"
#include "ephyra/immersed_boundary/wake.h"

#include <memory>
#include <string>
#include <vector>

namespace ephyra::immersed_boundary
{
  /// A flow around rigid bodies. In each stage of the flow's time scheme the
  /// provisional velocity u* is forced to the velocity of the bodies at the end
  /// of the stage, then projected.
  ///
  /// A free body of mass m_s that displaces the mass m_f of fluid moves by
  ///   (m_s (V - V_old) - (P - P_old)) / h = -I(V) / h + (m_s - m_f) g
  /// over a stage of length h (Uhlmann 2005, 10.1016/j.jcp.2005.03.017, eq. 12
  /// integrated over the body). I = rho sum_l w_l F_l, the impulse of its
  /// markers on the fluid, is linear in the new velocities of all bodies since
  /// F = T (V - J u*): that makes the scheme implicit without iteration.
  /// P, the momentum of the fluid inside, is m_f V (`rigid`) or integrated over
  /// the projected velocity (`measured`), which is linear in V too: a secant
  /// iteration repeats forcing and projection of the stage, two or three times,
  /// until V has settled. The pressure is the one without the hydrostatic part.
  ///
  /// The force of the fluid on a body is given twice: by the probes of
  /// SurfaceLoads, and by -sum I / dt + (P - P_n) / dt over the step.
  class RigidFlow
  {
  public:
    RigidFlow(fluid::FlowSolver                      &flow,
              std::vector<std::unique_ptr<RigidBody>> bodies,
              const Parameters                       &parameters);

    /// One step from t to t + dt, s. Fails where the velocity of a free body
    /// does not settle or becomes non-finite; collective.
    StepStatus
    advance(double t, double dt);

    /// All that later steps need, the flow's state included.
    void
    serialize(Archive &archive);

    /// Longest step from t, s, in which no body moves by more than
    /// @p cfl_number cells: by the law within the next @p longest seconds, or
    /// from its velocity and acceleration, at the start the one that added mass
    /// (half of the displaced fluid) leaves to it.
    double
    largest_step(double t, double longest, double cfl_number) const;

    /// Columns of statistics.csv: motion and forces of each body, slip and
    /// leakage of the surfaces; collective.
    void
    evaluate(Record &record);

    /// Not empty where a body is closer to a wall than the last inner node of
    /// the grid: the run has come to its end.
    std::string
    end_reason() const;

    const RigidBody &
    body(const int b) const
    {
      return *bodies[b];
    }
    int
    n_bodies() const
    {
      return static_cast<int>(bodies.size());
    }
    const Markers &
    markers() const
    {
      return *the_markers;
    }
    /// Loads of the present state by the probes; collective.
    const SurfaceLoads &
    loads();

    /// Force of the fluid on a body over the last step by forcing and momentum
    /// inside, N.
    double
    force_by_forcing(const int b) const
    {
      return force[b];
    }
    /// What the present velocity u misses.
    struct NoSlip
    {
      double slip    = 0; ///< root mean square of |u - V| over area, m/s
      double leakage = 0; ///< mean of |(u - V).n| over area, m/s
    };
    /// At the forcing points, with the interpolated velocity J u; collective.
    NoSlip
    no_slip_error();
    /// On the surface, with the velocity outside continued to it by the parabola
    /// through the points at 1, 1.5 and 2 cells along the normal,
    ///   u = 6 u(1) - 8 u(1.5) + 3 u(2);
    /// markers where these leave the grid are left out; collective.
    NoSlip
    no_slip_error_on_surface() const;

    /// Wall pressure and friction along the surface of a body; collective.
    SurfaceProfile
    surface_profile(int body);

    /// Projections of the last step.
    int
    n_projections() const
    {
      return projections;
    }

  private:
    /// Columns of the wake of a body that asks for them; collective.
    void
    evaluate_wake(int body, Record &record) const;
    /// Means over the area of the markers' velocities @p u (radial, then axial
    /// components; markers whose `used` is 0 are left out).
    NoSlip
    mean_error(const std::vector<double> &u,
               const std::vector<char>   &used) const;
    /// Throws InputError where a body touches a wall or another one.
    void
    check_start() const;
    /// Markers at the given body positions with the velocities of the bodies.
    void
    place_markers(const std::vector<double> &positions);
    /// Finds the velocities of the free bodies, forces and projects.
    StepStatus
    force_stage(unsigned int stage, double h);
    /// F for the present marker velocities.
    void
    solve_forcing();
    StepStatus
    force_and_project(unsigned int stage);
    double
    marker_impulse(int body) const;
    void
    set_axial_velocity(int body, double velocity);
    std::vector<double>
    interior_momenta() const;

    fluid::FlowSolver                      &flow;
    std::vector<std::unique_ptr<RigidBody>> bodies;
    std::vector<int>         free_bodies, measured; ///< measured: 0 or 1
    std::vector<int>         first_curve;           ///< of each body
    std::vector<double>      reference;             ///< control vector at y = 0
    std::vector<int>         body_of_point;
    std::unique_ptr<Markers> the_markers;
    const Parameters         parameters;
    DirectForcing            forcing;
    SurfaceLoads             surface_loads;
    bool                     forcing_valid     = false;
    int                      forcing_shift     = 0; ///< of the grid
    bool                     measures_momentum = false;

    std::vector<double> target, Ju, residual, F; ///< of the markers
    std::vector<double> momentum; ///< inside each body over the density, m^4/s
    std::vector<double> impulse;  ///< on the fluid in this step, N s
    std::vector<double> force;
    /// Change of the momentum inside with the velocities, free x free, m^3.
    std::vector<double> momentum_slope;
    int                 projections = 0;
  };
} // namespace ephyra::immersed_boundary
