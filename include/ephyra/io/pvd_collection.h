#pragma once

#include "ephyra/base/output.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace ephyra::io
{
  /// A time series of VTK files: `FOLDER/NAME.pvd`, which ParaView opens, and
  /// the files it lists, `FOLDER/NAME/NAME_000012.*`. The .pvd file is complete
  /// after each output. All functions are collective and throw InputError.
  class PvdCollection
  {
  public:
    /// Starts an empty series; nothing is written before the first output.
    PvdCollection(const std::string &folder,
                  const std::string &name,
                  MPI_Comm           comm);

    /// Takes over the series that is in the folder, as a run resumed at @p time
    /// needs it: outputs later than @p time are dropped. Without a .pvd file
    /// the series stays empty; a damaged one is read as far as it goes.
    void
    resume(double time);

    /// Writes the flow, a body or points at @p time in s. An output at the time of
    /// the last one replaces it.
    void
    write(double time, const GridOutput &output);
    void
    write(double time, const BezierOutput &output);
    void
    write(double time, const PointOutput &output);

    struct Entry
    {
      double      time; ///< s
      std::string file; ///< relative to the folder
    };
    /// What the series holds, by increasing time; on the first rank only.
    const std::vector<Entry> &
    entries() const
    {
      return list;
    }

  private:
    /// Stem, relative to the folder, of the files of the next output.
    std::string
    next_stem(double time);
    void
    add(double time, const std::string &file);

    const std::string  folder, name;
    const MPI_Comm     comm;
    std::vector<Entry> list;
  };
} // namespace ephyra::io
