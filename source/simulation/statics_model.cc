#include "ephyra/simulation/statics_model.h"

#include "ephyra/base/log.h"

namespace ephyra::simulation
{
  StaticsModel::StaticsModel(const Scene &scene, const MPI_Comm comm)
    : end_time(scene.equilibrium.end_time)
  {
    const geometry::BodyPatch shape = geometry::create_body(scene.body);
    solver = std::make_unique<elasticity::StaticsSolver>(
      scene.equilibrium, shape.patch, comm);
    log().line("Body: " + solver->body().description());
    if (scene.muscle == Scene::Muscle::prescribed)
      muscle = std::make_unique<electrophysiology::PrescribedActivation>(
        scene.activation);
    kinematics = std::make_unique<diagnostics::BodyKinematics>(shape.patch);
    fields     = std::make_unique<BodyFields>(shape.patch);
    probes     = std::make_unique<BodyProbes>(scene.body_sampling, shape.patch);
    for (const splines::Side side : elasticity::all_sides)
      sides.emplace_back(elasticity::name(side),
                         LineProfile(shape.patch, side));
    rest.assign(solver->displacement().size(), 0.);
  }

  BodyState
  StaticsModel::state() const
  {
    return {solver->displacement(),
            rest,
            [this](const double theta1, const double theta2) {
              return solver->fields(theta1, theta2);
            }};
  }

  StepStatus
  StaticsModel::advance(const double t, const double dt)
  {
    elasticity::StaticsSolver::Activation activation;
    if (muscle)
      activation = [this](const double time, std::vector<double> &gamma) {
        muscle->evaluate(solver->body().activation_points(), time, gamma);
      };
    const double level = (t + dt) / end_time;
    return solver->advance(level > 1. - 1e-9 ? 1. : level, activation);
  }

  void
  StaticsModel::serialize(Archive &archive)
  {
    solver->serialize(archive);
  }

  void
  StaticsModel::forget()
  {
    solver->forget();
  }

  void
  StaticsModel::evaluate(Record &record)
  {
    const auto &u        = solver->displacement();
    const auto  measures = solver->measures();
    kinematics->evaluate(u, record);
    record.add("volume [m^3]", measures.volume);
    record.add("volume change [-]", measures.volume_change);
    record.add("smallest J [-]", measures.smallest_J);
    record.add("largest J [-]", measures.largest_J);
    elasticity::EnergyAccounts::Parts parts = solver->energy_parts();
    parts.muscle                            = muscle != nullptr;
    solver->energy().evaluate(measures, parts, record);
  }

  void
  StaticsModel::write_probes(const double time, RunOutput &output) const
  {
    probes->write_probes(time, state(), output);
  }

  void
  StaticsModel::write_profiles(const double time, RunOutput &output) const
  {
    const auto &u = solver->displacement();
    for (const auto &[name, profile] : sides)
      {
        profile.write("radial_displacement_" + name, time, u, 2, 0, output);
        profile.write("axial_displacement_" + name, time, u, 2, 1, output);
      }
    probes->write_lines(time, state(), output);
  }

  void
  StaticsModel::write_fields(const double time, RunOutput &output)
  {
    output.add_fields("body", time, fields->evaluate(state()));
  }

  void
  StaticsModel::add_results(Record &record) const
  {
    record.add("body unknowns [-]", solver->body().n_unknowns());
    record.add("load level [-]", solver->level());
  }
} // namespace ephyra::simulation
