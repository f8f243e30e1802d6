#pragma once

#include "ephyra/base/record.h"
#include "ephyra/coupling/scheme.h"
#include "ephyra/simulation/run_output.h"
#include "ephyra/simulation/scene.h"

#include <mpi.h>

#include <limits>
#include <memory>
#include <string>

namespace ephyra::simulation
{
  /// The solvers that a scene has, and what they have to say. Each kind of
  /// scene is a class of its own (tissue_model.h, body_model.h, flow_model.h,
  /// swimmer_model.h): what a scene leaves out is not even built.
  class Model : public coupling::Scheme
  {
  public:
    /// Largest CFL number of the last step; negative without a flow.
    virtual double
    cfl() const
    {
      return -1.;
    }
    /// Coupling iterations of the last step; negative without coupling.
    virtual double
    iterations() const
    {
      return -1.;
    }
    /// Longest next step from @p time that the model allows, s, for adaptive
    /// steps of at most @p longest; collective.
    virtual double
    largest_step(double /*time*/, double /*longest*/) const
    {
      return std::numeric_limits<double>::infinity();
    }
    /// After every accepted step and at the start, for what is recorded of
    /// the time between rows; its state is kept in checkpoints alone.
    virtual void
    observe(double, RunOutput &)
    {
    }
    virtual void
    serialize_observations(Archive &)
    {
    }
    /// Rows of probes/, as often as statistics.
    virtual void
    write_probes(double, RunOutput &) const
    {
    }
    /// Rows of profiles/.
    virtual void
    write_profiles(double time, RunOutput &output) const = 0;
    /// Field files.
    virtual void
    write_fields(double time, RunOutput &output) = 0;
    /// Numbers for result.csv beside those of the statistics.
    virtual void
    add_results(Record &) const
    {
    }
    /// Not empty where the run has come to its natural end.
    virtual std::string
    end_reason() const
    {
      return "";
    }
    /// Drops what only speeds up the next solve, so that a run goes on from a
    /// checkpoint exactly as its restart does.
    virtual void
    forget()
    {
    }
  };

  std::unique_ptr<Model>
  make_model(const Scene &scene, MPI_Comm comm);
} // namespace ephyra::simulation
