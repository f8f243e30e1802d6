#include "ephyra/fluid/flow_solver.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/log.h"
#include "ephyra/base/timer_tree.h"
#include "ephyra/fluid/row_transforms.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ephyra::fluid
{
  namespace
  {
    constexpr unsigned int n_substeps = 3;

    const FlowParameters &
    checked(const FlowParameters &parameters)
    {
      parameters.check();
      return parameters;
    }
  } // namespace

  FlowSolver::FlowSolver(const Parameters &p, const MPI_Comm comm)
    : parameters(checked(p))
    , the_grid(parameters.grid.make_grid(parameters.periodic_y(), comm))
    , boundary(parameters, the_grid)
    , momentum(parameters, the_grid, boundary)
    , implicit_viscosity(parameters, the_grid, boundary, momentum)
    , poisson_solver(make_poisson_solver(
        parameters.poisson, the_grid, boundary.poisson_sides()))
    , body_force(parameters.body_force, {"t"})
    , current(the_grid)
    , predicted(the_grid)
    , history(the_grid)
    , old_pressure(the_grid)
    , new_pressure(the_grid)
    , phi(the_grid)
  {
    EphyraThrowIf(parameters.window.on() && !the_grid.y.uniform,
                  InputError,
                  "A moving window needs a uniform axial spacing: give one "
                  "value of Fluid/Grid/Axial spacings.");
    std::ostringstream text;
    text << "Flow: " << the_grid.r.n_cells << " x " << the_grid.y.n_cells
         << " cells, smallest " << the_grid.r.smallest_width() << " m x "
         << the_grid.y.smallest_width() << " m, largest stretching ratio "
         << the_grid.r.largest_ratio() << " and " << the_grid.y.largest_ratio()
         << ", Poisson solver \"" << poisson_solver->name() << "\" ("
         << choose_poisson_solver(p.poisson, the_grid).reason << ").";
    log().line(text.str());
    if (poisson_solver->name() == "fft" &&
        is_awkward_length(the_grid.y.n_cells))
      log().line("Flow: transforms are faster with " +
                 std::to_string(next_good_length(the_grid.y.n_cells)) +
                 " cells in y (no large prime factors).");

    const auto component = [](const std::string &formula) -> Component {
      const auto expression = std::make_shared<const Expression>(
        formula, std::vector<std::string>{"r", "y"});
      if (expression->is_zero())
        return [](double, double) { return 0.; };
      return [expression](const double r, const double y) {
        return (*expression)({r, y});
      };
    };
    if (parameters.energy_budget)
      budget = std::make_unique<EnergyBudget>(parameters, the_grid, boundary);
    set_initial_velocity(component(parameters.initial_radial_velocity),
                         component(parameters.initial_axial_velocity));
  }

  void
  FlowSolver::set_initial_velocity(const Component &radial,
                                   const Component &axial)
  {
    initial_radial    = radial;
    initial_axial     = axial;
    const GridLine &r = the_grid.r, &y = the_grid.y;
    const int end_face = the_grid.end_row() + (the_grid.is_last_rank() ? 1 : 0);
    for (int i = std::max(1, the_grid.first_row); i < end_face; ++i)
      for (int j = 0; j < y.n_cells; ++j)
        current.r(i, j) = radial(r.face[i], y.centre[j]);
    for (int i = the_grid.first_row; i < the_grid.end_row(); ++i)
      for (int j = 0; j <= y.n_cells; ++j)
        current.y(i, j) = axial(r.centre[i], y.face[j]);

    boundary.set_time(time);
    boundary.set_normal_velocities(current, 0., current);
    update_ghosts();
    make_divergence_free(current, 1., nullptr);
    update_ghosts();
    projected          = true;
    started            = false;
    previous_time_step = 0;
    if (budget)
      budget->start(current);
  }

  void
  FlowSolver::update_ghosts()
  {
    DistributedArray::exchange_halos({&current.r, &current.y});
    boundary.fill_ghosts(current);
  }

  // --- one step -----------------------------------------------------------

  unsigned int
  FlowSolver::n_stages() const
  {
    return parameters.scheme == TimeScheme::rk3 ? n_substeps : 1;
  }

  FlowSolver::StageCoefficients
  FlowSolver::stage(const unsigned int k) const
  {
    if (parameters.scheme == TimeScheme::rk3)
      {
        static constexpr StageCoefficients table[n_substeps] = {
          {8. / 15., 8. / 15., 0., 8. / 15.},
          {2. / 15., 5. / 12., -17. / 60., 2. / 3.},
          {1. / 3., 3. / 4., -5. / 12., 1.}};
        return table[k];
      }
    if (previous_time_step == 0)
      return {1., 1., 0., 1.};
    const double ratio = time_step / previous_time_step;
    return {1., 1. + 0.5 * ratio, -0.5 * ratio, 1.};
  }

  double
  FlowSolver::stage_dt(const unsigned int k) const
  {
    return stage(k).alpha * time_step;
  }

  double
  FlowSolver::stage_time(const unsigned int k) const
  {
    return time + stage(k).end * time_step;
  }

  double
  FlowSolver::viscous_time_step_limit() const
  {
    return parameters.explicit_time_step_limit(the_grid.r, the_grid.y);
  }

  void
  FlowSolver::check_time_step(const double dt) const
  {
    EphyraThrowIf(parameters.viscous == ViscousTreatment::explicit_ &&
                    dt > viscous_time_step_limit() * (1. + 1e-9),
                  InputError,
                  "The time step "
                    << dt
                    << " s of the flow exceeds the limit of explicit "
                       "viscosity, "
                    << viscous_time_step_limit()
                    << " s: choose a smaller step or set \"Viscous "
                       "terms\" to automatic.");
  }

  void
  FlowSolver::choose_viscous_treatment()
  {
    check_time_step(time_step);
    ImplicitDirections chosen;
    const double       nu    = parameters.kinematic_viscosity();
    const double       limit = parameters.explicit_viscous_number();
    const double       number_r =
      4 * nu * time_step / std::pow(the_grid.r.smallest_width(), 2);
    const double number_y =
      4 * nu * time_step / std::pow(the_grid.y.smallest_width(), 2);
    switch (parameters.viscous)
      {
      case ViscousTreatment::explicit_:
        break;
      case ViscousTreatment::implicit:
        chosen.r = chosen.y = nu > 0;
        break;
      case ViscousTreatment::automatic:
        if (number_r + number_y <= limit)
          break;
        // The worse direction, and the other one where it exceeds the limit
        // by itself.
        chosen.r = number_r >= number_y || number_r > limit;
        chosen.y = number_y > number_r || number_y > limit;
        break;
      }
    if (started && chosen.r == implicit.r && chosen.y == implicit.y)
      return;
    implicit = chosen;
    if (nu == 0)
      return;
    std::ostringstream text;
    text << "Flow: viscous terms "
         << (!implicit.any()            ? "explicit"
             : implicit.r && implicit.y ? "implicit"
             : implicit.r               ? "implicit in r, explicit in y"
                                        : "implicit in y, explicit in r")
         << " (time step " << time_step << " s, explicit limit "
         << viscous_time_step_limit() << " s).";
    log().line(text.str());
    previous_time_step = 0; // the history holds other terms
  }

  void
  FlowSolver::begin_step(const double t, const double dt)
  {
    time              = t;
    const bool change = dt != time_step || !started;
    time_step         = dt;
    if (change)
      choose_viscous_treatment();
    if (!started)
      initialize_pressure();
    if (!started && budget)
      budget->start(current);
    started = true;
  }

  void
  FlowSolver::initialize_pressure()
  {
    // The pressure that keeps the initial acceleration free of divergence, from
    // one explicit Euler step that is then forgotten.
    boundary.set_time(time + 0.5 * time_step);
    new_pressure.fill(0.);
    old_pressure.fill(0.);
    boundary.fill_pressure_ghosts(old_pressure);
    Momentum::Factors factors{};
    factors.pressure   = time_step / parameters.density;
    factors.beta       = time_step;
    factors.body_force = body_force(time) / parameters.density;
    momentum.update(current, old_pressure, history, predicted, factors);
    boundary.set_time(time + time_step);
    boundary.set_normal_velocities(current, time_step, predicted);
    predicted.r.exchange_halo();
    boundary.fill_ghosts(predicted);
    make_divergence_free(predicted, time_step, &new_pressure);
    new_pressure.exchange_halo();
    boundary.fill_pressure_ghosts(new_pressure);
    projected = true;
  }

  void
  FlowSolver::predict(const unsigned int k)
  {
    if (budget && k > 0)
      count_energy(k - 1);
    const TimerTree::Scope scope(timer(), "momentum", n_cells());
    if (budget && keeps_predicted)
      {
        if (!before)
          before = std::make_unique<VelocityField>(the_grid);
        before->copy_from(current);
      }
    if (projected)
      {
        std::swap(old_pressure, new_pressure);
        projected = false;
      }
    const StageCoefficients c     = stage(k);
    const double            begin = k == 0 ? time : stage_time(k - 1);
    const double            step  = c.alpha * time_step;
    if (!boundary.poisson_sides().singular())
      {
        boundary.set_time(begin + 0.5 * step);
        boundary.fill_pressure_ghosts(old_pressure);
      }

    Momentum::Factors factors;
    factors.pressure   = step / parameters.density;
    factors.beta       = c.beta * time_step;
    factors.gamma      = c.gamma * time_step;
    factors.body_force = body_force(begin) / parameters.density;
    factors.store_history =
      parameters.scheme == TimeScheme::ab2 || k + 1 < n_substeps;
    factors.implicit   = step;
    factors.directions = implicit;
    momentum.update(current, old_pressure, history, predicted, factors);

    boundary.set_time(stage_time(k));
    boundary.set_normal_velocities(current, step, predicted);
    if (implicit.any())
      implicit_viscosity.solve(step, implicit, current, predicted);
    DistributedArray::exchange_halos({&predicted.r, &predicted.y});
    boundary.fill_ghosts(predicted);
    if (keeps_predicted)
      current.copy_from(predicted);
    else
      std::swap(current, predicted);
    ++predictions;
  }

  void
  FlowSolver::reset_to_predicted(const unsigned int)
  {
    EphyraAssert(keeps_predicted, "the prediction was not kept");
    current.copy_from(predicted);
    if (projected)
      projected = false;
  }

  void
  FlowSolver::add_forces(const unsigned int                          k,
                         const std::function<void(VelocityField &)> &spread)
  {
    if (!implicit.any())
      {
        spread(current);
        return;
      }
    if (!increment)
      increment = std::make_unique<VelocityField>(the_grid);
    increment->r.fill(0.);
    increment->y.fill(0.);
    spread(*increment);
    implicit_viscosity.spread_out(stage_dt(k), implicit, *increment);
    const int n_y = the_grid.y.n_cells;
    for (int i = boundary.first_r_face(); i < boundary.end_r_face(); ++i)
      for (int j = 0; j < n_y; ++j)
        current.r(i, j) += increment->r(i, j);
    for (int i = the_grid.first_row; i < the_grid.end_row(); ++i)
      for (int j = boundary.first_y_face(); j < boundary.end_y_face(); ++j)
        current.y(i, j) += increment->y(i, j);
  }

  std::vector<double>
  FlowSolver::line_response(const unsigned int      k,
                            const int               component,
                            const bool              along_r,
                            const std::vector<int> &nodes) const
  {
    if (along_r ? implicit.r : implicit.y)
      return implicit_viscosity.line_response(
        stage_dt(k), component, along_r, nodes);
    const std::size_t   n = nodes.size();
    std::vector<double> identity(n * n, 0.);
    for (std::size_t m = 0; m < n; ++m)
      identity[m * n + m] = 1.;
    return identity;
  }

  void
  FlowSolver::project(const unsigned int k)
  {
    if (!parameters.project_every_substep && k + 1 < n_stages())
      {
        update_ghosts();
        return;
      }
    const TimerTree::Scope scope(timer(), "projection", n_cells());
    const double           step =
      parameters.project_every_substep ? stage_dt(k) : time_step;
    current.r.exchange_halo();
    boundary.fill_ghosts(current);
    make_divergence_free(current, step, &new_pressure);
    if (implicit.any())
      correct_pressure_for_implicit_viscosity(step);
    DistributedArray::exchange_halos({&current.r, &current.y, &new_pressure});
    boundary.fill_ghosts(current);
    boundary.fill_pressure_ghosts(new_pressure);
    projected = true;
  }

  void
  FlowSolver::make_divergence_free(VelocityField          &field,
                                   const double            step,
                                   DistributedArray *const pressure)
  {
    const int    n_y      = the_grid.y.n_cells;
    const double factor   = step / parameters.density;
    int          previous = -1;
    poisson_solver->solve(
      phi,
      [&](const int i, const double scale, double *const row) {
        momentum.divergence(field, scale / factor, i, row);
      },
      [&](const int i, double *const row) {
        boundary.fill_correction_ghosts(row);
        momentum.correct_axial(field, phi, factor, i);
        if (previous >= 0)
          momentum.correct_radial(field, phi, factor, std::max(i, previous));
        previous = i;
        if (pressure == nullptr)
          return;
        const double *const before = old_pressure.row(i);
        double *const       after  = pressure->row(i);
        for (int j = 0; j < n_y; ++j)
          after[j] = before[j] + row[j];
      });
    phi.exchange_halo();
    boundary.fill_correction_ghosts(phi);
    if (!the_grid.is_first_rank())
      momentum.correct_radial(field, phi, factor, the_grid.first_row);
    if (boundary.end_r_face() > the_grid.end_row())
      momentum.correct_radial(field, phi, factor, the_grid.end_row());
  }

  void
  FlowSolver::correct_pressure_for_implicit_viscosity(const double step)
  {
    const double a   = 0.5 * step * parameters.kinematic_viscosity();
    const double a_r = implicit.r ? a : 0., a_y = implicit.y ? a : 0.;
    for (int i = the_grid.first_row; i < the_grid.end_row(); ++i)
      {
        const ViscousStencil stencil = radial_stencil_of_v_y(the_grid, i);
        const double *const below = phi.row(i - 1), *const here = phi.row(i),
                            *const above = phi.row(i + 1);
        double *const              p     = new_pressure.row(i);
        for (int j = 0; j < the_grid.y.n_cells; ++j)
          p[j] -= a_r * (stencil.plus * above[j] - stencil.centre * here[j] +
                         stencil.minus * below[j]) +
                  a_y * (momentum.cell_up[j] * (here[j + 1] - here[j]) -
                         momentum.cell_down[j] * (here[j] - here[j - 1]));
      }
  }

  void
  FlowSolver::count_energy(const unsigned int k)
  {
    const double step = stage_dt(k);
    const bool solved = parameters.project_every_substep || k + 1 == n_stages();
    const double length = parameters.project_every_substep ? step : time_step;
    budget->add_stage(stage_start(),
                      current,
                      {old_pressure, phi, step, solved ? length : 0.},
                      step,
                      body_force(stage_time(k) - 0.5 * step));
  }

  void
  FlowSolver::end_step()
  {
    if (budget)
      count_energy(n_stages() - 1);
    previous_time_step = time_step;
    time += time_step;
  }

  void
  FlowSolver::keep_predicted(const bool keep)
  {
    keeps_predicted = keep;
    if (!keep)
      before.reset();
  }

  void
  FlowSolver::advance(const double t, const double dt)
  {
    begin_step(t, dt);
    for (unsigned int k = 0; k < n_stages(); ++k)
      {
        predict(k);
        project(k);
      }
    end_step();
  }
} // namespace ephyra::fluid
