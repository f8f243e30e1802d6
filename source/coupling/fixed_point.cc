#include "ephyra/coupling/fixed_point.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/log.h"
#include "ephyra/base/timer_tree.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ephyra::coupling
{
  namespace
  {
    double
    norm(const std::vector<double> &x)
    {
      double sum = 0;
      for (const double value : x)
        sum += value * value;
      return std::sqrt(sum);
    }

    /// A explains nearly all of the answer, so that the first iteration of a
    /// run need not be relaxed.
    std::unique_ptr<Acceleration>
    acceleration_of(Acceleration::Parameters parameters,
                    const bool               with_added_mass)
    {
      if (with_added_mass)
        parameters.initial_relaxation = parameters.largest_relaxation;
      return make_acceleration(parameters);
    }
  } // namespace

  FixedPoint::FixedPoint(fluid::FlowSolver        &flow,
                         DeformableBody           &body,
                         WetSurface               &surface,
                         const CouplingParameters &parameters,
                         const bool                with_added_mass)
    : FluidStructureScheme(flow, body, surface)
    , parameters(parameters)
    , acceleration(acceleration_of(parameters.acceleration, with_added_mass))
    , older_load(body.n_unknowns(), 0.)
    , older_acceleration(body.n_unknowns(), 0.)
  {
    flow.keep_predicted(flow.n_stages() == 1);
    surface.prepare_fluid_load(flow);
    if (!with_added_mass)
      return;
    if (parameters.added_mass == AddedMassKind::forcing)
      {
        EphyraThrowIf(flow.n_stages() != 1,
                      InputError,
                      "Coupling/Added mass = forcing needs a flow with one "
                      "projection a step; set Fluid/Time scheme = ab2 or Added "
                      "mass = full.");
        with_forcing_resistance = true;
        allow_forcing_resistance();
        return;
      }
    added_mass = std::make_unique<AddedMass>(
      surface.markers(), body.n_unknowns() / 2, parameters.added_mass);
    body.mechanics().allow_coupling(added_mass->pattern());
  }

  StepStatus
  FixedPoint::measure_added_mass(const std::string &reason)
  {
    const TimerTree::Scope scope(timer(), "added mass");
    const auto            &unknowns = added_mass->unknowns();
    const auto             n = static_cast<Eigen::Index>(unknowns.size());
    const auto &constraints  = body.mechanics().body().get_constraints();
    // Fast enough to stand out from round-off, too slow for the convection of a
    // later stage, or inside the body, to matter.
    constexpr double courant_number = 1e-3;
    const auto      &grid           = flow.grid();
    const double     velocity =
      courant_number *
      std::min(grid.r.smallest_width(), grid.y.smallest_width()) / step;
    const double        a      = velocity / (body.newmark_gamma() * step);
    BodyMotion          motion = body.extrapolated_motion(step);
    std::vector<double> base, changed;
    StepStatus          status  = respond(motion, base);
    Eigen::MatrixXd     columns = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index k = 0; k < n && status.success; ++k)
      {
        const int i = unknowns[k];
        if (constraints.equation(i) < 0)
          continue;
        const double v_i = motion.velocity[i], a_i = motion.acceleration[i];
        motion.velocity[i] += velocity;
        motion.acceleration[i] += a;
        status = respond(motion, changed);
        if (!status.success)
          break;
        motion.velocity[i]     = v_i;
        motion.acceleration[i] = a_i;
        for (Eigen::Index l = 0; l < n; ++l)
          columns(l, k) = (changed[unknowns[l]] - base[unknowns[l]]) / a;
      }
    if (!status.success)
      return status;
    added_mass->set(std::move(columns), surface.markers());
    excess = 0;
    std::ostringstream line;
    line << "Coupling: added mass of " << n << " unknowns measured at "
         << step_start << " s (" << reason << ").";
    log().line(line.str());
    return status;
  }

  StepStatus
  FixedPoint::advance(const double t, const double dt)
  {
    StepStatus status = prepare(t, dt);
    if (!status.success)
      return status;
    if (with_forcing_resistance)
      allow_forcing_resistance();
    bool measured = false;
    if (added_mass)
      {
        const auto enough =
          static_cast<std::int64_t>(added_mass->unknowns().size());
        measured = !added_mass->known() || excess > enough;
        if (measured)
          status = measure_added_mass(
            added_mass->known() ? "the old one has aged" : "first step");
        if (!status.success)
          return status;
      }
    std::vector<double> answer;
    status = iterate(t, dt, answer);
    if (!status.success && added_mass && !measured)
      {
        status = measure_added_mass("the step did not converge");
        if (status.success)
          status = iterate(t, dt, answer);
      }
    if (!status.success)
      return status;
    excess += std::max(0, status.iterations - 2);
    older_load         = load;
    older_acceleration = body.mechanics().old_acceleration();
    older_step         = dt;
    accept(answer);
    last = status;
    return status;
  }

  StepStatus
  FixedPoint::iterate(const double         t,
                      const double         dt,
                      std::vector<double> &answer)
  {
    const std::size_t         n = body.n_unknowns();
    elasticity::InterfaceLoad interface_load;
    AddedMass::Matrix         A;
    // Linear prediction of the load, and with A of the acceleration.
    const double         trend = older_step > 0 ? dt / older_step : 0.;
    std::vector<double> &g     = interface_load.constant;
    g                          = load;
    for (std::size_t i = 0; i < n; ++i)
      g[i] += trend * (load[i] - older_load[i]);
    if (added_mass)
      A = added_mass->at(surface.markers());
    else if (with_forcing_resistance)
      A = surface.forcing_resistance(dt) * (-dt * body.newmark_gamma());
    if (A.nonZeros() > 0)
      {
        interface_load.added = &A;
        Eigen::VectorXd a(n);
        const auto     &old = body.mechanics().old_acceleration();
        for (std::size_t i = 0; i < n; ++i)
          a[i] = old[i] + trend * (old[i] - older_acceleration[i]);
        Eigen::Map<Eigen::VectorXd>(g.data(), n) -= A * a;
      }

    // Loads that strain the body by less than this are below what its Newton
    // iteration resolves.
    constexpr double smallest_strain = 1e-11;
    const double     floor =
      std::max(parameters.absolute_tolerance,
               smallest_strain * body.mechanics().body().unit_force());
    StepStatus status;
    acceleration->start_step();
    for (int k = 1; k <= parameters.maximum_iterations; ++k)
      {
        status = body.advance_mechanics(t, dt, interface_load);
        if (!status.success)
          break;
        status = respond(body.motion(), answer);
        if (!status.success)
          break;
        const std::vector<double> &used = body.interface_force();
        std::vector<double>        improved(g); // g plus the residual
        double                     change = 0;
        for (std::size_t i = 0; i < n; ++i)
          {
            improved[i] += answer[i] - used[i];
            change += std::pow(answer[i] - used[i], 2);
          }
        change            = std::sqrt(change);
        const double size = norm(answer);
        if (!std::isfinite(change))
          {
            status = StepStatus::failure(
              "The load of the fluid on the body is not finite in coupling "
              "iteration " +
              std::to_string(k) + ".");
            break;
          }
        status.iterations = k;
        status.residual   = size > 0 ? change / size : 0.;
        relaxation        = acceleration->relaxation();
        if (change <= parameters.tolerance * size + floor)
          {
            acceleration->finish_step(true);
            return status;
          }
        g = acceleration->next(g, improved);
      }

    acceleration->finish_step(false);
    if (status.success)
      {
        std::ostringstream reason;
        reason << "The coupling did not converge in "
               << parameters.maximum_iterations
               << " iterations: relative residual " << status.residual
               << ", tolerance " << parameters.tolerance
               << ". Take smaller steps, more iterations or a looser tolerance "
                  "(section Coupling).";
        status = StepStatus::failure(reason.str());
      }
    return status;
  }

  void
  FixedPoint::serialize(Archive &archive)
  {
    FluidStructureScheme::serialize(archive);
    archive.values("older load", older_load);
    archive.values("older acceleration", older_acceleration);
    archive.value("older step", older_step);
    {
      const Archive::Group group(archive, "acceleration");
      acceleration->serialize(archive);
    }
    if (!added_mass)
      return;
    const Archive::Group group(archive, "added mass");
    archive.value("excess", excess);
    added_mass->serialize(archive);
  }
} // namespace ephyra::coupling
