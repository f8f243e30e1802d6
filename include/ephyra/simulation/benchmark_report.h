#pragma once

#include <mpi.h>

#include <functional>
#include <iosfwd>
#include <string>

namespace ephyra::simulation
{
  /// Least wall time of a piece of work over some repetitions, the slowest
  /// rank's, s; collective.
  double
  least_time(int repetitions, MPI_Comm comm, const std::function<void()> &work);

  /// Table of phases; the first rank writes.
  class BenchmarkReport
  {
  public:
    /// Measures the memory bandwidth (triad, all ranks at a time) and writes
    /// it and the heading. Collective.
    BenchmarkReport(std::ostream &out, MPI_Comm comm);

    /// @p seconds for @p unknowns, as ns for each and in bytes that the triad
    /// moves in the same time.
    void
    line(const std::string &what, double seconds, double unknowns);
    void
    heading(const std::string &text);

  private:
    std::ostream &out;
    const bool    writes;
    double        bandwidth; ///< bytes/s
  };
} // namespace ephyra::simulation
