#pragma once

#include "ephyra/linear_algebra/sparse_matrix.h"

#include <memory>
#include <string>
#include <vector>

namespace ephyra::linear_algebra
{
  /// A direct solver for a SparseMatrix. The symbolic factorisation is done
  /// once for a pattern; factorize() repeats the numeric one. Vectors are
  /// replicated: every rank gives and gets all entries.
  class DirectSolver
  {
  public:
    virtual ~DirectSolver() = default;
    /// Throws DivergedError on a singular or non-finite matrix, naming @p what
    /// the matrix is and the unknown at fault where known.
    virtual void
    factorize(const SparseMatrix &matrix) = 0;
    virtual void
    solve(const std::vector<double> &right_hand_side,
          std::vector<double>       &solution) const = 0;
    virtual std::string
    name() const = 0;
  };

  /// Amesos2 (KLU2) for Tpetra storage, LAPACK's band LU for band storage
  /// (full LU where the band fills the matrix). KLU2 is serial: with several
  /// ranks each factorises a gathered copy, and solve() is not collective.
  std::unique_ptr<DirectSolver>
  make_direct_solver(SparseMatrix::Storage storage, const std::string &what);

  /// Band storage on one rank for a narrow band or a small matrix, Tpetra
  /// otherwise.
  SparseMatrix::Storage
  preferred_storage(const SparsityPattern &pattern, MPI_Comm comm);
} // namespace ephyra::linear_algebra
