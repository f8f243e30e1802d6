#pragma once

#include "ephyra/linear_algebra/sparse_matrix.h"

namespace ephyra::linear_algebra
{
  /// What both forms of a matrix offer; see SparseMatrix.
  struct SparseMatrix::Implementation
  {
    Implementation(const int n_rows, const MPI_Comm comm)
      : n_rows(n_rows)
      , comm(comm)
      , id(next_id())
    {
    }
    virtual ~Implementation() = default;

    virtual void
    begin_assembly() = 0;
    virtual void
    add(const int *unknowns, int n, const double *values) = 0;
    virtual void
    add(int row, int column, double value) = 0;
    virtual void
    finish_assembly() = 0;
    virtual void
    multiply(const std::vector<double> &x, std::vector<double> &y) const = 0;
    virtual std::vector<double>
    row_norms() const = 0;

    const int      n_rows;
    const MPI_Comm comm;
    const int      id; ///< no two matrices have the same

  private:
    static int
    next_id()
    {
      static int last = 0;
      return ++last;
    }
  };

  std::unique_ptr<SparseMatrix::Implementation>
  make_band_matrix(const SparsityPattern &pattern, MPI_Comm comm);
  std::unique_ptr<SparseMatrix::Implementation>
  make_tpetra_matrix(const SparsityPattern &pattern, MPI_Comm comm);
} // namespace ephyra::linear_algebra
