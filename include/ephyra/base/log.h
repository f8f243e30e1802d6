#pragma once

#include <mpi.h>

#include <fstream>
#include <ostream>
#include <string>

namespace ephyra
{
  /// The log of a run: the first rank writes to standard output and, once a
  /// file is attached, to log.txt; the other ranks write nothing.
  class Log
  {
  public:
    /// Rank and file; call once after MPI_Init.
    void
    initialize(MPI_Comm comm, bool quiet = false);
    /// The file begins with the lines so far.
    void
    attach_file(const std::string &file_name, bool append = false);

    /// One line, flushed.
    void
    line(const std::string &text);
    /// "Warning: ..." on a line; counted, and totalled at the end of the run.
    void
    warning(const std::string &text);
    unsigned int
    n_warnings() const;

  private:
    std::ofstream file;
    std::string   waiting; ///< lines from before there was a file
    bool          writes    = true;
    bool          to_screen = true;
    unsigned int  warnings  = 0;
  };

  /// The log of this process.
  Log &
  log();
} // namespace ephyra
