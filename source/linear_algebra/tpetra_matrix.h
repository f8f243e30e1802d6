#pragma once

#include "implementation.h"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_MultiVector.hpp>

namespace ephyra::linear_algebra
{
  /// A Tpetra::CrsMatrix of contiguous shares of rows.
  ///
  /// Additions go to a compressed-row copy of the whole pattern on every rank,
  /// where an element's entries are found by walking the sorted row (Tpetra's
  /// own insertion looks up every entry). finish_assembly() sums the shares
  /// and writes them into the Tpetra matrix, whose graph never changes.
  struct TpetraMatrix final : SparseMatrix::Implementation
  {
    using Matrix = Tpetra::CrsMatrix<double>;
    using Vector = Tpetra::MultiVector<double>;

    TpetraMatrix(const SparsityPattern &pattern, MPI_Comm comm);

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

    int
    n_owned_rows() const
    {
      return rows_of_rank[rank];
    }
    int
    first_owned_row() const
    {
      return first_of_rank[rank];
    }
    /// The same structure on every rank alone (MPI_COMM_SELF), and the way to
    /// give it the values of all ranks; collective.
    std::unique_ptr<TpetraMatrix>
    serial_structure() const;
    void
    copy_values_to(TpetraMatrix &serial) const;

    /// Copies the owned part of a replicated vector into a Tpetra vector.
    void
    to_tpetra(const std::vector<double> &replicated, Vector &vector) const;
    /// Gathers a Tpetra vector to all ranks.
    void
    to_replicated(const Vector &vector, std::vector<double> &replicated) const;

    Teuchos::RCP<Matrix> matrix;

  private:
    /// Gathers the owned rows of a vector in place.
    void
    gather(std::vector<double> &replicated) const;

    int                 rank;
    std::vector<int>    rows_of_rank;
    std::vector<int>    first_of_rank;
    std::vector<int>    entries_of_rank;
    std::vector<int>    row_start; ///< of all rows
    std::vector<int>    columns;   ///< of all rows
    std::vector<double> values;    ///< of all rows; owned ones are summed
    std::vector<int>    position;  ///< in values, of the Tpetra entries
  };
} // namespace ephyra::linear_algebra
