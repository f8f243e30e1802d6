#include "ephyra/simulation/run.h"

#include "ephyra/base/mpi.h"
#include "ephyra/base/parameter_handler.h"
#include "ephyra/simulation/benchmark.h"
#include "ephyra/simulation/scene.h"
#include "ephyra/simulation/simulation.h"

#include <iostream>

namespace ephyra::simulation
{
  namespace
  {
    void
    validate(const CommandLine &command_line, const MPI_Comm comm)
    {
      std::string errors;
      for (const std::string &file : command_line.files)
        try
          {
            ParameterHandler prm;
            Scene::declare(prm);
            prm.read_file(file);
            for (const std::string &assignment : command_line.overrides)
              prm.set_override(assignment);
            Scene scene;
            scene.parse(prm);
            prm.throw_errors();
            if (mpi::rank(comm) != 0)
              continue;
            std::cout << file << ": valid (" << scene.description() << ")\n";
            for (const std::string &warning : scene.warnings)
              std::cout << file << ": Warning: " << warning << "\n";
          }
        catch (const InputError &error)
          {
            errors += std::string(errors.empty() ? "" : "\n") + error.what();
          }
      EphyraThrowIf(!errors.empty(), InputError, errors);
    }
  } // namespace

  ExitCode
  run_command_line(const CommandLine &command_line, const MPI_Comm comm)
  {
    using Action     = CommandLine::Action;
    const bool first = mpi::rank(comm) == 0;
    switch (command_line.action)
      {
      case Action::help:
        if (first)
          std::cout << CommandLine::help();
        return ExitCode::success;
      case Action::parameters:
        if (first)
          {
            ParameterHandler prm;
            Scene::declare(prm);
            prm.write_declarations(std::cout,
                                   command_line.markdown
                                     ? ParameterHandler::Format::markdown
                                     : ParameterHandler::Format::text);
          }
        return ExitCode::success;
      case Action::validate:
        validate(command_line, comm);
        return ExitCode::success;
      case Action::benchmark:
        run_benchmark(std::cout, comm);
        return ExitCode::success;
      case Action::run:
        break;
      }
    return Simulation(command_line, comm).run();
  }
} // namespace ephyra::simulation
