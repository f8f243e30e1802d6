#pragma once

#include "ephyra/base/exceptions.h"
#include "ephyra/simulation/command_line.h"

#include <mpi.h>

namespace ephyra::simulation
{
  /// The whole program behind main(): what the command line asks for.
  ExitCode
  run_command_line(const CommandLine &command_line, MPI_Comm comm);
} // namespace ephyra::simulation
