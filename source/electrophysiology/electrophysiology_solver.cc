#include "ephyra/electrophysiology/electrophysiology_solver.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"

#include <algorithm>
#include <cmath>

namespace ephyra::electrophysiology
{
  namespace
  {
    std::unique_ptr<IonicModel>
    make_model(const ElectrophysiologySolver::Parameters &prm)
    {
      switch (prm.model)
        {
        case ElectrophysiologySolver::Model::jellyfish_neuron:
          return std::make_unique<MnnNeuron>(prm.neuron);
        case ElectrophysiologySolver::Model::nagumo:
          return std::make_unique<Nagumo>(prm.nagumo);
        default:
          return nullptr;
        }
    }
  } // namespace

  ElectrophysiologySolver::ElectrophysiologySolver(
    const Parameters             &parameters,
    const splines::NurbsPatch<1> &line,
    MPI_Comm                      comm)
    : prm(parameters)
    , comm(comm)
    , model(make_model(prm))
    , monodomain(line, prm.mass, prm.measure)
    , stimulus(prm.stimulus)
    , diffusion(monodomain,
                prm.start,
                prm.end,
                prm.diffusivity(),
                prm.linear_solver,
                comm)
    , stimulus_load(monodomain.interval_load(stimulus.interval()))
  {
    if (model)
      reaction =
        make_reaction(prm.placement, prm.nodal_currents, monodomain, *model);
    initialize();
  }

  ElectrophysiologySolver::ElectrophysiologySolver(const Parameters &parameters,
                                                   MPI_Comm          comm)
    : prm(parameters)
    , comm(comm)
    , model(make_model(prm))
    , stimulus(prm.stimulus)
    , diffusion(monodomain,
                prm.start,
                prm.end,
                prm.diffusivity(),
                prm.linear_solver,
                comm)
    , stimulus_load(1, 1.)
  {
    EphyraThrowIf(!model,
                  InputError,
                  "An isolated cell without an ionic model has nothing to "
                  "compute; choose an ionic model.");
    prm.synapses.release = false;
    reaction             = make_reaction(
      Placement::greville_points, NodalCurrents::none, monodomain, *model);
    initialize();
  }

  void
  ElectrophysiologySolver::initialize()
  {
    const int n       = monodomain.n_unknowns();
    const int n_state = n_points();
    if (prm.measure == MonodomainOperator::Measure::deformed)
      {
        mass_factors.factorize(monodomain.consistent_mass(), "mass matrix");
        stimulus_shape = stimulus_load;
        mass_factors.solve(stimulus_shape.data());
      }
    const double rest = model ? model->rest_potential() : 0.;
    v.assign(n, rest);
    increment.assign(n, 0.);
    old_v.assign(n, 0.);
    total_load.assign(n, 0.);
    load.assign(n, 0.);
    previous_load.assign(n, 0.);
    combined_load.assign(n, 0.);
    points_v.assign(n_state, rest);
    old_points_v.assign(n_state, rest);
    middle_v.assign(n_state, rest);
    no_synapses.assign(n_state, 0.);
    awake = AwakeRanges(nullptr, n_state, 0.);
    point_values.assign(n_state, 0.);
    if (model)
      {
        std::vector<double> steady(model->n_gates());
        model->steady_gates(rest, steady.data());
        for (const double gate : steady)
          gates.insert(gates.end(), n_state, gate);
        awake = AwakeRanges(model.get(),
                            n_state,
                            model->has_synapses() && n > 1 ? prm.sleep_tolerance
                                                           : 0.);
        if (model->has_synapses())
          synapses.emplace(
            prm.synapses, prm.neuron.capacitance * 1e-12, n_state);
        if (model->activation_gate() >= 0)
          {
            muscle.emplace(prm.activation, n_state, prm.stimulus.frequency);
            muscle->initialize(
              &gates[static_cast<std::size_t>(model->activation_gate()) *
                     n_state]);
          }
        for (int i = 0; i < n_state; ++i)
          if (n == 1 || (reaction->theta()[i] >= stimulus.interval()[0] &&
                         reaction->theta()[i] <= stimulus.interval()[1]))
            stimulated_points.push_back(i);
      }
    if (!prm.initial_potential.empty())
      {
        const Expression initial(prm.initial_potential, {"s"});
        set_potential([&](const double s) { return initial(s); });
      }
    may_rest = prm.resting_time_step > prm.time_step && synapses;
    EphyraThrowIf(
      may_rest && prm.resting_time_step > awake.largest_resting_step(),
      InputError,
      "The resting time step of "
        << prm.resting_time_step << " s is beyond "
        << awake.largest_resting_step()
        << " s, up to which the explicit ionic currents are stable "
           "at rest; lower \"Electrophysiology/Resting time step\".");
    evaluate_load(load);
  }

