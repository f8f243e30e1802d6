#include "ephyra/elasticity/statics.h"

#include "admissibility.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"
#include "ephyra/base/parameter_handler.h"

#include <algorithm>
#include <cmath>

namespace ephyra::elasticity
{
  namespace
  {
    /// Growth of the motion with the load that tells of a limit point at the
    /// level c, near which it is (c - level)^(-1/2).
    constexpr double limit_point_growth = 5.;

    /// Displacement over load between two levels, over its mean up to the
    /// later one.
    double
    growth_of_motion(const std::vector<double> &u,
                     const double               level,
                     const std::vector<double> &u_older,
                     const double               older_level)
    {
      double step = 0., way = 0.;
      for (std::size_t i = 0; i < u.size(); ++i)
        {
          step = std::max(step, std::abs(u[i] - u_older[i]));
          way  = std::max(way, std::abs(u[i]));
        }
      return level > older_level && way > 0.
               ? step / (level - older_level) / (way / level)
               : 0.;
    }

    class StaticProblem : public NonlinearProblem
    {
    public:
      /// @p equilibrium: the displacement of the last level.
      StaticProblem(ElasticityOperator        &op,
                    const std::vector<double> &equilibrium)
        : op(op)
        , equilibrium(equilibrium)
      {
      }

      Evaluation
      residual(const std::vector<double> &x,
               std::vector<double>       &residual) override
      {
        const auto result = op.residual(x, residual);
        op.get_constraints().condense(residual);
        return internal::admissibility(op, result);
      }

      Evaluation
      residual_and_tangent(const std::vector<double>    &x,
                           std::vector<double>          &residual,
                           linear_algebra::SparseMatrix &tangent) override
      {
        const auto result =
          op.residual_and_tangent(x, residual, tangent, 1., 0.);
        op.get_constraints().condense(residual);
        return internal::admissibility(op, result);
      }

      void
      predict(const std::vector<double> &x,
              const std::vector<double> &correction) override
      {
        op.predict_pressure(x, correction);
      }

      void
      predict_start() override
      {
        op.predict_pressure(equilibrium,
                            std::vector<double>(equilibrium.size(), 0.));
      }

      void
      complete(std::vector<double> &correction) const override
      {
        op.get_constraints().complete(correction);
      }

    private:
      ElasticityOperator        &op;
      const std::vector<double> &equilibrium;
    };

    linear_algebra::SparsityPattern
    compressed_pattern(const ElasticityOperator &op)
    {
      auto pattern = op.sparsity_pattern();
      pattern.compress();
      return pattern;
    }
  } // namespace

  void
  StaticsSolver::Parameters::declare(ParameterHandler &prm)
  {
    ParameterHandler::Section section(prm, "Statics");
    prm.declare_entry("Load steps",
                      "10",
                      patterns::Integer(1),
                      "Steps from no load to the full load; a step that does "
                      "not converge is cut.");
    prm.declare_entry("End time",
                      "1 s",
                      patterns::Positive("s"),
                      "Time of the full load in formulas.");
    prm.declare_entry("Ramp",
                      "true",
                      patterns::Bool(),
                      "Multiplies loads, prescribed displacements and the "
                      "activation by the load level; off: only the time in "
                      "their formulas advances.");
    prm.declare_entry("Smallest load step",
                      "1e-4",
                      patterns::Double("", 1e-12, 1.),
                      "Fraction of the load below which a step is not cut any "
                      "more and the run ends.");
  }

  void
  StaticsSolver::Parameters::parse(ParameterHandler &prm)
  {
    ParameterHandler::Section section(prm, "Statics");
    n_steps       = prm.get_integer("Load steps");
    end_time      = prm.get_double("End time");
    ramp          = prm.get_bool("Ramp");
    smallest_step = prm.get_double("Smallest load step");
  }

  TimeControl::Parameters
  StaticsSolver::Parameters::load_steps() const
  {
    TimeControl::Parameters steps;
    steps.end_time           = end_time;
    steps.time_step          = end_time / n_steps;
    steps.smallest_time_step = std::min(smallest_step, 1. / n_steps) * end_time;
    steps.growth             = 1.5;
    steps.name_of_smallest   = "Smallest load step";
    return steps;
  }

  StaticsSolver::StaticsSolver(const Parameters             &parameters,
                               const splines::NurbsPatch<2> &patch,
                               const MPI_Comm                comm)
    : prm(parameters)
    , op(parameters.body, patch, comm)
    , newton(parameters.newton,
             compressed_pattern(op),
             comm,
             "tangent of the statics")
    , u(op.n_unknowns(), 0.)
    , u_old(u)
    , u_older(u)
    , load(u)
    , reaction(u)
    , old_gamma(op.activation())
  {
    EphyraThrowIf(!op.get_constraints().holds_axial_position(),
                  InputError,
                  "Nothing holds the body along the axis, so that it has no "
                  "equilibrium; fix the component y on a side.");
  }

  void
  StaticsSolver::set_level(const double level, const Activation &activation)
  {
    op.set_time(level * prm.end_time, prm.ramp ? level : 1.);
    if (!activation)
      return;
    std::vector<double> gamma(op.activation_points().size(), 0.);
    activation(level * prm.end_time, gamma);
    if (prm.ramp)
      for (double &g : gamma)
        g *= level;
    op.set_activation(gamma);
  }

