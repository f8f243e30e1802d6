#include "ephyra/immersed_boundary/rigid_flow.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/log.h"
#include "ephyra/base/timer_tree.h"
#include "ephyra/immersed_boundary/interior_momentum.h"
#include "ephyra/immersed_boundary/no_slip_iteration.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace ephyra::immersed_boundary
{
  namespace
  {
    constexpr double tolerance_of_velocity = 1e-6; ///< relative
    constexpr int    most_evaluations      = 20;

    std::vector<BoundaryCurve>
    all_curves(const std::vector<std::unique_ptr<RigidBody>> &bodies,
               std::vector<int>                              &first_curve,
               std::vector<double>                           &reference,
               std::vector<int>                              &body_of_point)
    {
      std::vector<BoundaryCurve> curves;
      first_curve.assign(1, 0);
      for (std::size_t b = 0; b < bodies.size(); ++b)
        {
          const int first_point = static_cast<int>(body_of_point.size());
          for (BoundaryCurve curve : bodies[b]->outline.curves)
            {
              for (int &i : curve.control_points)
                i += first_point;
              curves.push_back(curve);
            }
          first_curve.push_back(static_cast<int>(curves.size()));
          const std::vector<double> x = control_vector(bodies[b]->outline);
          reference.insert(reference.end(), x.begin(), x.end());
          body_of_point.insert(
            body_of_point.end(), x.size() / 2, static_cast<int>(b));
        }
      return curves;
    }
  } // namespace

  RigidFlow::RigidFlow(fluid::FlowSolver                      &flow,
                       std::vector<std::unique_ptr<RigidBody>> bodies_in,
                       const Parameters                       &parameters)
    : flow(flow)
    , bodies(std::move(bodies_in))
    , parameters(parameters)
    , forcing(flow.grid(), parameters)
    , surface_loads(flow.grid(), flow.density(), flow.viscosity(), parameters)
  {
    const auto curves =
      all_curves(bodies, first_curve, reference, body_of_point);
    std::vector<double> x = reference, positions;
    for (const auto &body : bodies)
      positions.push_back(body->position);
    for (std::size_t i = 0; i < body_of_point.size(); ++i)
      x[2 * i + 1] += positions[body_of_point[i]];
    the_markers = std::make_unique<Markers>(curves, x, flow.grid(), parameters);
    place_markers(positions);

    using Interior = RigidBody::InteriorFluid;
    for (int b = 0; b < n_bodies(); ++b)
      {
        const RigidBody::Parameters &p = bodies[b]->parameters;
        measured.push_back(
          bodies[b]->is_free() &&
          (p.interior == Interior::measured ||
           (p.interior == Interior::automatic && p.density < flow.density())));
        measures_momentum = measures_momentum || measured.back();
        if (bodies[b]->is_free())
          free_bodies.push_back(b);
      }
    EphyraThrowIf(parameters.no_slip_iterations > 0 && !free_bodies.empty(),
                  InputError,
                  "'No-slip iterations' are for bodies that are fixed or moved "
                  "by a law, but body '"
                    << bodies[free_bodies[0]]->parameters.name
                    << "' is free: set them to 0.");
    flow.keep_predicted(measures_momentum || parameters.no_slip_iterations > 0);
    log().line("Immersed boundary: " + parameters.description() + ", " +
               std::to_string(the_markers->size()) + " markers.");
    const std::size_t n = free_bodies.size();
    momentum_slope.assign(n * n, 0.);
    for (std::size_t k = 0; k < n; ++k)
      momentum_slope[k * n + k] = 0.5 * bodies[free_bodies[k]]->volume;
    force.assign(n_bodies(), 0.);
    check_start();
    momentum = interior_momenta();
  }

  void
  RigidFlow::place_markers(const std::vector<double> &positions)
  {
    std::vector<double> x = reference, v(x.size(), 0.), a(x.size(), 0.);
    for (std::size_t i = 0; i < body_of_point.size(); ++i)
      {
        const RigidBody &body = *bodies[body_of_point[i]];
        x[2 * i + 1] += positions[body_of_point[i]];
        v[2 * i + 1] = body.velocity;
        a[2 * i + 1] = body.acceleration;
      }
    the_markers->move(x, v, a);
  }

  std::vector<double>
  RigidFlow::interior_momenta() const
  {
    std::vector<double> result;
    for (int b = 0; b < n_bodies(); ++b)
      result.push_back(interior_axial_momentum(*the_markers,
                                               first_curve[b],
                                               first_curve[b + 1],
                                               flow.velocity().y,
                                               bodies[b]->position));
    return result;
  }

  double
  RigidFlow::marker_impulse(const int b) const
  {
    const int n     = the_markers->size();
    const int begin = the_markers->first_of_curve()[first_curve[b]];
    const int end   = the_markers->first_of_curve()[first_curve[b + 1]];
    double    sum   = 0;
    for (int l = begin; l < end; ++l)
      sum += forcing.impulse_weights()[l] * F[n + l];
    return sum;
  }

  void
  RigidFlow::set_axial_velocity(const int b, const double velocity)
  {
    bodies[b]->velocity = velocity;
    const int n         = the_markers->size();
    const int begin     = the_markers->first_of_curve()[first_curve[b]];
    const int end       = the_markers->first_of_curve()[first_curve[b + 1]];
    for (int l = begin; l < end; ++l)
      target[n + l] = velocity;
  }

  void
  RigidFlow::solve_forcing()
  {
    residual.resize(target.size());
    for (std::size_t l = 0; l < target.size(); ++l)
      residual[l] = target[l] - Ju[l];
    forcing.solve(residual, F);
  }

  StepStatus
  RigidFlow::force_and_project(const unsigned int stage)
  {
    if (parameters.no_slip_iterations > 0)
      {
        const StepStatus status =
          converge_no_slip(flow,
                           stage,
                           forcing,
                           target,
                           parameters.no_slip_tolerance,
                           parameters.no_slip_iterations,
                           F);
        projections += 2 + status.iterations + (status.iterations > 0);
        return status;
      }
    forcing.add(F, flow, stage);
    flow.project(stage);
    ++projections;
    return StepStatus();
  }

  StepStatus
  RigidFlow::force_stage(const unsigned int stage, const double h)
  {
    // Everything over the density of the fluid: masses are volumes.
    const int n = static_cast<int>(free_bodies.size());
    if (n == 0)
      {
        solve_forcing();
        return force_and_project(stage);
      }

    const auto free = [&](const int k) -> RigidBody & {
      return *bodies[free_bodies[k]];
    };
    const auto is_measured = [&](const int k) {
      return measured[free_bodies[k]] == 1;
    };

    // Impulse of the markers: I0 + A V.
    Eigen::VectorXd I0(n), V_old(n), ratio(n), volume(n), scale(n);
    Eigen::MatrixXd A(n, n);
    for (int k = 0; k < n; ++k)
      {
        V_old[k]  = free(k).velocity;
        volume[k] = free(k).volume;
        ratio[k]  = free(k).parameters.density / flow.density();
        set_axial_velocity(free_bodies[k], 0.);
      }
    solve_forcing();
    for (int k = 0; k < n; ++k)
      I0[k] = marker_impulse(free_bodies[k]);
    for (int c = 0; c < n; ++c)
      {
        const int body = free_bodies[c];
        std::fill(residual.begin(), residual.end(), 0.);
        const int m = the_markers->size();
        std::fill(residual.begin() + m +
                    the_markers->first_of_curve()[first_curve[body]],
                  residual.begin() + m +
                    the_markers->first_of_curve()[first_curve[body + 1]],
                  1.);
        forcing.solve(residual, F);
        for (int k = 0; k < n; ++k)
          A(k, c) = marker_impulse(free_bodies[k]);
      }

    using SlopeMatrix =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<SlopeMatrix> slope(momentum_slope.data(), n, n);
    const auto              jacobian = [&]() {
      Eigen::MatrixXd J = A;
      for (int k = 0; k < n; ++k)
        {
          J(k, k) += ratio[k] * volume[k];
          if (is_measured(k))
            J.row(k) -= slope.row(k);
          else
            J(k, k) -= volume[k];
        }
      return J;
    };
    // What is left of the equation of motion at the velocities V, with the
    // change dP of the momentum inside of the measured bodies.
    const auto unbalance = [&](const Eigen::VectorXd &V,
                               const Eigen::VectorXd &dP) -> Eigen::VectorXd {
      Eigen::VectorXd R = I0 + A * V;
      for (int k = 0; k < n; ++k)
        R[k] += ratio[k] * volume[k] * (V[k] - V_old[k]) -
                (is_measured(k) ? dP[k] : volume[k] * (V[k] - V_old[k])) -
                (ratio[k] - 1.) * volume[k] * free(k).parameters.gravity * h;
      return R;
    };

    Eigen::VectorXd V = V_old, dP = Eigen::VectorXd::Zero(n);
    if (!measures_momentum)
      V -= jacobian().partialPivLu().solve(unbalance(V, dP));
    else
      for (int k = 0; k < n; ++k)
        V[k] += h * free(k).acceleration;

    Eigen::VectorXd V_before, dP_before;
    for (int evaluation = 1;; ++evaluation)
      {
        for (int k = 0; k < n; ++k)
          {
            if (!std::isfinite(V[k]))
              return StepStatus::failure(
                "The velocity of the free body '" + free(k).parameters.name +
                "' is not finite: reduce the time step.");
            set_axial_velocity(free_bodies[k], V[k]);
          }
        if (evaluation > 1)
          flow.reset_to_predicted(stage);
        solve_forcing();
        force_and_project(stage);
        if (!measures_momentum)
          break;

        const std::vector<double> P = interior_momenta();
        for (int k = 0; k < n; ++k)
          dP[k] = P[free_bodies[k]] - momentum[free_bodies[k]];
        if (evaluation > 1) // Broyden's update of dP/dV, exact for one body
          {
            const Eigen::VectorXd dV = V - V_before;
            slope +=
              (dP - dP_before - slope * dV) * dV.transpose() / dV.squaredNorm();
          }
        const Eigen::VectorXd step =
          jacobian().partialPivLu().solve(unbalance(V, dP));
        bool settled = true;
        for (int k = 0; k < n; ++k)
          settled =
            settled &&
            std::abs(step[k]) <=
              tolerance_of_velocity *
                (std::abs(V[k]) +
                 std::abs((ratio[k] - 1.) * free(k).parameters.gravity * h));
        if (settled)
          break;
        if (evaluation == most_evaluations)
          return StepStatus::failure(
            "The velocity of the free body '" + free(0).parameters.name +
            "' has not settled after " + std::to_string(evaluation) +
            " evaluations of a stage: reduce the time step.");
        V_before  = V;
        dP_before = dP;
        V -= step;
      }
    return StepStatus();
  }

  StepStatus
  RigidFlow::advance(const double t, const double dt)
  {
    flow.begin_step(t, dt);
    projections = 0;
    impulse.assign(n_bodies(), 0.);
    const std::vector<double> momentum_before = momentum;
    std::vector<double>       velocity_before;
    for (const auto &body : bodies)
      velocity_before.push_back(body->velocity);

    double time = t;
    for (unsigned int stage = 0; stage < flow.n_stages(); ++stage)
      {
        const double h = flow.stage_dt(stage);
        flow.predict(stage);

        std::vector<double> positions, V_old;
        bool                moved = false;
        for (const auto &body : bodies)
          {
            V_old.push_back(body->velocity);
            positions.push_back(
              body->position +
              (body->is_free()
                 ? h * (body->velocity + 0.5 * h * body->acceleration)
                 : body->displacement(time, time + h)));
            if (!body->is_free())
              body->velocity = body->law(time + h);
            moved =
              moved || body->parameters.motion != RigidBody::Motion::fixed;
          }
        {
          const TimerTree::Scope scope(timer(), "forcing", the_markers->size());
          if (moved || !forcing_valid || forcing_shift != flow.grid().shift())
            {
              place_markers(positions);
              forcing.update(*the_markers);
              forcing_valid = true;
              forcing_shift = flow.grid().shift();
            }
          const MarkerState &m = the_markers->state();
          target               = m.v_r;
          target.insert(target.end(), m.v_y.begin(), m.v_y.end());
          forcing.prepare(flow, stage);
          forcing.interpolate(flow.velocity(), Ju);
        }
        const StepStatus status = force_stage(stage, h);
        if (!status.success)
          return status;
        for (int b = 0; b < n_bodies(); ++b)
          {
            bodies[b]->position =
              bodies[b]->is_free()
                ? bodies[b]->position +
                    0.5 * h * (V_old[b] + bodies[b]->velocity)
                : positions[b];
            impulse[b] += flow.density() * marker_impulse(b);
          }
        if (measures_momentum)
          momentum = interior_momenta();
        time += h;
      }
    if (!measures_momentum)
      momentum = interior_momenta();
    flow.end_step();

    std::vector<double> positions;
    for (int b = 0; b < n_bodies(); ++b)
      {
        RigidBody &body = *bodies[b];
        body.acceleration =
          body.is_free()
            ? (body.velocity - velocity_before[b]) / dt
            : (body.law(t + 1.5 * dt) - body.law(t + 0.5 * dt)) / dt;
        force[b] =
          (-impulse[b] + flow.density() * (momentum[b] - momentum_before[b])) /
          dt;
        positions.push_back(body.position);
      }
    place_markers(positions);
    return StepStatus();
  }

  void
  RigidFlow::serialize(Archive &archive)
  {
    {
      const Archive::Group group(archive, "flow");
      flow.serialize(archive);
    }
    for (const auto &body : bodies)
      body->serialize(archive);
    const Archive::Group group(archive, "rigid flow");
    archive.values("momentum inside", momentum);
    archive.values("momentum slope", momentum_slope);
    archive.values("force", force);
    if (archive.reading())
      {
        std::vector<double> positions;
        for (const auto &body : bodies)
          positions.push_back(body->position);
        place_markers(positions);
        forcing_valid = false;
      }
  }
} // namespace ephyra::immersed_boundary
