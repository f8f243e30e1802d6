#include "ephyra/simulation/body_model.h"

#include "ephyra/simulation/build_body.h"

namespace ephyra::simulation
{
  BodyModel::BodyModel(const Scene &scene, const MPI_Comm comm)
    : body(build_body(scene, geometry::create_body(scene.body), comm))
    , body_output(std::make_unique<BodyOutput>(*body, scene.body_sampling))
  {
  }

  StepStatus
  BodyModel::advance(const double t, const double dt)
  {
    StepStatus status = body->advance_activation(t, dt);
    if (status.success)
      status = body->advance_mechanics(t, dt);
    if (status.success)
      body->accept();
    return status;
  }

  void
  BodyModel::serialize(Archive &archive)
  {
    body->serialize(archive);
  }

  void
  BodyModel::evaluate(Record &record)
  {
    body->evaluate(record);
  }

  void
  BodyModel::write_probes(const double time, RunOutput &output) const
  {
    body_output->write_probes(time, output);
  }

  void
  BodyModel::write_profiles(const double time, RunOutput &output) const
  {
    body_output->write_profiles(time, output);
  }

  void
  BodyModel::write_fields(const double time, RunOutput &output)
  {
    body_output->write_fields(time, output);
  }

  void
  BodyModel::add_results(Record &record) const
  {
    record.add("body unknowns [-]", body->n_unknowns());
  }

  void
  BodyModel::forget()
  {
    body->mechanics().forget();
  }
} // namespace ephyra::simulation
