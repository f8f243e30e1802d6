#pragma once

#include "ephyra/base/exceptions.h"
#include "ephyra/base/memory_archive.h"
#include "ephyra/base/parameter_handler.h"
#include "ephyra/base/time_control.h"
#include "ephyra/io/checkpoint.h"
#include "ephyra/simulation/command_line.h"
#include "ephyra/simulation/model.h"

#include <memory>
#include <string>

namespace ephyra::simulation
{
  /// One run: output folder, restart, the loop over time steps, tables, field
  /// files, checkpoints, and an orderly end.
  class Simulation
  {
  public:
    /// Reads the parameter file that the command line names (that of the
    /// folder, to resume). Throws InputError with all that is wrong.
    Simulation(const CommandLine &command_line, MPI_Comm comm);
    ~Simulation();

    /// Throws DivergedError where the computation fails; the last good state
    /// is in a checkpoint then.
    ExitCode
    run();

  private:
    void
    write_header() const;
    /// parameters.prm of the folder.
    void
    write_parameters() const;
    void
    resume();
    void
    step();
    Record
    statistics();
    void
    write_output();
    void
    write_checkpoint();
    void
    serialize(Archive &archive);
    void
    finish_diverged(bool state_is_good);
    ExitCode
    finish_well(const std::string &how);
    ExitCode
    finish(ExitCode code, const std::string &how);

    const CommandLine                command_line;
    const MPI_Comm                   comm;
    ParameterHandler                 prm;
    Scene                            scene;
    std::string                      folder;
    double                           start;     ///< wall time, s
    double                           start_cpu; ///< of all ranks, s
    std::unique_ptr<Model>           model;
    std::unique_ptr<TimeControl>     time;
    std::unique_ptr<RunOutput>       output;
    std::unique_ptr<io::Checkpoints> checkpoints;
    MemoryArchive                    saved{true};
    std::int64_t                     last_checkpoint = -1; ///< step
    std::int64_t                     resumed_from    = 0;  ///< step
  };
} // namespace ephyra::simulation
