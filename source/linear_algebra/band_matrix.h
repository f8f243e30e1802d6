#pragma once

#include "implementation.h"

namespace ephyra::linear_algebra
{
  /// Band storage by rows: entry (i, j) with |i - j| <= b lies at
  /// offset + i * stride + j. This is LAPACK's column-wise band storage of the
  /// transposed matrix. Where the band would take more room than the full
  /// matrix, all entries are stored (stride n, offset 0). Every rank has all.
  struct BandMatrix final : SparseMatrix::Implementation
  {
    BandMatrix(const SparsityPattern &pattern, MPI_Comm comm);

    void
    begin_assembly() override;
    void
    add(const int *unknowns, int n, const double *values) override;
    void
    add(int row, int column, double value) override;
    void
    finish_assembly() override;
    void
    multiply(const std::vector<double> &x,
             std::vector<double>       &y) const override;
    std::vector<double>
    row_norms() const override;

    /// Columns [first, last) stored in a row, and the first of their values.
    int
    first_column(int row) const;
    int
    last_column(int row) const;
    const double *
    row_values(int row) const
    {
      return &values[offset + static_cast<std::size_t>(row) * stride +
                     first_column(row)];
    }

    const int           half_bandwidth;
    const bool          full;
    const std::size_t   offset;
    const std::size_t   stride;
    std::vector<double> values;
  };
} // namespace ephyra::linear_algebra
