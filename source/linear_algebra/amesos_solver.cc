#include "amesos_solver.h"
#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"
#include "factorization_check.h"
#include "tpetra_matrix.h"

#include <Amesos2.hpp>

namespace ephyra::linear_algebra
{
  namespace
  {
    /// KLU2 is a serial method: every rank factorises a gathered copy of the
    /// matrix for itself, so that solving needs no communication.
    class AmesosSolver final : public DirectSolver
    {
    public:
      explicit AmesosSolver(std::string what)
        : what(std::move(what))
      {
      }

      void
      factorize(const SparseMatrix &sparse_matrix) override
      {
        const std::vector<double> norms = check_rows(sparse_matrix, what);
        if (matrix_id != sparse_matrix.implementation().id)
          set_up(sparse_matrix);
        if (copy)
          original->copy_values_to(*copy);
        bool failed = false;
        try
          {
            solver->numericFactorization();
          }
        catch (const std::runtime_error &)
          {
            failed = true;
          }
        EphyraThrowIf(failed,
                      DivergedError,
                      "The matrix of " << what
                                       << " is singular: KLU2 met a zero "
                                          "pivot; check supports and "
                                          "constraints.");
        check_factors(*this, norms, what);
      }

      void
      solve(const std::vector<double> &right_hand_side,
            std::vector<double>       &solution) const override
      {
        const int n = original == nullptr ? 0 : original->n_rows;
        EphyraThrowIf(static_cast<int>(right_hand_side.size()) != n,
                      InputError,
                      "The right-hand side of "
                        << what << " has " << right_hand_side.size()
                        << " entries, the factorised matrix " << n << " rows.");
        const TpetraMatrix &matrix = copy ? *copy : *original;
        matrix.to_tpetra(right_hand_side, *b);
        solver->solve(x.ptr(), b.ptr());
        matrix.to_replicated(*x, solution);
      }

      std::string
      name() const override
      {
        return "Amesos2 KLU2";
      }

    private:
      using Solver =
        Amesos2::Solver<TpetraMatrix::Matrix, TpetraMatrix::Vector>;

      void
      set_up(const SparseMatrix &sparse_matrix)
      {
        original =
          dynamic_cast<const TpetraMatrix *>(&sparse_matrix.implementation());
        EphyraThrowIf(original == nullptr,
                      InputError,
                      "The sparse solver of "
                        << what << " needs a matrix in Tpetra storage.");
        matrix_id = original->id;
        copy.reset();
        if (mpi::size(original->comm) > 1)
          copy = original->serial_structure();
        const auto &matrix = (copy ? *copy : *original).matrix;
        x      = Teuchos::rcp(new TpetraMatrix::Vector(matrix->getRowMap(), 1));
        b      = Teuchos::rcp(new TpetraMatrix::Vector(matrix->getRowMap(), 1));
        solver = Amesos2::create<TpetraMatrix::Matrix, TpetraMatrix::Vector>(
          "KLU2", matrix, x, b);
        solver->symbolicFactorization();
      }

      const std::string                  what;
      const TpetraMatrix                *original  = nullptr;
      int                                matrix_id = 0;
      std::unique_ptr<TpetraMatrix>      copy;
      Teuchos::RCP<Solver>               solver;
      Teuchos::RCP<TpetraMatrix::Vector> x, b;
    };
  } // namespace

  std::unique_ptr<DirectSolver>
  make_amesos_solver(const std::string &what)
  {
    return std::make_unique<AmesosSolver>(what);
  }
} // namespace ephyra::linear_algebra
