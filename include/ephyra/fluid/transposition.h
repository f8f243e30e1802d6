#pragma once

#include "ephyra/base/mpi.h"
#include "ephyra/fluid/aligned_vector.h"

namespace ephyra::fluid
{
  /// Moves a field of n_rows x n_columns values between ranks that hold whole
  /// rows, [own row][all columns], and ranks that hold whole columns, [own
  /// column][all rows]; both shared out by mpi::share(). One message for each
  /// pair of ranks.
  class Transposition
  {
  public:
    Transposition(int n_rows, int n_columns, MPI_Comm comm);

    const mpi::Share rows, columns; ///< of this rank

    /// @p stride: distance of two rows in @p by_rows. Collective.
    void
    to_columns(const double *by_rows, int stride, double *by_columns);
    void
    to_rows(const double *by_columns, double *by_rows, int stride);

  private:
    /// Calls f(index in by_rows, index in the message) for all own rows.
    template <typename Function>
    void
    for_each_row_value(int stride, const Function &function) const;
    /// Calls f(offset in by_columns, offset in the message, count).
    template <typename Function>
    void
    for_each_column_piece(const Function &function) const;

    const MPI_Comm   comm;
    const int        n_ranks, n_rows, n_columns;
    std::vector<int> row_count, row_offset, column_count, column_offset;
    AlignedVector    row_message, column_message;
  };
} // namespace ephyra::fluid
