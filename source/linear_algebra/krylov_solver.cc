#include "ephyra/linear_algebra/krylov_solver.h"

#include "ephyra/base/exceptions.h"
#include "tpetra_matrix.h"

#include <BelosLinearProblem.hpp>
#include <BelosPseudoBlockCGSolMgr.hpp>
#include <BelosPseudoBlockGmresSolMgr.hpp>
#include <BelosTpetraAdapter.hpp>
#include <Tpetra_Vector.hpp>

#include <cmath>
#include <sstream>

namespace ephyra::linear_algebra
{
  namespace
  {
    using Vector   = TpetraMatrix::Vector;
    using Operator = Tpetra::Operator<double>;

    /// y = alpha D^-1 x + beta y with the diagonal D of a matrix.
    class Jacobi final : public Operator
    {
    public:
      explicit Jacobi(const TpetraMatrix::Matrix &matrix)
        : inverse(matrix.getRowMap())
      {
        matrix.getLocalDiagCopy(inverse);
        const auto view = inverse.getLocalViewHost(Tpetra::Access::ReadWrite);
        for (std::size_t i = 0; i < inverse.getLocalLength(); ++i)
          view(i, 0) = view(i, 0) != 0. ? 1. / view(i, 0) : 1.;
      }
      Teuchos::RCP<const TpetraMatrix::Matrix::map_type>
      getDomainMap() const override
      {
        return inverse.getMap();
      }
      Teuchos::RCP<const TpetraMatrix::Matrix::map_type>
      getRangeMap() const override
      {
        return inverse.getMap();
      }
      void
      apply(const Vector &x,
            Vector       &y,
            const Teuchos::ETransp,
            const double alpha,
            const double beta) const override
      {
        y.elementWiseMultiply(alpha, inverse, x, beta);
      }

    private:
      Tpetra::Vector<double> inverse;
    };

    double
    norm(const std::vector<double> &x)
    {
      double sum = 0.;
      for (const double value : x)
        sum += value * value;
      return std::sqrt(sum);
    }
  } // namespace

  void
  KrylovSolver::Parameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("Method",
                      "gmres",
                      patterns::Selection("gmres|cg"),
                      "Iteration: restarted GMRES, or conjugate gradients "
                      "(symmetric positive definite matrices only).");
    prm.declare_entry("Preconditioner",
                      "jacobi",
                      patterns::Selection("none|jacobi"),
                      "Preconditioner: none, or the diagonal.");
    prm.declare_entry("Tolerance",
                      "1e-10",
                      patterns::Positive(),
                      "Residual relative to the right-hand side at which the "
                      "iteration stops.");
    prm.declare_entry("Maximum iterations",
                      "1000",
                      patterns::Integer(1),
                      "Number of iterations after which the solve has failed.");
    prm.declare_entry(
      "Restart", "50", patterns::Integer(1), "Size of the basis of GMRES.");
  }

  void
  KrylovSolver::Parameters::parse(const ParameterHandler &prm)
  {
    method         = prm.get("Method");
    preconditioner = prm.get("Preconditioner");
    tolerance      = prm.get_double("Tolerance");
    max_iterations = prm.get_integer("Maximum iterations");
    restart        = prm.get_integer("Restart");
  }

  KrylovSolver::KrylovSolver(const Parameters  &parameters,
                             const std::string &what)
    : parameters(parameters)
    , what(what)
  {
  }

  StepStatus
  KrylovSolver::solve(const SparseMatrix        &matrix,
                      const std::vector<double> &right_hand_side,
                      std::vector<double>       &solution) const
  {
    EphyraThrowIf(matrix.storage() != SparseMatrix::Storage::tpetra,
                  InputError,
                  "The iterative solver of "
                    << what << " needs a matrix in Tpetra storage.");
    EphyraThrowIf(static_cast<int>(right_hand_side.size()) != matrix.n_rows(),
                  InputError,
                  "The right-hand side of "
                    << what << " has " << right_hand_side.size()
                    << " entries, the matrix " << matrix.n_rows() << " rows.");
    const auto &tpetra =
      dynamic_cast<const TpetraMatrix &>(matrix.implementation());
    const auto rows = tpetra.matrix->getRowMap();
    const auto x    = Teuchos::rcp(new Vector(rows, 1));
    const auto b    = Teuchos::rcp(new Vector(rows, 1));
    solution.resize(matrix.n_rows(), 0.);
    tpetra.to_tpetra(solution, *x);
    tpetra.to_tpetra(right_hand_side, *b);

    StepStatus   status;
    const double scale = norm(right_hand_side);
    if (scale == 0.)
      {
        solution.assign(matrix.n_rows(), 0.);
        return status;
      }

    using Problem      = Belos::LinearProblem<double, Vector, Operator>;
    const auto problem = Teuchos::rcp(new Problem(tpetra.matrix, x, b));
    if (parameters.preconditioner == "jacobi")
      problem->setRightPrec(Teuchos::rcp(new Jacobi(*tpetra.matrix)));
    problem->setProblem();

    const auto list = Teuchos::parameterList();
    list->set("Convergence Tolerance", parameters.tolerance);
    list->set("Maximum Iterations", parameters.max_iterations);
    list->set("Verbosity", static_cast<int>(Belos::Errors));
    Teuchos::RCP<Belos::SolverManager<double, Vector, Operator>> solver;
    if (parameters.method == "cg")
      {
        list->set("Residual Scaling", "Norm of RHS");
        solver =
          Teuchos::rcp(new Belos::PseudoBlockCGSolMgr<double, Vector, Operator>(
            problem, list));
      }
    else
      {
        list->set("Num Blocks", parameters.restart);
        list->set("Maximum Restarts", parameters.max_iterations);
        list->set("Implicit Residual Scaling", "Norm of RHS");
        list->set("Explicit Residual Scaling", "Norm of RHS");
        solver = Teuchos::rcp(
          new Belos::PseudoBlockGmresSolMgr<double, Vector, Operator>(problem,
                                                                      list));
      }
    std::string breakdown;
    try
      {
        solver->solve();
        status.iterations = solver->getNumIters();
      }
    catch (const std::exception &)
      {
        breakdown = " (the iteration broke down)";
      }

    tpetra.to_replicated(*x, solution);
    std::vector<double> residual;
    matrix.multiply(solution, residual);
    for (std::size_t i = 0; i < residual.size(); ++i)
      residual[i] -= right_hand_side[i];
    status.residual = norm(residual) / scale;
    // Round-off may separate the residual of the iteration from the true one.
    status.success = status.residual <= 1.01 * parameters.tolerance;
    if (!status.success)
      {
        std::ostringstream reason;
        reason << "The iterative solver of " << what
               << " reached a residual of " << status.residual << " instead of "
               << parameters.tolerance << " in " << status.iterations
               << " iterations" << breakdown
               << "; allow more iterations or use a direct solver.";
        status.reason = reason.str();
      }
    return status;
  }
} // namespace ephyra::linear_algebra
