#include "ephyra/linear_algebra/direct_solver.h"

#include "amesos_solver.h"
#include "lapack_solver.h"

namespace ephyra::linear_algebra
{
  std::unique_ptr<DirectSolver>
  make_direct_solver(const SparseMatrix::Storage storage,
                     const std::string          &what)
  {
    return storage == SparseMatrix::Storage::band ? make_lapack_solver(what)
                                                  : make_amesos_solver(what);
  }

  SparseMatrix::Storage
  preferred_storage(const SparsityPattern &pattern)
  {
    const int  n      = pattern.n_rows();
    const bool narrow = 6 * pattern.half_bandwidth() < n || n < 1000;
    return narrow ? SparseMatrix::Storage::band : SparseMatrix::Storage::tpetra;
  }
} // namespace ephyra::linear_algebra
