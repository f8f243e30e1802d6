#pragma once

#include "ephyra/base/archive.h"

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace ephyra::io
{
  /// The checkpoints of a run: `FOLDER/checkpoints/checkpoint_000001200.h5`,
  /// numbered by time step, of which the newest are kept. A file appears under
  /// its name only when it is complete: it is written beside it, its last
  /// entry is the mark "complete", and then renamed. All functions are
  /// collective and throw the same InputError on all ranks.
  class Checkpoints
  {
  public:
    using Serialize = std::function<void(Archive &)>;

    /// @p scene is the text of all parameters that fix the state (not those
    /// of output or of the end of the run), one in each line: a checkpoint is
    /// only read into the scene that wrote it.
    Checkpoints(const std::string &folder,
                const std::string &scene,
                MPI_Comm           comm,
                unsigned int       n_kept = 2);

    /// Writes the state after @p step, then removes the oldest files.
    void
    write(std::int64_t step, double time, const Serialize &serialize);

    struct State
    {
      std::string  file;
      std::int64_t step = 0;
      double       time = 0; ///< s
      std::string  warning;  ///< about newer files that are damaged
    };

    /// Reads the newest usable checkpoint. One that is damaged is passed over,
    /// with a warning, if there is an older one.
    State
    read_latest(const Serialize &serialize);

    /// Reads one file.
    State
    read(const std::string &file_name, const Serialize &serialize);

  private:
    /// All checkpoint files of the folder, newest first, on every rank.
    std::vector<std::string>
    files() const;

    const std::string  folder, scene;
    const MPI_Comm     comm;
    const unsigned int n_kept;
  };
} // namespace ephyra::io