  void
  StaticsSolver::predict(const double      level,
                         const double      old_level,
                         const double      older_level,
                         NonlinearProblem &problem)
  {
    u = u_old;
    if (old_level > older_level)
      {
        const double factor = (level - old_level) / (old_level - older_level);
        for (std::size_t i = 0; i < u.size(); ++i)
          u[i] += factor * (u_old[i] - u_older[i]);
      }
    std::vector<double> jump = u;
    op.get_constraints().apply(jump);
    double largest = 0., size = 0.;
    for (std::size_t i = 0; i < u.size(); ++i)
      {
        size = std::max(size, std::abs(jump[i]));
        jump[i] -= u[i];
        largest = std::max(largest, std::abs(jump[i]));
      }
    if (largest <= 1e-12 * size || !newton.follow(problem, u, jump))
      op.get_constraints().apply(u);
  }

  EnergyAccounts::Parts
  StaticsSolver::energy_parts() const
  {
    EnergyAccounts::Parts parts;
    parts.loads      = op.loaded();
    parts.prescribed = op.get_constraints().moves();
    parts.muscle     = op.has_muscle();
    return parts;
  }

  void
  StaticsSolver::count_work()
  {
    const EnergyAccounts::Parts parts = energy_parts();
    // Replaces the forces at the old level by those at the new one.
    const auto work = [this](std::vector<double>       &old_force,
                             const std::vector<double> &force) {
      double sum = 0.;
      for (std::size_t i = 0; i < u.size(); ++i)
        sum += 0.5 * (old_force[i] + force[i]) * (u[i] - u_old[i]);
      old_force = force;
      return sum;
    };
    accounts.muscle += op.muscle_work(u_old, old_gamma, u, op.activation());
    old_gamma = op.activation();
    if (parts.loads)
      accounts.loads += work(load, op.external_force(u));
    if (parts.prescribed)
      {
        std::vector<double> residual;
        op.residual(u, residual);
        accounts.prescribed +=
          work(reaction, op.get_constraints().fixed_part(residual));
      }
  }

  NewtonStatus
  StaticsSolver::advance(const double next, const Activation &activation)
  {
    StaticProblem problem(op, u_old);
    set_level(next, activation);
    predict(next, the_level, older_level, problem);
    NewtonStatus status = newton.solve(problem, u);
    if (!status.success && the_level > older_level)
      {
        // The extrapolation may be what failed.
        predict(next, the_level, the_level, problem);
        status = newton.solve(problem, u);
      }
    if (!status.success)
      {
        std::ostringstream reason;
        reason << "no equilibrium at " << 100. * next << " % of the load ("
               << status.reason << "), the last level that converged is "
               << 100. * the_level << " %";
        const double growth =
          growth_of_motion(u_old, the_level, u_older, older_level);
        if (growth > limit_point_growth)
          reason << ", where the body moves " << growth << " times as far with "
                 << "the load as on average before: it is about to buckle or "
                 << "to snap through, which Mechanics = dynamic follows";
        reason << "; lower the load, refine the mesh or allow smaller load "
               << "steps.";
        status.reason = reason.str();
        u             = u_old;
        set_level(the_level, activation);
        return status;
      }
    mpi::broadcast(u.data(), u.size(), op.communicator());
    count_work();
    u_older.swap(u_old);
    u_old       = u;
    older_level = the_level;
    the_level   = next;
    return status;
  }

  StaticsSolver::Result
  StaticsSolver::run(const Activation &activation, const Observer &observer)
  {
    Result      result;
    TimeControl control(prm.load_steps());
    while (!control.finished())
      {
        const double next =
          (control.time() + control.step_size()) / prm.end_time;
        result.last = advance(next > 1. - 1e-9 ? 1. : next, activation);
        result.iterations += result.last.iterations;
        result.residual = result.last.residual;
        if (result.last.success)
          {
            control.accept_step();
            if (observer)
              observer(the_level);
            continue;
          }
        try
          {
            control.cut_step(result.last.reason);
          }
        catch (const DivergedError &error)
          {
            result.success = false;
            result.reason  = error.what();
            break;
          }
      }
    result.level     = the_level;
    result.steps     = static_cast<int>(control.n_steps());
    result.cut_backs = static_cast<int>(control.n_cuts());
    return result;
  }

  void
  StaticsSolver::forget()
  {
    newton.forget();
  }

  void
  StaticsSolver::serialize(Archive &archive)
  {
    const Archive::Group group(archive, "statics");
    archive.value("level", the_level);
    archive.value("older_level", older_level);
    archive.values("displacement", u_old);
    archive.values("older_displacement", u_older);
    archive.values("activation", old_gamma);
    archive.values("load", load);
    archive.values("reaction", reaction);
    accounts.serialize(archive);
    if (!archive.reading())
      return;
    u = u_old;
    op.set_time(the_level * prm.end_time, prm.ramp ? the_level : 1.);
    op.set_activation(old_gamma);
  }
} // namespace ephyra::elasticity
