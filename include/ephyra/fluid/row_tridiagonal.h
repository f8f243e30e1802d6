#pragma once

#include "ephyra/fluid/aligned_vector.h"

#include <mpi.h>

#include <vector>

namespace ephyra::fluid
{
  /// Many tridiagonal systems, one for each column m of rows that are
  /// distributed over the ranks:
  ///   lower_i x_(i-1) + (diagonal_i - lambda_m weight_i) x_i
  ///                   + upper_i x_(i+1) = f_i.
  /// Vectorised over the columns. Every rank eliminates its own rows towards a
  /// neighbour (the last rank downwards, all others upwards); what remains is
  /// a pentadiagonal system of two unknowns for each interface and column,
  /// whose columns are shared out over the ranks: messages of two values a
  /// column, no array of global size. Ranks in the middle carry the coupling
  /// to the rank behind them only as far as it exceeds round-off.
  ///
  /// Rows are handed over one by one, so that work on them before and after
  /// can be fused with the solution while they are in cache:
  ///   for (s = 0; s < n; ++s) solver.eliminate(s, data of row(s));
  ///   solver.solve_interfaces();
  ///   for (s = n; s-- > 0;) solver.substitute(s, data of row(s), x);
  class RowTridiagonal
  {
  public:
    struct Rows
    {
      int                 first; ///< index of the first row held here
      std::vector<double> lower, diagonal, upper, weight; ///< of own rows
    };

    /// One lambda for each column; one in all: all columns share one matrix.
    /// @p singular: the column with lambda = 0 determines x up to a constant;
    /// it is fixed by adding `diagonal` once more in the very last row, which
    /// changes nothing for compatible data but makes x = 0 there.
    RowTridiagonal(const Rows                &rows,
                   const std::vector<double> &lambda,
                   int                        n_columns,
                   bool                       singular,
                   MPI_Comm                   comm);

    int
    n_steps() const
    {
      return n;
    }
    /// Row of elimination step s.
    int
    row(const int s) const
    {
      return upwards ? first_row + s : first_row + n - 1 - s;
    }

    void
    eliminate(int s, double *f);
    /// @p add: the rows eliminated since are right-hand sides to be added to
    /// those of the solution before. Collective.
    void
    solve_interfaces(bool add = false);
    /// @p x may be the same row as @p f; it is read again by the next call.
    void
    substitute(int s, const double *f, double *x);

    /// All of the above; row(i) must give the data of row i. Collective.
    template <typename RowAccess>
    void
    solve(const RowAccess &data)
    {
      for (int s = 0; s < n; ++s)
        eliminate(s, data(row(s)));
      solve_interfaces();
      for (int s = n - 1; s >= 0; --s)
        substitute(s, data(row(s)), data(row(s)));
    }

  private:
    /// Coefficients of one row that are not negligible: those of the first
    /// `head` columns and of the last `tail` ones.
    struct Sparse
    {
      int           head = 0, tail = 0;
      AlignedVector values;
    };
    static Sparse
    compress(const AlignedVector &full);
    /// y += factor * coefficients * x
    void
    add_product(const Sparse &coefficients,
                double        factor,
                const double *x,
                double       *y) const;

    void
    factorize(const Rows                &rows,
              const std::vector<double> &lambda,
              bool                       singular);
    void
    set_up_interfaces();

    const MPI_Comm comm;
    const int      rank, n_ranks;
    const int      n, first_row;
    const int      n_columns;
    const bool     shared; ///< all columns have the same matrix
    const int      n_coefficients;
    const bool     upwards;
    const bool     middle; ///< has a rank behind and one ahead

    std::vector<double> behind, ahead; ///< of own rows in order of elimination
    AlignedVector       inverse;       ///< pivots, n x n_coefficients
    std::vector<Sparse> fill;          ///< coupling of a row to the rank behind
    std::vector<Sparse> to_first; ///< weights of the rows in the first unknown

    // Interfaces: x_first = g_first - first_behind x_behind - ...
    AlignedVector       first_behind, first_ahead, last_behind, last_ahead;
    AlignedVector       g_first, x_behind, x_ahead;
    std::vector<double> pentadiagonal; ///< factors for own share of columns
    std::vector<int>    share_first, share_count;
    AlignedVector own_values, interface_values, returned_values; ///< messages
    const double *previous = nullptr; ///< row of the step before
    const double *last     = nullptr; ///< row of the last step
  };
} // namespace ephyra::fluid
