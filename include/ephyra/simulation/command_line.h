#pragma once

#include <string>
#include <vector>

namespace ephyra::simulation
{
  /// What the user asked for on the command line of ephyra-binary.
  struct CommandLine
  {
    enum class Action
    {
      run,
      validate,
      parameters,
      benchmark,
      help
    };

    Action                   action = Action::run;
    std::vector<std::string> files;     ///< one to run, any number to validate
    std::vector<std::string> overrides; ///< "Section/Entry = value"
    std::string              output_folder; ///< "": numbered below output/
    std::string              resume_folder; ///< "": a new run
    bool                     overwrite = false;
    bool                     quiet     = false;
    bool                     markdown  = false; ///< form of --parameters

    /// Throws InputError that lists everything wrong with the arguments.
    static CommandLine
    parse(const std::vector<std::string> &arguments);

    /// Text of --help.
    static std::string
    help();
  };
} // namespace ephyra::simulation