  bool
  ElectrophysiologySolver::set_deformed_metric(const std::vector<double> &G11,
                                               const std::vector<double> &r)
  {
    if (!monodomain.set_metric(G11, r, prm.metric_tolerance))
      return false;
    if (prm.measure == MonodomainOperator::Measure::deformed)
      {
        // The former reaction, in the new measure.
        increment = previous_load;
        mass_factors.solve(increment.data());
        monodomain.consistent_mass().multiply(increment.data(),
                                              previous_load.data());
        evaluate_load(load);
      }
    metric_changed();
    return true;
  }

  void
  ElectrophysiologySolver::metric_changed()
  {
    diffusion.matrices_changed();
    if (reaction)
      reaction->metric_changed();
    if (prm.measure == MonodomainOperator::Measure::reference)
      return;
    mass_factors.factorize(monodomain.consistent_mass(), "mass matrix");
    monodomain.consistent_mass().multiply(stimulus_shape.data(),
                                          stimulus_load.data());
  }

  std::vector<double>
  ElectrophysiologySolver::interpolate(
    const std::function<double(double)> &function) const
  {
    std::vector<double> coefficients;
    for (const double theta : monodomain.greville())
      coefficients.push_back(function(theta));
    linear_algebra::NarrowBandSolver collocation;
    collocation.factorize(monodomain.collocation(),
                          "matrix of the Greville points");
    collocation.solve(coefficients.data());
    return coefficients;
  }

  void
  ElectrophysiologySolver::set_potential(
    const std::function<double(double)> &potential)
  {
    v = interpolate(potential);
    if (monodomain.closed())
      {
        EphyraThrowIf(std::abs(v.back() - v.front()) >
                        1e-6 * std::max(std::abs(v.front()), 1e-3),
                      InputError,
                      "The initial potential is "
                        << v.front() << " V at theta^1 = 0 and " << v.back()
                        << " V at 1, which are one point of the closed line; "
                           "give a periodic one.");
        v.back() = v.front();
      }
    if (reaction)
      reaction->to_points(v.data(), points_v.data());
    update_awake();
    evaluate_load(load);
  }

  // --- one step --------------------------------------------------------------

  const double *
  ElectrophysiologySolver::synaptic_conductance() const
  {
    return synapses ? synapses->conductance() : no_synapses.data();
  }

  void
  ElectrophysiologySolver::update_awake()
  {
    awake.update(points_v.data(), gates.data(), synaptic_conductance());
  }

  void
  ElectrophysiologySolver::evaluate_load(std::vector<double> &result)
  {
    if (reaction)
      reaction->load(
        {points_v.data(), gates.data(), synaptic_conductance(), &awake},
        result.data());
  }

  void
  ElectrophysiologySolver::solve_increment(
    const double t, const double dt, const std::vector<double> &reaction_load)
  {
    const double current = stimulus.mean_current(t, dt) / prm.capacitance;
    for (std::size_t i = 0; i < total_load.size(); ++i)
      total_load[i] = reaction_load[i] + current * stimulus_load[i];
    diffusion.solve(t, dt, total_load, v, increment);
  }

  void
  ElectrophysiologySolver::advance_state(const double t, const double dt)
  {
    for (std::size_t i = 0; i < v.size(); ++i)
      v[i] += increment[i];
    if (!reaction)
      return;
    std::swap(points_v, old_points_v);
    reaction->to_points(v.data(), points_v.data());
    if (synapses)
      {
        synapses->advance(t, dt, old_points_v.data(), points_v.data());
        const auto epscs = stimulus.epscs(epscs_given_until, t + dt);
        for (auto time = epscs[0]; time != epscs[1]; ++time)
          for (const int point : stimulated_points)
            synapses->add_epsc(point, *time, t + dt);
      }
    update_awake();
    if (model->n_gates() == 0)
      return;
    const bool    at_end   = prm.gate_potential == GatePotential::end;
    const double *gate_v   = at_end ? points_v.data() : middle_v.data();
    const int     n_points = reaction->n_points();
    for (const AwakeRanges::Range &range : awake.ranges())
      {
        for (int i = range[0]; i < range[1]; ++i)
          middle_v[i] = 0.5 * (points_v[i] + old_points_v[i]);
        model->advance_gates(range[1] - range[0],
                             gate_v + range[0],
                             dt,
                             gates.data() + range[0],
                             n_points);
      }
  }

  void
  ElectrophysiologySolver::predict_load(const double t, const double dt)
  {
    old_v           = v;
    gates_backup    = gates;
    synapses_backup = synapses;
    solve_increment(t, dt, load);
    advance_state(t, dt);
    evaluate_load(combined_load);
    for (std::size_t i = 0; i < load.size(); ++i)
      combined_load[i] = 0.5 * (load[i] + combined_load[i]);
    v        = old_v;
    gates    = gates_backup;
    synapses = synapses_backup;
    std::swap(points_v, old_points_v);
  }

