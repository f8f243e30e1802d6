#include "ephyra/base/log.h"
#include "ephyra/base/mpi_session.h"
#include "ephyra/simulation/command_line.h"
#include "ephyra/simulation/run.h"

#include <iostream>

int
main(int argc, char *argv[])
{
  using namespace ephyra;
  const MpiSession               session(argc, argv);
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return run_program(
    [&arguments] {
      const auto command_line = simulation::CommandLine::parse(arguments);
      log().initialize(MPI_COMM_WORLD,
                       command_line.quiet ||
                         command_line.action ==
                           simulation::CommandLine::Action::benchmark);
      return simulation::run_command_line(command_line, MPI_COMM_WORLD);
    },
    MPI_COMM_WORLD,
    std::cerr);
}
