#include "lapack_solver.h"
#include "band_matrix.h"
#include "ephyra/base/exceptions.h"
#include "factorization_check.h"

#include <algorithm>
#include <cmath>

extern "C"
{
  void
  dgbtrf_(const int *rows,
          const int *columns,
          const int *lower,
          const int *upper,
          double    *band,
          const int *stride,
          int       *pivots,
          int       *info);
  void
  dgbtrs_(const char   *transposed,
          const int    *n,
          const int    *lower,
          const int    *upper,
          const int    *n_right_hand_sides,
          const double *band,
          const int    *stride,
          const int    *pivots,
          double       *solution,
          const int    *solution_stride,
          int          *info);
  void
  dpbtrf_(const char *triangle,
          const int  *n,
          const int  *half_bandwidth,
          double     *band,
          const int  *stride,
          int        *info);
  void
  dpbtrs_(const char   *triangle,
          const int    *n,
          const int    *half_bandwidth,
          const int    *n_right_hand_sides,
          const double *band,
          const int    *stride,
          double       *solution,
          const int    *solution_stride,
          int          *info);
  void
  dgetrf_(const int *rows,
          const int *columns,
          double    *matrix,
          const int *stride,
          int       *pivots,
          int       *info);
  void
  dgetrs_(const char   *transposed,
          const int    *n,
          const int    *n_right_hand_sides,
          const double *matrix,
          const int    *stride,
          const int    *pivots,
          double       *solution,
          const int    *solution_stride,
          int          *info);
}

namespace ephyra::linear_algebra
{
  namespace
  {
    /// Whether a band matrix is symmetric up to round-off.
    bool
    symmetric(const BandMatrix &band, const std::vector<double> &norms)
    {
      for (int row = 0; row < band.n_rows; ++row)
        {
          const double *right = band.row_values(row) + row -
                                band.first_column(row); // from the diagonal on
          const int last = band.last_column(row);
          for (int column = row + 1; column < last; ++column)
            {
              const double below =
                band.row_values(column)[row - band.first_column(column)];
              if (!(std::abs(right[column - row] - below) <=
                    1e-13 * std::min(norms[row], norms[column])))
                return false;
            }
        }
      return true;
    }

    /// Cholesky's factorisation where a band is symmetric and positive definite
    /// (a half to a third of the time of the other), else LU with partial
    /// pivoting of the transposed matrix, which row-wise storage is to LAPACK;
    /// solved transposed again.
    class LapackSolver final : public DirectSolver
    {
    public:
      explicit LapackSolver(std::string what)
        : what(std::move(what))
      {
      }

      void
      factorize(const SparseMatrix &matrix) override
      {
        EphyraThrowIf(matrix.storage() != SparseMatrix::Storage::band,
                      InputError,
                      "The band solver of " << what
                                            << " needs a matrix in band "
                                               "storage.");
        const auto &band =
          dynamic_cast<const BandMatrix &>(matrix.implementation());
        const std::vector<double> norms = check_rows(matrix, what);

        n    = band.n_rows;
        b    = band.half_bandwidth;
        full = band.full;
        pivots.resize(n);
        int info = 0;
        cholesky = !full && symmetric(band, norms) && factorize_symmetric(band);
        if (full)
          {
            factors = band.values;
            dgetrf_(&n, &n, factors.data(), &n, pivots.data(), &info);
          }
        else if (!cholesky)
          {
            // LAPACK wants b more rows above the band, for the pivoting.
            stride = 3 * b + 1;
            factors.assign(static_cast<std::size_t>(n) * stride, 0.);
            for (int row = 0; row < n; ++row)
              {
                const int first = band.first_column(row);
                std::copy_n(band.row_values(row),
                            band.last_column(row) - first,
                            &factors[static_cast<std::size_t>(row) * stride +
                                     2 * b + first - row]);
              }
            dgbtrf_(
              &n, &n, &b, &b, factors.data(), &stride, pivots.data(), &info);
          }
        EphyraThrowIf(info != 0,
                      DivergedError,
                      "The matrix of "
                        << what << " is singular: unknown " << info - 1
                        << " is not determined; check supports and "
                           "constraints.");
        check_factors(*this, norms, what);
      }

      void
      solve(const std::vector<double> &right_hand_side,
            std::vector<double>       &solution) const override
      {
        EphyraThrowIf(static_cast<int>(right_hand_side.size()) != n,
                      InputError,
                      "The right-hand side of "
                        << what << " has " << right_hand_side.size()
                        << " entries, the factorised matrix " << n << " rows.");
        solution      = right_hand_side;
        const int one = 1;
        int       info;
        if (cholesky)
          dpbtrs_("L",
                  &n,
                  &b,
                  &one,
                  factors.data(),
                  &stride,
                  solution.data(),
                  &n,
                  &info);
        else if (full)
          dgetrs_("T",
                  &n,
                  &one,
                  factors.data(),
                  &n,
                  pivots.data(),
                  solution.data(),
                  &n,
                  &info);
        else
          dgbtrs_("T",
                  &n,
                  &b,
                  &b,
                  &one,
                  factors.data(),
                  &stride,
                  pivots.data(),
                  solution.data(),
                  &n,
                  &info);
      }

      std::string
      name() const override
      {
        return "LAPACK band";
      }

    private:
      /// Whether the matrix is positive definite.
      bool
      factorize_symmetric(const BandMatrix &band)
      {
        stride = b + 1;
        factors.assign(static_cast<std::size_t>(n) * stride, 0.);
        for (int row = 0; row < n; ++row)
          std::copy_n(band.row_values(row) + row - band.first_column(row),
                      band.last_column(row) - row,
                      &factors[static_cast<std::size_t>(row) * stride]);
        int info = 0;
        dpbtrf_("L", &n, &b, factors.data(), &stride, &info);
        return info == 0;
      }

      const std::string   what;
      int                 n        = 0;
      int                 b        = 0;
      int                 stride   = 0;
      bool                full     = false;
      bool                cholesky = false;
      std::vector<double> factors;
      std::vector<int>    pivots;
    };
  } // namespace

  std::unique_ptr<DirectSolver>
  make_lapack_solver(const std::string &what)
  {
    return std::make_unique<LapackSolver>(what);
  }
} // namespace ephyra::linear_algebra
