#pragma once

#include "ephyra/linear_algebra/direct_solver.h"

namespace ephyra::linear_algebra
{
  /// Throws DivergedError where a row of the matrix is not finite or zero;
  /// returns the row norms. Collective.
  std::vector<double>
  check_rows(const SparseMatrix &matrix, const std::string &what);

  /// One solve that tells whether the factors can be used: with a right-hand
  /// side of size one in every row of the row-scaled matrix, a solution
  /// beyond 1e13 means that some vector is mapped to zero within round-off.
  /// Its largest component is the unknown that nothing holds. Throws
  /// DivergedError; collective.
  void
  check_factors(const DirectSolver        &solver,
                const std::vector<double> &row_norms,
                const std::string         &what);
} // namespace ephyra::linear_algebra
