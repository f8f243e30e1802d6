#pragma once

#include <mpi.h>

#include <string>

namespace ephyra
{
  /// Where a run writes to.
  struct OutputFolder
  {
    std::string name;            ///< as the user gave it; "": numbered
    std::string root = "output"; ///< numbered folders are made in here
    std::string parameter_file;  ///< of the run; never removed
    bool        overwrite = false;

    /// Makes the folder of a new run and returns its name. Without a name it is
    /// `output/SCENE-0001`, or the next free number, SCENE being the parameter
    /// file without folder and ending; runs that start at the same time get
    /// different numbers. A folder that already holds a run is emptied with
    /// `overwrite` and refused without.
    /// Throws InputError, with the remedy, where the folder holds a run or
    /// other files, or cannot be written. Collective; the first rank acts, all
    /// throw.
    std::string
    create(MPI_Comm comm) const;

    /// Throws as create() would, but leaves everything as it is. Collective.
    void
    check(MPI_Comm comm) const;

    /// Whether @p folder was made by create().
    static bool
    holds_run(const std::string &folder);
  };
} // namespace ephyra
