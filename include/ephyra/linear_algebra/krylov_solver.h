#pragma once

#include "ephyra/base/parameter_handler.h"
#include "ephyra/base/step_status.h"
#include "ephyra/linear_algebra/sparse_matrix.h"

#include <string>
#include <vector>

namespace ephyra::linear_algebra
{
  /// Iterative solution of a system with a matrix in Tpetra storage (Belos):
  /// restarted GMRES, or conjugate gradients for symmetric positive definite
  /// matrices; plain or with the diagonal as preconditioner (from the right).
  class KrylovSolver
  {
  public:
    struct Parameters
    {
      std::string method         = "gmres";  ///< gmres or cg
      std::string preconditioner = "jacobi"; ///< none or jacobi
      double      tolerance      = 1e-10;    ///< |b - A x| / |b|
      int         max_iterations = 1000;
      int         restart        = 50; ///< GMRES: size of the basis

      static void
      declare(ParameterHandler &prm);
      void
      parse(const ParameterHandler &prm);
    };

    /// @p what the system is, for messages.
    KrylovSolver(const Parameters &parameters, const std::string &what);

    /// Solves A x = b with replicated vectors, starting from the given x;
    /// collective. The residual in the status is computed from the solution
    /// itself; success means that it meets the tolerance. Throws InputError
    /// for a matrix in band storage.
    StepStatus
    solve(const SparseMatrix        &matrix,
          const std::vector<double> &right_hand_side,
          std::vector<double>       &solution) const;

  private:
    const Parameters  parameters;
    const std::string what;
  };
} // namespace ephyra::linear_algebra
