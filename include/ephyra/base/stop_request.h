#pragma once

#include <mpi.h>

#include <string>

namespace ephyra
{
  /// Asks a run to end early and in order (checkpoint, exit code 3):
  ///   - on SIGTERM, SIGINT or SIGUSR1 to any rank; a second SIGINT or SIGTERM
  ///     ends the process at once,
  ///   - before a limit of wall time is passed,
  ///   - where a file named `stop` appears in the output folder; the file is
  ///     removed, so that the run can be resumed.
  /// One object at a time; the handlers of before come back at its end.
  class StopRequest
  {
  public:
    /// @p wall_time_limit in s since the construction, 0: none.
    StopRequest(const std::string &output_folder,
                double             wall_time_limit,
                MPI_Comm           comm);
    ~StopRequest();
    StopRequest(const StopRequest &) = delete;
    StopRequest &
    operator=(const StopRequest &) = delete;

    /// Why the run has to stop, the same on all ranks; "" where it goes on. To
    /// be called once a step: the longest time between two calls is kept in
    /// reserve for the wall time limit. Collective.
    std::string
    reason();

  private:
    const std::string stop_file;
    const double      limit;
    const MPI_Comm    comm;
    const double      start;
    double            last_call;
    double            longest_step = 0;
    double            next_look = 0; ///< at the folder, at most once a second
  };
} // namespace ephyra
