// What a flow says about itself: CFL number, state, fields for output.
#include "ephyra/base/exceptions.h"
#include "ephyra/fluid/flow_output.h"
#include "ephyra/fluid/flow_solver.h"
#include "ephyra/fluid/speed_peak.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ephyra::fluid
{
  namespace
  {
    /// Cost of a step with implicit viscosity over that of an explicit one, see
    /// the table of speeds in the manual.
    constexpr double implicit_cost = 2.3;
  } // namespace

  double
  FlowSolver::max_cfl(const double dt) const
  {
    return dt *
           mpi::max(local_speed_peak(current).rate, the_grid.communicator());
  }

  double
  FlowSolver::unstable_cfl() const
  {
    if (!parameters.convection)
      return std::numeric_limits<double>::infinity();
    return parameters.scheme == TimeScheme::rk3 ? 2.8 : 1.;
  }

  double
  FlowSolver::default_cfl_number() const
  {
    if (parameters.scheme == TimeScheme::ab2)
      return 0.3;
    return parameters.project_every_substep ? 1.2 : 0.9;
  }

  double
  FlowSolver::largest_time_step(const double cfl_number) const
  {
    const double cfl = cfl_number > 0 ? cfl_number : default_cfl_number();
    // Speeds in cells grow by the body force: (rate + f/(rho dy) h) h = cfl.
    const double rate   = max_cfl(1.);
    const double growth = std::abs(body_force(time)) / parameters.density /
                          the_grid.y.smallest_width();
    const double by_speed =
      2 * cfl / (rate + std::sqrt(rate * rate + 4 * growth * cfl));
    const double by_viscosity = viscous_time_step_limit();
    if (parameters.viscous == ViscousTreatment::implicit ||
        (parameters.viscous == ViscousTreatment::automatic &&
         by_speed > implicit_cost * by_viscosity))
      return by_speed;
    return std::min(by_speed, by_viscosity);
  }

  bool
  FlowSolver::finite() const
  {
    return std::isfinite(max_cfl(1.));
  }

  // --- state and output ---------------------------------------------------

  void
  FlowSolver::serialize(Archive &archive)
  {
    const Archive::Group group(archive, "flow");
    const bool           takes_back = archive.repeats_step() && can_take_back();
    if (takes_back)
      {
        if (archive.reading())
          take_back();
        predictions = 0;
      }
    else
      serialize_fields(archive);
    // A window stays where it is when a step is taken back.
    if (budget)
      budget->serialize(archive, !takes_back);
    archive.value("time", time);
    archive.value("time step", time_step);
    std::int64_t is_started = started ? 1 : 0,
                 directions = implicit.r + 2 * implicit.y;
    archive.value("started", is_started);
    archive.value("implicit directions", directions);
    if (!archive.reading())
      return;
    started    = is_started != 0;
    implicit.r = (directions & 1) != 0;
    implicit.y = (directions & 2) != 0;
    boundary.set_time(time);
    update_ghosts();
    new_pressure.exchange_halo();
    boundary.fill_pressure_ghosts(new_pressure);
  }

  void
  FlowSolver::serialize_fields(Archive &archive)
  {
    const int  n_y  = the_grid.y.n_cells;
    const auto save = [&](const std::string &name, VelocityField &field) {
      archive.rows(name + " r",
                   field.r.row(the_grid.first_row),
                   field.r.layout(n_y, true));
      archive.rows(
        name + " y", field.y.row(the_grid.first_row), field.y.layout(n_y + 1));
    };
    if (archive.reading())
      projected = true;
    if (parameters.window.on())
      {
        std::int64_t shift = the_grid.shift();
        archive.value("window shift", shift);
        the_grid.shift_y(static_cast<int>(shift) - the_grid.shift());
        boundary.forget_values();
      }
    DistributedArray &pressure = projected ? new_pressure : old_pressure;
    save("velocity", current);
    archive.rows(
      "pressure", pressure.row(the_grid.first_row), pressure.layout(n_y));
    if (parameters.scheme == TimeScheme::ab2)
      save("history", history);
    archive.value("previous time step", previous_time_step);
  }

  bool
  FlowSolver::can_take_back() const
  {
    return n_stages() == 1 && !keeps_predicted;
  }

  void
  FlowSolver::take_back()
  {
    EphyraAssert(predictions <= 1, "only one step can be taken back");
    if (predictions == 0)
      return;
    std::swap(current, predicted);
    std::swap(old_pressure, new_pressure);
    projected          = true;
    previous_time_step = 0; // the history is that of the step taken back
  }

  void
  FlowSolver::keep_first_stage()
  {
    if (!first_stage)
      first_stage.reset(new FirstStage{VelocityField(the_grid),
                                       VelocityField(the_grid),
                                       DistributedArray(the_grid),
                                       VelocityField(the_grid),
                                       MemoryArchive()});
    first_stage->velocity.copy_from(current);
    first_stage->history.copy_from(history);
    first_stage->pressure.copy_from(old_pressure);
    if (!budget)
      return;
    EphyraAssert(!keeps_predicted,
                 "the prediction takes the place of the start");
    first_stage->start.copy_from(predicted);
    first_stage->energy.begin_writing();
    budget->serialize(first_stage->energy, true);
  }

  void
  FlowSolver::return_to_first_stage()
  {
    EphyraAssert(first_stage, "the first stage was not kept");
    current.copy_from(first_stage->velocity);
    history.copy_from(first_stage->history);
    old_pressure.copy_from(first_stage->pressure);
    projected = false;
    boundary.set_time(stage_time(0));
    if (!budget)
      return;
    predicted.copy_from(first_stage->start);
    first_stage->energy.begin_reading();
    budget->serialize(first_stage->energy, true);
  }

  void
  FlowSolver::write(GridOutput &output) const
  {
    write_flow(current, pressure(), output);
  }
} // namespace ephyra::fluid
