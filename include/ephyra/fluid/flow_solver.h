#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/base/expression.h"
#include "ephyra/base/memory_archive.h"
#include "ephyra/base/output.h"
#include "ephyra/fluid/boundary.h"
#include "ephyra/fluid/energy_budget.h"
#include "ephyra/fluid/flow_parameters.h"
#include "ephyra/fluid/implicit_viscosity.h"
#include "ephyra/fluid/momentum.h"
#include "ephyra/fluid/poisson_solver.h"
#include "ephyra/fluid/velocity_field.h"

#include <functional>
#include <memory>

namespace ephyra::fluid
{
  /// Incompressible axisymmetric flow, eq. (47), by a fractional-step method:
  ///   u* = u^k + dt [-alpha grad p^k / rho + beta H^k + gamma H^(k-1)
  ///                  + alpha nu L_i (u* + u^k) / 2]                     (77)
  ///   div grad phi = rho div u* / (alpha dt)                            (81)
  ///   u^(k+1) = u* - alpha dt grad phi / rho                            (79)
  ///   p^(k+1) = p^k + phi - alpha dt nu L_i phi / 2                     (80)
  /// H: convection, body force and those viscous terms that are explicit; L_i:
  /// the implicit ones. A step consists of stages, each of them
  ///   predict(k); [forces added to velocity();] project(k);
  /// and reset_to_predicted(k) repeats the part after predict() from the same
  /// u* and p^k as often as needed.
  class FlowSolver
  {
  public:
    using Parameters = FlowParameters;

    FlowSolver(const Parameters &parameters, MPI_Comm comm);

    const StaggeredGrid &
    grid() const
    {
      return the_grid;
    }
    double
    density() const
    {
      return parameters.density;
    }
    double
    viscosity() const
    {
      return parameters.viscosity;
    }

    // --- one step ---------------------------------------------------------
    /// Throws InputError where viscosity has to be explicit and the step (s)
    /// is too long for that; begin_step() does so too.
    void
    check_time_step(double dt) const;
    /// From t to t + dt, s.
    void
    begin_step(double t, double dt);
    unsigned int
    n_stages() const;
    /// alpha_k dt, s.
    double
    stage_dt(unsigned int k) const;
    /// Time at the end of stage k, s.
    double
    stage_time(unsigned int k) const;
    /// velocity() = u* of stage k, halo and ghosts valid. Collective.
    void
    predict(unsigned int k);
    /// velocity() = the u* that predict(k) left. Needs keep_predicted(true).
    void
    reset_to_predicted(unsigned int k);
    /// For steps of several stages that are repeated as a whole: after
    /// predict(0) keeps its u*, history and pressure, to which
    /// return_to_first_stage() goes back as often as asked.
    void
    keep_first_stage();
    void
    return_to_first_stage();
    /// Adds forces to the velocity of stage k, given as what they would do to
    /// a fluid without viscosity: @p spread adds these increments (m/s) to the
    /// owned nodes of a field. Like every other term they pass through the
    /// implicit viscous operator, velocity() += A^-1 increment,
    /// A = (1 - a L_r) (1 - a L_y). Collective.
    void
    add_forces(unsigned int                                k,
               const std::function<void(VelocityField &)> &spread);
    /// Entries of A^-1 of stage k along one direction, see
    /// ImplicitViscosity::line_response(); those of the identity where this
    /// direction is explicit.
    std::vector<double>
    line_response(unsigned int            k,
                  int                     component,
                  bool                    along_r,
                  const std::vector<int> &nodes) const;
    /// Makes velocity() free of divergence and updates pressure() from the
    /// pressure at the start of the stage; halo and ghosts valid. Collective.
    void
    project(unsigned int k);
    void
    end_step();
    /// Without kept predictions (no coupling iterations) a copy is saved.
    void
    keep_predicted(bool keep);

    /// Begin, all stages without forcing, end.
    void
    advance(double t, double dt);

    // --- fields -----------------------------------------------------------
    VelocityField &
    velocity()
    {
      return current;
    }
    const VelocityField &
    velocity() const
    {
      return current;
    }
    /// Pa. Between predict() and project() that of the start of the stage.
    const DistributedArray &
    pressure() const
    {
      return projected ? new_pressure : old_pressure;
    }
    /// Recomputes ghosts after velocity() was set from outside; collective.
    void
    update_ghosts();
    /// A velocity component as a function of (r, y), m/s.
    using Component = std::function<double(double r, double y)>;
    /// Sets the velocity, made free of divergence; pressure and history start
    /// anew. What a moving window meets has this velocity, too. Collective.
    void
    set_initial_velocity(const Component &radial, const Component &axial);

    /// Moves the domain by so many cells along y, up where positive, between
    /// two steps. Nothing is interpolated: what stays inside keeps its values,
    /// the fluid that enters has the velocity of set_initial_velocity() at its
    /// place, and the pressure and history of the last column before it; what
    /// leaves is gone. The sides move along: their conditions hold at the new
    /// ends, and one projection (without effect on the pressure) takes the
    /// divergence away that this makes. Needs a uniform y that is not periodic.
    /// Collective.
    void
    shift_window(int n_cells);

