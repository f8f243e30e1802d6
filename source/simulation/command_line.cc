#include "ephyra/simulation/command_line.h"

#include "ephyra/base/exceptions.h"

namespace ephyra::simulation
{
  CommandLine
  CommandLine::parse(const std::vector<std::string> &arguments)
  {
    CommandLine result;
    std::string errors;

    for (std::size_t i = 0; i < arguments.size(); ++i)
      {
        const std::string &argument = arguments[i];
        // The text after an option: "--option value" or "--option=value".
        const auto takes_value = [&](const std::string &option,
                                     std::string       &value) {
          if (argument.rfind(option + "=", 0) == 0)
            value = argument.substr(option.size() + 1);
          else if (argument == option && i + 1 < arguments.size())
            value = arguments[++i];
          else if (argument == option)
            errors += "\n  " + option + " needs a value";
          else
            return false;
          return true;
        };

        std::string value;
        if (argument == "--help" || argument == "-h")
          result.action = Action::help;
        else if (argument == "--validate")
          result.action = Action::validate;
        else if (argument == "--parameters")
          result.action = Action::parameters;
        else if (argument == "--parameters=markdown")
          {
            result.action   = Action::parameters;
            result.markdown = true;
          }
        else if (argument == "--bench")
          result.action = Action::benchmark;
        else if (argument == "--overwrite")
          result.overwrite = true;
        else if (argument == "--quiet")
          result.quiet = true;
        else if (takes_value("--set", value))
          result.overrides.push_back(value);
        else if (takes_value("--output", value))
          result.output_folder = value;
        else if (takes_value("--resume", value))
          result.resume_folder = value;
        else if (!argument.empty() && argument[0] == '-')
          errors += "\n  unknown option " + argument + " (see --help)";
        else
          result.files.push_back(argument);
      }

    if (result.action == Action::run && result.files.empty() &&
        result.resume_folder.empty())
      errors += "\n  no parameter file given (see --help)";
    if (result.action == Action::run && result.files.size() > 1)
      errors += "\n  one parameter file at a time can be run, " +
                std::to_string(result.files.size()) + " were given";
    if (result.action == Action::validate && result.files.empty())
      errors += "\n  --validate needs at least one parameter file";
    if (!result.resume_folder.empty() && !result.output_folder.empty())
      errors += "\n  --resume continues in its own folder: leave out --output";
    if (!result.resume_folder.empty() && result.overwrite)
      errors += "\n  --resume and --overwrite exclude each other";

    EphyraThrowIf(!errors.empty(), InputError, "Command line:" << errors);
    return result;
  }

  std::string
  CommandLine::help()
  {
    return R"(Usage: ephyra-binary FILE.prm [options]
       ephyra-binary --resume FOLDER [options]
       ephyra-binary --validate FILE.prm ... | --parameters | --bench

Runs the scene of a parameter file; works under mpirun and srun.

  --set "Section/Entry = value"  override an entry of the file; repeatable
  --output FOLDER                where results go (default: output/NAME-0001,
                                 the next free number each time)
  --overwrite                    replace a run that is in that folder
  --resume FOLDER                continue a run from its last checkpoint; --set
                                 may extend it (e.g. "Time/End time = 5 s")
  --validate FILE ...            check parameter files, run nothing
  --parameters[=markdown]        every entry with default, unit and text
  --bench                        speed of each phase beside the memory bandwidth
  --quiet                        no output on the screen, log.txt only
  --help                         this text

Exit codes: 0 done, 1 error in the input, 2 diverged, 3 stopped early and
resumable.
)";
  }
} // namespace ephyra::simulation
