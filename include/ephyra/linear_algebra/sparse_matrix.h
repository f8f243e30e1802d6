#pragma once

#include <mpi.h>

#include <memory>
#include <vector>

namespace ephyra::linear_algebra
{
  /// Which unknowns couple: for each row the sorted column indices. The same on
  /// all ranks of the communicator (patches have a few thousand unknowns).
  struct SparsityPattern
  {
    std::vector<std::vector<int>> columns;

    explicit SparsityPattern(int n_rows = 0)
      : columns(n_rows)
    {
    }
    int
    n_rows() const
    {
      return static_cast<int>(columns.size());
    }
    /// Couples all the given unknowns with each other (an element).
    void
    add_element(const std::vector<int> &unknowns);
    /// Sorts the rows and drops doubles; call once after the last add.
    void
    compress();
    /// Largest |row - column|.
    int
    half_bandwidth() const;
    /// Whether the entry exists; rows sorted.
    bool
    contains(int row, int column) const;
  };

  /// A square sparse matrix that the ranks of a communicator assemble
  /// together. It lives in one of two forms chosen when it is made: a
  /// Tpetra::CrsMatrix distributed by rows, or LAPACK band storage (full
  /// storage where the band nearly fills the matrix), of which every rank has
  /// all. Any rank may add to any entry of the pattern; finish_assembly() sums
  /// what the ranks have added.
  class SparseMatrix
  {
  public:
    enum class Storage
    {
      tpetra,
      band ///< the same on every rank
    };

    /// The pattern must be compressed and equal on all ranks.
    SparseMatrix(const SparsityPattern &pattern,
                 Storage                storage,
                 MPI_Comm               comm);
    ~SparseMatrix();
    SparseMatrix(const SparseMatrix &) = delete;
    SparseMatrix &
    operator=(const SparseMatrix &) = delete;

    int
    n_rows() const;
    Storage
    storage() const;
    MPI_Comm
    communicator() const;

    /// Zeroes all entries and opens the matrix for additions.
    void
    begin_assembly();
    /// Adds a dense element matrix (row-major, n x n) at the given unknowns.
    /// Negative unknowns are skipped (constrained).
    void
    add(const int *unknowns, int n, const double *values);
    void
    add(int row, int column, double value);
    /// Sums contributions over the ranks; collective.
    void
    finish_assembly();

    /// y = A x with replicated vectors (all entries on every rank); collective.
    void
    multiply(const std::vector<double> &x, std::vector<double> &y) const;

    /// Largest magnitude of each row, replicated; NaN where a row holds a
    /// value that is not finite; collective.
    std::vector<double>
    row_norms() const;

    struct Implementation;
    Implementation &
    implementation() const
    {
      return *impl;
    }

  private:
    Storage                         form;
    std::unique_ptr<Implementation> impl;
  };
} // namespace ephyra::linear_algebra
