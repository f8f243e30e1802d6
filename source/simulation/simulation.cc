#include "ephyra/simulation/simulation.h"

#include "ephyra/base/log.h"
#include "ephyra/base/mpi.h"
#include "ephyra/base/output_folder.h"
#include "ephyra/base/progress.h"
#include "ephyra/base/stop_request.h"
#include "ephyra/base/timer_tree.h"
#include "ephyra/io/collective.h"
#include "ephyra/version.h"

#include <algorithm>
#include <sstream>

namespace ephyra::simulation
{
  namespace
  {
    /// Sections of what is only looked at.
    bool
    is_output(const std::string &section)
    {
      // A Tissue line keeps times of arrival, which belong to the state.
      for (const char *name : {"Output",
                               "Body probe ",
                               "Body line ",
                               "Flow probe ",
                               "Flow line ",
                               "Tissue probe "})
        if (section.rfind(name, 0) == 0)
          return true;
      return false;
    }

    /// The parameters that fix the state, one in each line and without
    /// comments: everything but output and the end of the run.
    std::string
    fingerprint(const ParameterHandler &prm)
    {
      std::ostringstream all;
      prm.write_resolved(all);
      std::istringstream in(all.str());
      std::string        result, line, section;
      while (std::getline(in, line))
        {
          line.erase(std::min(line.find("  #"), line.size()));
          if (line.rfind("subsection ", 0) == 0)
            section = line.substr(11);
          if (section != "Time" && !is_output(section))
            result += line + "\n";
        }
      return result;
    }
  } // namespace

  Simulation::Simulation(const CommandLine &command_line, const MPI_Comm comm)
    : command_line(command_line)
    , comm(comm)
    , start(MPI_Wtime())
    , start_cpu(mpi::cpu_time(comm))
  {
    Scene::declare(prm);
    const bool        resumes = !command_line.resume_folder.empty();
    const std::string file    = resumes && command_line.files.empty()
                                  ? command_line.resume_folder + "/parameters.prm"
                                  : command_line.files.front();
    EphyraThrowIf(resumes &&
                    !OutputFolder::holds_run(command_line.resume_folder),
                  InputError,
                  "The folder " << command_line.resume_folder
                                << " holds no run that could be resumed; name "
                                   "the folder of a run, or start one without "
                                   "--resume.");
    prm.read_file(file);
    for (const std::string &assignment : command_line.overrides)
      prm.set_override(assignment);
    scene.parse(prm);
    prm.throw_errors();

    OutputFolder request;
    request.name           = command_line.output_folder;
    request.parameter_file = file;
    request.overwrite      = command_line.overwrite;
    if (!resumes)
      request.check(comm);

    write_header();
    time = std::make_unique<TimeControl>(scene.time);
    {
      const TimerTree::Scope scope(timer(), "setup");
      model = make_model(scene, comm);
    }

    // The folder is touched only when nothing is left to be refused.
    folder = resumes ? command_line.resume_folder : request.create(comm);
    output = std::make_unique<RunOutput>(scene.output, folder, comm);
    checkpoints =
      std::make_unique<io::Checkpoints>(folder, fingerprint(prm), comm);
    if (resumes)
      resume();
    log().attach_file(folder + "/log.txt", resumes);
    log().line("Output: " + folder);
    write_parameters();
  }

  void
  Simulation::write_parameters() const
  {
    io::on_first_rank(comm, [this]() {
      std::ostringstream text;
      prm.write_resolved(text);
      io::replace_file(folder + "/parameters.prm", text.str());
    });
  }

  Simulation::~Simulation() = default;

  void
  Simulation::write_header() const
  {
    log().line(std::string("Ephyra ") + version::release + " (" +
               version::commit + ", " + version::build_type + ", " +
               version::compiler + "; " + version::libraries + ")");
    log().line("Ranks: " + std::to_string(mpi::size(comm)));
    log().line("Scene: " + scene.description());
    for (const std::string &warning : scene.warnings)
      log().warning(warning);
  }

  void
  Simulation::serialize(Archive &archive)
  {
    {
      const Archive::Group group(archive, "time");
      time->serialize(archive);
    }
    const Archive::Group group(archive, "model");
    model->serialize(archive);
  }

  void
  Simulation::resume()
  {
    const auto state = checkpoints->read_latest([this](Archive &archive) {
      serialize(archive);
      const Archive::Group group(archive, "results");
      output->serialize(archive);
      model->serialize_observations(archive);
    });
    if (!state.warning.empty())
      log().warning(state.warning);
    output->resume(time->time(), statistics());
    last_checkpoint = resumed_from = time->n_steps();
    std::ostringstream line;
    line << "Resumed from " << state.file << ": step " << state.step
         << ", time " << state.time << " s";
    log().line(line.str());
  }

  void
  Simulation::write_checkpoint()
  {
    const TimerTree::Scope scope(timer(), "checkpoint");
    model->forget();
    checkpoints->write(time->n_steps(), time->time(), [this](Archive &archive) {
      serialize(archive);
      const Archive::Group group(archive, "results");
      output->serialize(archive);
      model->serialize_observations(archive);
    });
    last_checkpoint = time->n_steps();
  }

