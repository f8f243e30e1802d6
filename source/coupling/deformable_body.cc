#include "ephyra/coupling/deformable_body.h"

#include "ephyra/splines/control_vector.h"

namespace ephyra::coupling
{
  DeformableBody::DeformableBody(
    const elasticity::ElasticitySolver::Parameters &parameters,
    const splines::NurbsPatch<2>                   &patch,
    const MPI_Comm                                  solver_comm,
    const MPI_Comm                                  comm)
    : comm(comm)
    , solver(parameters, patch, solver_comm)
    , kinematics(patch)
  {
    reference = splines::control_vector(patch);
  }

  void
  DeformableBody::set_activation_source(
    std::unique_ptr<ActivationSource> new_source)
  {
    source = std::move(new_source);
    if (source)
      solver.set_activation(source->activation());
  }

  StepStatus
  DeformableBody::advance_activation(const double t, const double dt)
  {
    if (!source)
      return {};
    const StepStatus status = source->advance(t, dt, solver.old_displacement());
    if (status.success)
      solver.set_activation(source->activation());
    return status;
  }

  StepStatus
  DeformableBody::advance_mechanics(const double                     t,
                                    const double                     dt,
                                    const elasticity::InterfaceLoad &load)
  {
    const elasticity::NewtonStatus status = solver.advance(t, dt, load);
    newton_iterations                     = status.iterations;
    return status;
  }

  void
  DeformableBody::accept()
  {
    solver.accept();
    solver.synchronize(comm);
  }

  BodyMotion
  DeformableBody::motion() const
  {
    return motion_between(1.);
  }

  BodyMotion
  DeformableBody::extrapolated_motion(const double dt) const
  {
    BodyMotion result{
      reference, solver.old_velocity(), solver.old_acceleration()};
    const auto &u = solver.old_displacement();
    for (std::size_t i = 0; i < reference.size(); ++i)
      {
        const double a = result.acceleration[i];
        result.position[i] += u[i] + dt * (result.velocity[i] + 0.5 * dt * a);
        result.velocity[i] += dt * a;
      }
    return result;
  }

  BodyMotion
  DeformableBody::motion_without_new_acceleration(const double dt) const
  {
    BodyMotion   result = extrapolated_motion(dt);
    const double gamma  = newmark_gamma();
    for (std::size_t i = 0; i < reference.size(); ++i)
      result.velocity[i] -= dt * gamma * result.acceleration[i];
    return result;
  }

  BodyMotion
  DeformableBody::motion_between(const double fraction) const
  {
    const auto blend = [fraction](const std::vector<double> &old_values,
                                  const std::vector<double> &new_values) {
      std::vector<double> result(new_values);
      for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = (1. - fraction) * old_values[i] + fraction * new_values[i];
      return result;
    };
    BodyMotion result{blend(solver.old_displacement(), solver.displacement()),
                      blend(solver.old_velocity(), solver.velocity()),
                      blend(solver.old_acceleration(), solver.acceleration())};
    for (std::size_t i = 0; i < reference.size(); ++i)
      result.position[i] += reference[i];
    return result;
  }

  double
  DeformableBody::centre_of_mass() const
  {
    return solver.body().centre_of_mass(solver.old_displacement());
  }

  double
  DeformableBody::speed() const
  {
    // The centre of mass is affine in the displacement.
    const elasticity::ElasticityOperator &body = solver.body();
    const std::vector<double>             rest(body.n_unknowns(), 0.);
    return body.centre_of_mass(solver.old_velocity()) -
           body.centre_of_mass(rest);
  }

  void
  DeformableBody::serialize(Archive &archive)
  {
    solver.serialize(archive);
    if (source)
      source->serialize(archive);
  }

  double
  DeformableBody::evaluate(Record &record) const
  {
    const elasticity::BodyMeasures measures = solver.measures();
    record.add("centre of mass y [m]", measures.centre_of_mass);
    record.add("centre of mass velocity y [m/s]",
               measures.momentum / measures.mass);
    kinematics.evaluate(solver.displacement(), record);
    record.add("volume [m^3]", measures.volume);
    record.add("volume change [-]", measures.volume_change);
    record.add("smallest J [-]", measures.smallest_J);
    record.add("largest J [-]", measures.largest_J);
    elasticity::EnergyAccounts::Parts parts = solver.energy_parts();
    parts.muscle                            = source != nullptr;
    solver.energy().evaluate(measures, parts, record);
    if (source)
      source->evaluate(record);
    record.add("Newton iterations [-]", newton_iterations);
    return solver.energy().imbalance(measures);
  }
} // namespace ephyra::coupling
