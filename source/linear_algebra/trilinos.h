#pragma once

namespace ephyra::linear_algebra
{
  /// Starts Kokkos, on which Tpetra runs, at the first call; the end is tied
  /// to MPI_Finalize, so that no user of the matrices has to care. MPI must be
  /// initialised.
  void
  ensure_trilinos();
} // namespace ephyra::linear_algebra