  Record
  Simulation::statistics()
  {
    Record record;
    record.add("step [-]", static_cast<double>(time->n_steps()));
    if (scene.time.adaptive)
      record.add("time step [s]", time->time() - time->previous_time());
    model->evaluate(record);
    return record;
  }

  void
  Simulation::write_output()
  {
    const TimerTree::Scope scope(timer(), "output");
    const auto            &when = scene.output;
    model->observe(time->time(), *output);
    if (when.statistics.due(*time))
      {
        const Record record = statistics();
        output->collect(time->time(), record);
        output->add_row("statistics", time->time(), record);
        model->write_probes(time->time(), *output);
        Record iterations;
        model->evaluate_iterations(iterations);
        if (!iterations.all().empty())
          output->add_row("iterations", time->time(), iterations);
      }
    if (when.profiles.due(*time))
      model->write_profiles(time->time(), *output);
    if (when.fields.due(*time))
      model->write_fields(time->time(), *output);
  }

  void
  Simulation::step()
  {
    if (scene.time.adaptive)
      time->limit_step_size(
        model->largest_step(time->time(), scene.time.time_step),
        "the flow or a body is too fast for the cells of the grid; lower the "
        "Smallest time step or coarsen the grid.");
    if (scene.cut_backs)
      {
        const TimerTree::Scope scope(timer(), "save state");
        saved.begin_writing();
        model->serialize(saved);
      }
    for (;;)
      {
        const StepStatus status =
          model->advance(time->time(), time->step_size());
        if (status.success)
          break;
        EphyraThrowIf(
          !scene.cut_backs,
          DivergedError,
          "Step " << time->n_steps() + 1 << " at time " << time->time()
                  << " s failed (Time/Cut-backs is off): " << status.reason);
        saved.begin_reading();
        model->serialize(saved);
        model->forget();
        time->cut_step(status.reason); // throws below the smallest step
      }
    time->accept_step();
  }

  ExitCode
  Simulation::run()
  {
    Progress    progress(scene.progress_interval);
    StopRequest stop(folder, scene.wall_time_limit, comm);

    if (time->n_steps() == 0)
      write_output();
    while (!time->finished())
      {
        try
          {
            step();
          }
        catch (const DivergedError &)
          {
            if (scene.cut_backs)
              {
                saved.begin_reading();
                model->serialize(saved);
              }
            finish_diverged(scene.cut_backs);
            throw;
          }
        try
          {
            write_output();
          }
        catch (const DivergedError &)
          {
            // The step is complete, only its loads cannot be told.
            finish_diverged(true);
            throw;
          }
        progress.step(*time, model->cfl(), model->iterations());
        if (scene.output.checkpoints.due(*time))
          write_checkpoint();
        const std::string natural_end = model->end_reason();
        if (!natural_end.empty())
          return finish_well(natural_end);
        const std::string reason = stop.reason();
        if (!reason.empty() && !time->finished())
          {
            if (last_checkpoint != time->n_steps())
              write_checkpoint();
            return finish(ExitCode::interrupted,
                          "Stopped early (" + reason +
                            "); continue with --resume " + folder);
          }
      }
    return finish_well("Done");
  }

  void
  Simulation::finish_diverged(const bool state_is_good)
  {
    if (state_is_good && last_checkpoint != time->n_steps())
      write_checkpoint();
    finish(ExitCode::diverged,
           "Diverged after step " + std::to_string(time->n_steps()));
  }

  ExitCode
  Simulation::finish_well(const std::string &how)
  {
    // So that the run can be extended.
    if (scene.output.checkpoints.on() && last_checkpoint != time->n_steps())
      write_checkpoint();
    // result.csv ends with the end of the run, due or not. The checkpoint does
    // not have this: a run that is extended has its rows at regular intervals.
    if (scene.output.statistics.on() && !scene.output.statistics.due(*time))
      output->collect(time->time(), statistics());
    return finish(ExitCode::success, how);
  }

  ExitCode
  Simulation::finish(const ExitCode code, const std::string &how)
  {
    const double wall = MPI_Wtime() - start;
    Record       record;
    record.add("exit code [-]", static_cast<double>(code));
    record.add("time [s]", time->time());
    record.add("steps [-]", static_cast<double>(time->n_steps()));
    record.add("repeated steps [-]", static_cast<double>(time->n_cuts()));
    record.add("wall time [s]", wall);
    record.add("cpu time [s]", mpi::cpu_time(comm) - start_cpu);
    model->add_results(record);
    output->write_result(record);

    timer().write_csv(folder + "/timing.csv", comm);
    std::ostringstream table;
    timer().print(table, comm);
    log().line(table.str());
    std::ostringstream line;
    line << how << ": " << time->n_steps() << " steps to " << time->time()
         << " s in " << format_duration(wall) << ", " << time->n_cuts()
         << " steps repeated, " << log().n_warnings()
         << " warnings. Results in " << folder;
    log().line(line.str());
    return code;
  }
} // namespace ephyra::simulation