  void
  ElectrophysiologySolver::substep(const double t, const double dt)
  {
    const double ratio = previous_dt > 0 ? dt / previous_dt : 0.;
    if (reaction)
      {
        if (ratio < 0.5 || ratio > 2)
          predict_load(t, dt);
        else
          for (std::size_t i = 0; i < load.size(); ++i)
            combined_load[i] =
              load[i] + 0.5 * ratio * (load[i] - previous_load[i]);
      }
    solve_increment(t, dt, combined_load);
    if (!probes.empty())
      old_v = v;
    advance_state(t, dt);
    epscs_given_until = std::max(epscs_given_until, t + dt);
    if (muscle)
      muscle->record(t,
                     dt,
                     &gates[static_cast<std::size_t>(model->activation_gate()) *
                            n_points()]);
    probes.record(t, dt, old_v, v);
    if (front)
      front->record(t + dt, v);
    if (model && model->activation_gate() >= 0)
      for (std::size_t p = 0; p < probe_points.size(); ++p)
        largest_gates[p] =
          std::max(largest_gates[p],
                   gates[static_cast<std::size_t>(model->activation_gate()) *
                           n_points() +
                         probe_points[p]]);
    diffusion.finish_step();

    std::swap(load, previous_load);
    evaluate_load(load);
    previous_dt = dt;
    ++substeps;
    awake_points += awake.n_awake();
    if (may_rest)
      adapt_step(dt);
  }

  bool
  ElectrophysiologySolver::blown_up() const
  {
    constexpr double absurd_potential = 1e3;
    double           sum              = 0;
    for (const double x : v)
      sum += std::abs(x);
    return !(sum < absurd_potential * static_cast<double>(v.size()));
  }

  std::string
  ElectrophysiologySolver::failure_reason(const double t, const double dt) const
  {
    std::ostringstream reason;
    reason << "The transmembrane potential diverged before t = " << t
           << " s with substeps of " << dt << " s";
    const double limit = model ? 1. / model->fastest_rate() : 0.;
    if (dt > 0.5 * limit && model)
      reason << ": the explicit ionic currents need steps below about " << limit
             << " s; reduce \"Electrophysiology/Time step\".";
    else
      reason << "; check stimulus, boundary conditions and conductivity.";
    return reason.str();
  }

  void
  ElectrophysiologySolver::synchronize()
  {
    if (mpi::size(comm) == 1)
      return;
    for (std::vector<double> *values :
         {&v, &gates, &load, &previous_load, &points_v})
      mpi::broadcast(values->data(), values->size(), comm);
    if (synapses)
      synapses->synchronize(comm);
  }

  // --- output ----------------------------------------------------------------

  void
  ElectrophysiologySolver::activation(const double         t,
                                      std::vector<double> &coefficients) const
  {
    coefficients.assign(n_control_points(), 0.);
    if (!muscle)
      return;
    for (int i = 0; i < n_points(); ++i)
      point_values[i] = muscle->value(i, t);
    reaction->to_coefficients(point_values.data(), coefficients.data());
    // Interpolation may undershoot where the activation begins.
    for (double &gamma : coefficients)
      gamma = std::max(gamma, 0.);
    mpi::broadcast(coefficients.data(), coefficients.size(), comm);
  }

  double
  ElectrophysiologySolver::potential_at(const double theta) const
  {
    int                 first;
    std::vector<double> N;
    monodomain.basis(theta, first, N);
    double value = 0;
    for (std::size_t a = 0; a < N.size(); ++a)
      value += N[a] * v[first + a];
    return value;
  }

  void
  ElectrophysiologySolver::serialize(Archive &archive)
  {
    const Archive::Group group(archive, "electrophysiology");
    archive.values("potential", v);
    archive.values("gates", gates);
    archive.values("load", load);
    archive.values("previous load", previous_load);
    archive.value("previous step", previous_dt);
    archive.value("calm time", calm_time);
    archive.value("step doublings", step_doublings);
    archive.value("behind", behind);
    archive.value("awake points", awake_points);
    archive.value("EPSCs given until", epscs_given_until);
    archive.value("substeps", substeps);
    if (synapses)
      synapses->serialize(archive);
    if (muscle)
      muscle->serialize(archive);
    probes.serialize(archive);
    if (front)
      front->serialize(archive);
    archive.values("largest gates", largest_gates);

    std::vector<double> G11 = monodomain.metric_G11(),
                        r   = monodomain.metric_r();
    archive.values("metric", G11);
    archive.values("radius", r);
    if (archive.reading())
      {
        if (monodomain.set_metric(G11, r, 0.))
          metric_changed();
        if (reaction)
          reaction->to_points(v.data(), points_v.data());
      }
    diffusion.serialize(archive);
  }
} // namespace ephyra::electrophysiology
