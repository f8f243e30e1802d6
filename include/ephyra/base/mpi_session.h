#pragma once

#include "ephyra/base/exceptions.h"

#include <mpi.h>

#include <functional>
#include <iosfwd>

namespace ephyra
{
  /// MPI from its first to its last call.
  class MpiSession
  {
  public:
    /// One thread for each rank.
    MpiSession(int &argc, char **&argv);
    ~MpiSession();
    MpiSession(const MpiSession &) = delete;
    MpiSession &
    operator=(const MpiSession &) = delete;
  };

  /// Runs the program on all ranks and returns the exit code of the process,
  /// the same on every rank. Exceptions end here: one rank, the lowest of those
  /// that failed, writes one message to @p errors. Where some ranks fail and
  /// the others do not end within @p patience seconds (they wait for data that
  /// never comes), all are ended by @p abort, MPI_Abort unless a test replaces
  /// it.
  int
  run_program(const std::function<ExitCode()> &program,
              MPI_Comm                         comm,
              std::ostream                    &errors,
              double                           patience = 3.,
              const std::function<void(int)>  &abort    = {});
} // namespace ephyra
