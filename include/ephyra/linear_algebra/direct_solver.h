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

  /// Band storage for a narrow band or a small matrix, Tpetra otherwise. A
  /// bell of 720 unknowns and half-bandwidth 61 takes 1.1 ms to factor with
  /// LAPACK and 12.8 ms with KLU2, so that every rank for itself is faster
  /// than all together; with all 174 wet unknowns coupled to each other the
  /// full LU takes 10 ms and KLU2 25 ms.
  SparseMatrix::Storage
  preferred_storage(const SparsityPattern &pattern);
} // namespace ephyra::linear_algebra
