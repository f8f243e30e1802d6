// The functions of ElasticitySolver that keep the accounts of energy.
#include "ephyra/base/timer_tree.h"
#include "ephyra/elasticity/elasticity_solver.h"

namespace ephyra::elasticity
{
  void
  ElasticitySolver::accept()
  {
    if (!counted)
      count_work();
    older_acceleration = level.a;
    level              = next;
    repeated           = false;
  }

  EnergyAccounts::Parts
  ElasticitySolver::energy_parts() const
  {
    EnergyAccounts::Parts parts;
    parts.loads        = op->loaded();
    parts.prescribed   = op->get_constraints().moves();
    parts.surroundings = coupling.n_rows() > 0;
    parts.muscle       = op->has_muscle();
    parts.motion       = true;
    parts.dissipation  = prm.rho_infinity < 1. || parts.surroundings;
    return parts;
  }

  void
  ElasticitySolver::count_work()
  {
    const TimerTree::Scope      scope(timer(), "energy", op->n_unknowns());
    const EnergyAccounts::Parts parts = energy_parts();
    counted                           = true;
    accounts.muscle += muscle_work();
    accounts.surroundings += interface_work();
    if (parts.loads)
      accounts.loads += load_work();
    if (!parts.prescribed && !parts.dissipation)
      return;

    StepWork::Step step{next.u, next.v, next.a, next.f, last_dt, at_new_level};
    for (std::size_t i = 0; i < step.u.size(); ++i)
      {
        step.u[i] -= level.u[i];
        step.v[i] -= level.v[i];
        step.a[i] -= level.a[i];
        step.f[i] -= level.f[i];
      }
    if (parts.prescribed)
      accounts.prescribed += step_work.of_reactions(reaction, step);
    if (parts.dissipation)
      accounts.dissipation += step_work.dissipated(*op, step);
  }

  double
  ElasticitySolver::load_work()
  {
    std::vector<double> middle(next.u);
    for (std::size_t i = 0; i < middle.size(); ++i)
      middle[i] = 0.5 * (level.u[i] + next.u[i]);
    op->set_time(last_t + 0.5 * last_dt);
    const std::vector<double> force = op->external_force(middle);
    double                    work  = 0.;
    for (std::size_t i = 0; i < force.size(); ++i)
      work += force[i] * (next.u[i] - level.u[i]);
    return work;
  }

  double
  ElasticitySolver::interface_work() const
  {
    double work = 0.;
    for (std::size_t i = 0; i < next.f.size(); ++i)
      work += 0.5 * (level.f[i] + next.f[i]) * (next.u[i] - level.u[i]);
    return work;
  }
} // namespace ephyra::elasticity
