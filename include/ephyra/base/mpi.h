#pragma once

#include <mpi.h>

#include <string>
#include <vector>

namespace ephyra::mpi
{
  int
  rank(MPI_Comm comm);

  int
  size(MPI_Comm comm);

  /// Sum, minimum, maximum of one value over the ranks; collective.
  double
  sum(double value, MPI_Comm comm);
  double
  min(double value, MPI_Comm comm);
  double
  max(double value, MPI_Comm comm);
  long long
  sum(long long value, MPI_Comm comm);

  /// Processor time of all ranks so far, user and system, s; collective.
  double
  cpu_time(MPI_Comm comm);

  /// Whether the condition holds on at least one rank; collective. Decisions
  /// that change the control flow (cut a step, stop) go through this.
  bool
  any(bool condition, MPI_Comm comm);

  /// Element-wise sum over the ranks, in place; collective.
  void
  sum_in_place(std::vector<double> &values, MPI_Comm comm);
  void
  sum_in_place(double *values, std::size_t n_values, MPI_Comm comm);

  /// Copies the values of the root to all ranks; collective.
  void
  broadcast(double *values, std::size_t n_values, MPI_Comm comm, int root = 0);
  void
  broadcast(std::string &text, MPI_Comm comm, int root = 0);

  /// Contiguous share of @p n_items of one rank: [first, first + count).
  struct Share
  {
    int first;
    int count;
  };
  Share
  share(int n_items, int rank, int n_ranks);
} // namespace ephyra::mpi
