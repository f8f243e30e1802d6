#pragma once

#include <mpi.h>

#include <iosfwd>

namespace ephyra::simulation
{
  /// Measures the speed of each part on this machine and prints it beside the
  /// bandwidth of the memory (triad a = b + s c, 24 bytes for each element) in
  /// the same run: flow on 700 x 4600 cells with uniform and 350 x 1150 with
  /// stretched y, the nerve net with 1200 points, and the bell of 35 x 6 cubic
  /// elements. "Triad bytes" of a phase are its time times that bandwidth: a
  /// cost that does not depend on the machine. Collective.
  void
  run_benchmark(std::ostream &out, MPI_Comm comm);
} // namespace ephyra::simulation