    // --- energy -----------------------------------------------------------
    /// Null unless parameters ask for it.
    EnergyBudget *
    energy()
    {
      return budget.get();
    }
    const EnergyBudget *
    energy() const
    {
      return budget.get();
    }
    /// Between predict() and the next one, with an energy budget: the velocity
    /// at the start of the stage.
    const VelocityField &
    stage_start() const
    {
      return before ? *before : predicted;
    }

    // --- status -----------------------------------------------------------
    /// Cells of the whole grid.
    double
    n_cells() const
    {
      return static_cast<double>(the_grid.r.n_cells) * the_grid.y.n_cells;
    }
    /// max(|v_r|/dr + |v_y|/dy) dt; not finite where the fields are not.
    /// Collective.
    double
    max_cfl(double dt) const;
    /// CFL number from which on a step is not accepted, infinite without
    /// convection: 2.8 (`rk3`, stable up to sqrt(3)), where convection makes the
    /// fastest modes grow threefold in a step, or 1 (`ab2`, never quite stable),
    /// where they grow by a half; the modulus of the roots of the schemes on the
    /// imaginary axis.
    double
    unstable_cfl() const;
    /// Whether all velocities are finite; collective.
    bool
    finite() const;
    /// Largest step for which explicit viscosity is stable, s; infinite where
    /// viscosity is zero.
    double
    viscous_time_step_limit() const;
    /// Longest step from the present velocity, s: CFL number at most
    /// @p cfl_number (0: default_cfl_number()), from rest also by the body force. Where viscosity may be
    /// explicit or implicit, an explicit step at its limit is preferred unless
    /// an implicit one could be longer by more than it costs. Collective.
    double
    largest_time_step(double cfl_number) const;
    /// The CFL number of adaptive steps, well below the measured limits: 1.2
    /// with rk3, 0.9 with one projection a step, 0.3 with ab2.
    double
    default_cfl_number() const;
    /// Directions in which viscosity is implicit; known once a step has begun.
    ImplicitDirections
    implicit_directions() const
    {
      return implicit;
    }
    const PoissonSolver &
    poisson() const
    {
      return *poisson_solver;
    }

    /// Named "flow" state: velocity, pressure, history; for restarts. Where it
    /// serves to repeat a step, and no stage was reset, the fields at the start
    /// of the step are still there: nothing is copied, and a step that is taken
    /// back begins without history, by one explicit Euler step.
    void
    serialize(Archive &archive);
    /// Adds velocity, pressure and vorticity in cell centres. The pieces of
    /// the ranks do not overlap.
    void
    write(GridOutput &output) const;

  private:
    struct StageCoefficients
    {
      double alpha, beta, gamma, end; ///< end: time of the end over dt
    };
    StageCoefficients
    stage(unsigned int k) const;
    void
    choose_viscous_treatment();
    void
    initialize_pressure();
    /// Poisson solve and correction of the owned faces of @p field with the
    /// time step @p step; *pressure = old_pressure + phi unless null. The row
    /// of v_r above the owned ones must be up to date.
    void
    make_divergence_free(VelocityField    &field,
                         double            step,
                         DistributedArray *pressure);
    void
    correct_pressure_for_implicit_viscosity(double step);
    void
    serialize_fields(Archive &archive);
    /// Whether velocity and pressure of the start of a step outlast it.
    bool
    can_take_back() const;
    void
    take_back();
    /// Adds a stage to the budget that is not repeated any more.
    void
    count_energy(unsigned int k);

    const Parameters               parameters;
    StaggeredGrid                  the_grid; ///< moved by shift_window() alone
    Boundary                       boundary;
    Momentum                       momentum;
    ImplicitViscosity              implicit_viscosity;
    std::unique_ptr<PoissonSolver> poisson_solver;
    Expression                     body_force;
    Component                      initial_radial, initial_axial;

    VelocityField                  current, predicted, history;
    std::unique_ptr<VelocityField> increment; ///< by add_forces()
    struct FirstStage
    {
      VelocityField    velocity, history;
      DistributedArray pressure;
      VelocityField    start;  ///< with an energy budget: see stage_start()
      MemoryArchive    energy; ///< the budget
    };
    std::unique_ptr<FirstStage>    first_stage; ///< by keep_first_stage()
    std::unique_ptr<VelocityField> before;      ///< see stage_start()
    std::unique_ptr<EnergyBudget>  budget;
    DistributedArray               old_pressure, new_pressure, phi;

    double             time = 0, time_step = 0, previous_time_step = 0;
    bool               projected       = true;
    bool               keeps_predicted = true;
    bool               started     = false; ///< pressure known, history valid
    int                predictions = 0;     ///< since the last serialize()
    ImplicitDirections implicit;
  };
} // namespace ephyra::fluid
