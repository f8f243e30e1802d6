#include "ephyra/elasticity/elasticity_solver.h"

#include "admissibility.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"
#include "ephyra/base/parameter_handler.h"
#include "ephyra/base/timer_tree.h"

#include <algorithm>
#include <cmath>

namespace ephyra::elasticity
{
  void
  ElasticitySolver::Parameters::declare(ParameterHandler &prm)
  {
    ElasticityOperator::Parameters::declare(prm);
    Newton::Parameters::declare(prm);
    prm.declare_entry("Spectral radius",
                      "",
                      patterns::List(patterns::Double("", 0., 1.), 0, 1),
                      "rho_infinity of the generalised-alpha method, eq. (63): "
                      "1 keeps high frequencies, 0 removes them in a step. "
                      "Empty: 0.5, but 0 for a body lighter than the fluid "
                      "around it, whose fast modes the coupling excites.");
    prm.declare_entry("Warm start",
                      "true",
                      patterns::Bool(),
                      "A coupling iteration starts Newton's method from the "
                      "result of the last one.");
  }

  void
  ElasticitySolver::Parameters::parse(ParameterHandler &prm)
  {
    body.parse(prm);
    newton.parse(prm);
    const std::vector<double> radius = prm.get_double_list("Spectral radius");
    chosen_rho_infinity              = radius.empty();
    if (!chosen_rho_infinity)
      rho_infinity = radius.front();
    warm_start = prm.get_bool("Warm start");
  }

  /// Equation (65) for a^{n+1}.
  class ElasticitySolver::Problem : public NonlinearProblem
  {
  public:
    Problem(ElasticitySolver &s, const double dt, const InterfaceLoad &load)
      : s(s)
      , load(load)
      , dt(dt)
      , u(s.level.u.size())
      , a(s.level.u.size())
      , f(s.level.u.size())
    {
    }

    Evaluation
    residual(const std::vector<double> &x,
             std::vector<double>       &residual) override
    {
      weight(x);
      return finish(s.op->residual(u, residual), residual);
    }

    Evaluation
    residual_and_tangent(const std::vector<double>    &x,
                         std::vector<double>          &residual,
                         linear_algebra::SparseMatrix &tangent) override
    {
      weight(x);
      const auto result = s.op->residual_and_tangent(
        u,
        residual,
        tangent,
        s.alpha.alpha_f * s.alpha.beta * dt * dt,
        s.alpha.alpha_m - load_weight() * load.inertia_ratio);
      if (load.added && mpi::rank(s.op->communicator()) == 0)
        {
          using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
          const Constraints &constraints = s.op->get_constraints();
          for (Eigen::Index row = 0; row < load.added->outerSize(); ++row)
            for (Matrix::InnerIterator entry(*load.added, row); entry; ++entry)
              {
                const int i = constraints.equation(static_cast<int>(row));
                const int j =
                  constraints.equation(static_cast<int>(entry.col()));
                if (i >= 0 && j >= 0 && s.pattern.contains(i, j))
                  tangent.add(i, j, -load_weight() * entry.value());
              }
        }
      return finish(result, residual);
    }

    void
    predict(const std::vector<double> &x,
            const std::vector<double> &correction) override
    {
      weight(x);
      const double        factor = s.alpha.alpha_f * s.alpha.beta * dt * dt;
      std::vector<double> du(correction);
      for (double &value : du)
        value *= factor;
      s.op->predict_pressure(u, du);
    }

    void
    predict_start() override
    {
      s.op->predict_pressure(s.level.u,
                             std::vector<double>(s.level.u.size(), 0.));
    }

    void
    complete(std::vector<double> &correction) const override
    {
      s.op->get_constraints().complete(correction);
    }

    /// Load of the surroundings at t^{n+1} for an acceleration.
    void
    interface_force(const std::vector<double> &x, std::vector<double> &force)
    {
      if (load.constant.empty())
        force.assign(x.size(), 0.);
      else
        force = load.constant;
      if (load.inertia_ratio != 0.)
        {
          std::vector<double> scaled(x);
          for (double &value : scaled)
            value *= load.inertia_ratio;
          s.op->add_inertia(scaled, force);
        }
      if (!load.added)
        return;
      const Eigen::Map<const Eigen::VectorXd> acceleration(x.data(), x.size());
      Eigen::Map<Eigen::VectorXd>(force.data(), force.size()) +=
        *load.added * acceleration;
    }

  private:
    /// Of the load at n + 1 beside that at n.
    double
    load_weight() const
    {
      return load.at_new_level ? 1. : s.alpha.alpha_f;
    }

    void
    weight(const std::vector<double> &x)
    {
      s.next.a = x;
      s.newmark(dt);
      const double m = s.alpha.alpha_m, w = s.alpha.alpha_f;
      for (std::size_t i = 0; i < x.size(); ++i)
        {
          u[i] = w * s.next.u[i] + (1. - w) * s.level.u[i];
          a[i] = m * x[i] + (1. - m) * s.level.a[i];
        }
    }

    Evaluation
    finish(const ElasticityOperator::Evaluation &result,
           std::vector<double>                  &residual)
    {
      Evaluation   out = internal::admissibility(*s.op, result);
      const double w   = load_weight();
      inertia.assign(a.size(), 0.);
      s.op->add_inertia(a, inertia);
      interface_force(s.next.a, f);
      double square_inertia = 0., square_load = 0.;
      for (std::size_t i = 0; i < residual.size(); ++i)
        {
          const double force = w * f[i] + (1. - w) * s.level.f[i];
          residual[i] += inertia[i] - force;
          square_inertia += inertia[i] * inertia[i];
          square_load += force * force;
        }
      out.scale += std::sqrt(square_inertia) + std::sqrt(square_load);
      if (s.op->get_constraints().moves())
        s.reaction = s.op->get_constraints().fixed_part(residual);
      s.op->get_constraints().condense(residual);
      return out;
    }

    ElasticitySolver    &s;
    const InterfaceLoad &load;
    const double         dt;
    std::vector<double>  u, a, f, inertia;
  };

  ElasticitySolver::ElasticitySolver(const Parameters             &parameters,
                                     const splines::NurbsPatch<2> &patch,
                                     const MPI_Comm                comm)
    : prm(parameters)
    , alpha(parameters.rho_infinity)
    , op(std::make_unique<ElasticityOperator>(parameters.body, patch, comm))
    , step_work(alpha)
  {
    const std::vector<double> zero(op->n_unknowns(), 0.);
    level = {zero, zero, zero, zero, op->activation()};
    next  = level;
  }

  ElasticitySolver::~ElasticitySolver() = default;

  void
  ElasticitySolver::allow_coupling(linear_algebra::SparsityPattern allowed)
  {
    coupling = std::move(allowed);
    newton.reset();
  }

  void
  ElasticitySolver::make_newton()
  {
    pattern = op->sparsity_pattern();
    for (int row = 0; row < coupling.n_rows(); ++row)
      if (const int i = op->get_constraints().equation(row); i >= 0)
        for (const int column : coupling.columns[row])
          if (const int j = op->get_constraints().equation(column); j >= 0)
            pattern.columns[i].push_back(j);
    pattern.compress();
    newton = std::make_unique<Newton>(
      prm.newton, pattern, op->communicator(), "effective mass of the body");
  }

  void
  ElasticitySolver::initialize(const double               t,
                               const std::vector<double> &displacement,
                               const std::vector<double> &velocity)
  {
    const std::vector<double> zero(op->n_unknowns(), 0.);
    level.u = displacement.empty() ? zero : displacement;
    level.v = velocity.empty() ? zero : velocity;
    level.f = zero;
    op->set_time(t);
    op->get_constraints().apply(level.u);
    op->set_activation(next.gamma);
    level.gamma = next.gamma;

    std::vector<double> residual;
    const auto          evaluation = op->residual(level.u, residual);
    EphyraThrowIf(!(evaluation.smallest_J > 0.),
                  InputError,
                  "The initial displacement folds the body (determinant "
                    << evaluation.smallest_J << "); start from another one.");
    const std::vector<double> start_reaction =
      op->get_constraints().fixed_part(residual);
    op->get_constraints().condense(residual);
    auto mass_pattern = op->sparsity_pattern();
    mass_pattern.compress();
    const MPI_Comm               comm = op->communicator();
    linear_algebra::SparseMatrix mass(
      mass_pattern, linear_algebra::preferred_storage(mass_pattern), comm);
    mass.begin_assembly();
    op->add_mass(mass);
    mass.finish_assembly();
    const auto solver =
      linear_algebra::make_direct_solver(mass.storage(), "mass of the body");
    solver->factorize(mass);
    for (double &r : residual)
      r = -r;
    solver->solve(residual, level.a);
    op->get_constraints().complete(level.a);
    mpi::broadcast(level.a.data(), level.a.size(), comm);
    next     = level;
    started  = true;
    repeated = false;

    const BodyMeasures measures = this->measures();
    accounts                    = EnergyAccounts();
    accounts.start = measures.elastic_energy + measures.kinetic_energy;
    step_work.start(start_reaction);
  }

  void
  ElasticitySolver::set_activation(const std::vector<double> &gamma)
  {
    EphyraThrowIf(gamma.size() != level.gamma.size(),
                  InputError,
                  "The activation has "
                    << gamma.size() << " values instead of one on each of "
                    << level.gamma.size() << " lines of Gauss points.");
    next.gamma = gamma;
  }

  void
  ElasticitySolver::newmark(const double dt)
  {
    for (std::size_t i = 0; i < next.a.size(); ++i)
      {
        next.v[i] = level.v[i] + dt * ((1. - alpha.gamma) * level.a[i] +
                                       alpha.gamma * next.a[i]);
        next.u[i] =
          level.u[i] + dt * level.v[i] +
          0.5 * dt * dt *
            ((1. - 2. * alpha.beta) * level.a[i] + 2. * alpha.beta * next.a[i]);
      }
  }

  NewtonStatus
  ElasticitySolver::advance(const double         t,
                            const double         dt,
                            const InterfaceLoad &load)
  {
    const TimerTree::Scope scope(timer(), "elasticity", op->n_unknowns());
    if (!started)
      {
        // The activation already set is that of the end of the step.
        const std::vector<double> gamma = next.gamma;
        next.gamma                      = level.gamma;
        initialize(t);
        next.gamma = gamma;
      }
    if (!newton)
      make_newton();
    // Prescribed displacements hold at t^{n+1}, loads at t^alpha.
    op->set_time(t + dt);
    std::vector<double> prescribed(next.u.size(), 0.);
    op->get_constraints().apply(prescribed);
    op->set_time(t + alpha.alpha_f * dt);
    std::vector<double> gamma(next.gamma.size());
    for (std::size_t i = 0; i < gamma.size(); ++i)
      gamma[i] =
        alpha.alpha_f * next.gamma[i] + (1. - alpha.alpha_f) * level.gamma[i];
    if (gamma != op->activation())
      op->set_activation(gamma);

    // A repeated step keeps its result.
    std::vector<double> x(next.a);
    if (!repeated || !prm.warm_start || dt != last_dt)
      {
        x = level.a;
        // Fast modes, which alternate where nothing damps them, do not follow
        // the trend.
        if (prm.rho_infinity < 1. && !older_acceleration.empty() &&
            dt == last_dt)
          for (std::size_t i = 0; i < x.size(); ++i)
            x[i] += level.a[i] - older_acceleration[i];
      }
    const Constraints &constraints = op->get_constraints();
    for (int i = 0; i < op->n_unknowns(); ++i)
      if (constraints.equation(i) == -1)
        x[i] = ((prescribed[i] - level.u[i] - dt * level.v[i]) / (dt * dt) -
                (0.5 - alpha.beta) * level.a[i]) /
               alpha.beta;

    if (dt != last_dt)
      newton->forget();
    last_t  = t;
    last_dt = dt;
    Problem      problem(*this, dt, load);
    NewtonStatus status = newton->solve(problem, x);
    mpi::broadcast(x.data(), x.size(), op->communicator());
    next.a = x;
    newmark(dt);
    problem.interface_force(next.a, next.f);
    repeated     = status.success;
    counted      = false;
    at_new_level = load.at_new_level;
    if (!status.success)
      status.reason =
        "elasticity at t = " + std::to_string(t + dt) + " s: " + status.reason;
    return status;
  }

  void
  ElasticitySolver::forget()
  {
    if (newton)
      newton->forget();
    older_acceleration.clear();
    repeated = false;
  }

  void
  ElasticitySolver::synchronize(const MPI_Comm ranks)
  {
    for (Level *l : {&level, &next})
      for (std::vector<double> *x : {&l->u, &l->v, &l->a, &l->f, &l->gamma})
        mpi::broadcast(x->data(), x->size(), ranks);
  }

  void
  ElasticitySolver::serialize(Archive &archive)
  {
    Archive::Group group(archive, "elasticity");
    archive.values("displacement", level.u);
    archive.values("velocity", level.v);
    archive.values("acceleration", level.a);
    archive.values("interface_force", level.f);
    archive.values("activation", level.gamma);
    if (archive.reading())
      {
        EphyraThrowIf(
          level.u.size() != static_cast<std::size_t>(op->n_unknowns()) ||
            level.gamma.size() != op->activation_points().size(),
          InputError,
          "The saved body has "
            << level.u.size() << " unknowns and " << level.gamma.size()
            << " lines of activation, the body of the scene "
            << op->n_unknowns() << " and " << op->activation_points().size()
            << "; restart with the scene that was saved.");
        next     = level;
        started  = true;
        repeated = false;
        counted  = true;
        older_acceleration.clear();
      }
    accounts.serialize(archive);
    step_work.serialize(archive);
  }
} // namespace ephyra::elasticity
