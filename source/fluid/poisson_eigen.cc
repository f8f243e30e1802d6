#include "ephyra/fluid/poisson_eigen.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/fluid/poisson_fft.h"

#include <algorithm>
#include <cmath>

extern "C"
{
  void
  dgemm_(const char *,
         const char *,
         const int *,
         const int *,
         const int *,
         const double *,
         const double *,
         const int *,
         const double *,
         const int *,
         const double *,
         double *,
         const int *);
  void
  dstevd_(const char *,
          const int *,
          double *,
          double *,
          double *,
          const int *,
          double *,
          const int *,
          int *,
          const int *,
          int *);
}

namespace ephyra::fluid
{
  namespace
  {
    /// C = op(A) op(B), column-major.
    void
    multiply(const char    transpose_a,
             const char    transpose_b,
             const int     m,
             const int     n,
             const int     k,
             const double *a,
             const int     stride_a,
             const double *b,
             const int     stride_b,
             double       *c,
             const int     stride_c)
    {
      const double one = 1, zero = 0;
      dgemm_(&transpose_a,
             &transpose_b,
             &m,
             &n,
             &k,
             &one,
             a,
             &stride_a,
             b,
             &stride_b,
             &zero,
             c,
             &stride_c);
    }

    mpi::Share
    own_columns(const StaggeredGrid &grid)
    {
      const MPI_Comm comm = grid.communicator();
      EphyraThrowIf(grid.y.n_cells < mpi::size(comm),
                    InputError,
                    "The Poisson solver \"eigen\" needs a column in y for each "
                    "rank, but there are "
                      << grid.y.n_cells << " for " << mpi::size(comm)
                      << " ranks: use fewer ranks.");
      return mpi::share(grid.y.n_cells, mpi::rank(comm), mpi::size(comm));
    }

    RowTridiagonal::Rows
    axial_rows(const StaggeredGrid &grid,
               const PoissonSides  &sides,
               const mpi::Share    &columns)
    {
      RowTridiagonal::Rows rows;
      rows.first = columns.first;
      for (int j = columns.first; j < columns.first + columns.count; ++j)
        {
          const bool lowest = j == 0, highest = j == grid.y.n_cells - 1;
          rows.lower.push_back(
            lowest && !sides.lower_dirichlet ? 0. : 1. / grid.y.centre_gap[j]);
          rows.upper.push_back(highest && !sides.upper_dirichlet
                                 ? 0.
                                 : 1. / grid.y.centre_gap[j + 1]);
          rows.diagonal.push_back(-(rows.lower.back() + rows.upper.back()));
          rows.weight.push_back(grid.y.width[j]);
        }
      return rows;
    }
  } // namespace

  PoissonEigen::PoissonEigen(const StaggeredGrid &grid,
                             const PoissonSides  &sides)
    : grid(grid)
    , n_r(grid.r.n_cells)
    , columns(own_columns(grid))
    , root_weight(n_r)
    , vectors(static_cast<std::size_t>(n_r) * n_r)
    , eigenvalues(decompose(sides.outer_dirichlet))
    , tridiagonal(axial_rows(grid, sides, columns),
                  eigenvalues,
                  n_r,
                  sides.singular(),
                  grid.communicator())
    , modes(static_cast<std::size_t>(columns.count) * n_r)
  {
    EphyraThrowIf(
      grid.periodic_y,
      InputError,
      "The Poisson solver \"eigen\" cannot be periodic in y: choose "
      "\"fft\" and one axial spacing.");
    if (mpi::size(grid.communicator()) > 1)
      {
        values.resize(modes.size());
        buffer.resize(std::max<std::size_t>(
          modes.size(),
          static_cast<std::size_t>(grid.n_rows) * grid.y.n_cells));
        send_buffer.resize(buffer.size());
      }
  }

  std::vector<double>
  PoissonEigen::decompose(const bool outer_dirichlet)
  {
    std::vector<double> diagonal(n_r), off_diagonal(n_r);
    for (int i = 0; i < n_r; ++i)
      root_weight[i] = std::sqrt(grid.r.centre[i] * grid.r.width[i]);
    for (int i = 0; i < n_r; ++i)
      {
        const double lower = grid.r.face[i] / grid.r.centre_gap[i];
        const bool   open  = i < n_r - 1 || outer_dirichlet;
        const double upper =
          open ? grid.r.face[i + 1] / grid.r.centre_gap[i + 1] : 0.;
        diagonal[i] = (lower + upper) / (root_weight[i] * root_weight[i]);
        if (i < n_r - 1)
          off_diagonal[i] = -upper / (root_weight[i] * root_weight[i + 1]);
      }
    const char          with_vectors = 'V';
    const int           work_size    = 1 + 4 * n_r + n_r * n_r;
    const int           integer_size = 3 + 5 * n_r;
    std::vector<double> work(work_size);
    std::vector<int>    integers(integer_size);
    int                 info = 0;
    dstevd_(&with_vectors,
            &n_r,
            diagonal.data(),
            off_diagonal.data(),
            vectors.data(),
            &n_r,
            work.data(),
            &work_size,
            integers.data(),
            &integer_size,
            &info);
    EphyraThrowIf(info != 0,
                  DivergedError,
                  "The eigenvectors of the radial grid could not be computed "
                  "(LAPACK dstevd returned "
                    << info << "): check the radial breakpoints and spacings.");
    if (!outer_dirichlet)
      diagonal[0] = 0; // the constant, known to round-off only
    return diagonal;
  }

  void
  PoissonEigen::transpose(DistributedArray &phi, const bool to_columns)
  {
    const MPI_Comm   comm    = grid.communicator();
    const int        n_ranks = mpi::size(comm);
    std::vector<int> row_count(n_ranks), row_offset(n_ranks);
    std::vector<int> column_count(n_ranks), column_offset(n_ranks);
    int              by_rows = 0, by_columns = 0;
    for (int q = 0; q < n_ranks; ++q)
      {
        const mpi::Share other = mpi::share(grid.y.n_cells, q, n_ranks);
        row_count[q]           = grid.n_rows * other.count;
        row_offset[q]          = by_rows;
        by_rows += row_count[q];
        column_count[q]  = columns.count * mpi::share(n_r, q, n_ranks).count;
        column_offset[q] = by_columns;
        by_columns += column_count[q];
      }

    // Blocks for rank q: [column of q][own row].
    const auto for_each_block = [&](const auto &copy) {
      for (int q = 0; q < n_ranks; ++q)
        {
          const mpi::Share other = mpi::share(grid.y.n_cells, q, n_ranks);
          constexpr int    tile  = 8;
          for (int j0 = 0; j0 < other.count; j0 += tile)
            for (int i = 0; i < grid.n_rows; ++i)
              for (int j = j0; j < std::min(j0 + tile, other.count); ++j)
                copy(
                  phi(grid.first_row + i, other.first + j),
                  send_buffer[row_offset[q] +
                              static_cast<std::size_t>(j) * grid.n_rows + i]);
        }
    };
    // Blocks from rank q: [own column][row of q].
    const auto for_each_segment = [&](const auto &copy) {
      for (int q = 0; q < n_ranks; ++q)
        {
          const mpi::Share other = mpi::share(n_r, q, n_ranks);
          for (int j = 0; j < columns.count; ++j)
            copy(&values[static_cast<std::size_t>(j) * n_r + other.first],
                 &buffer[column_offset[q] +
                         static_cast<std::size_t>(j) * other.count],
                 other.count);
        }
    };

    if (to_columns)
      {
        for_each_block(
          [](const double &field, double &block) { block = field; });
        MPI_Alltoallv(send_buffer.data(),
                      row_count.data(),
                      row_offset.data(),
                      MPI_DOUBLE,
                      buffer.data(),
                      column_count.data(),
                      column_offset.data(),
                      MPI_DOUBLE,
                      comm);
        for_each_segment([](double *column, const double *block, const int n) {
          std::copy(block, block + n, column);
        });
      }
    else
      {
        for_each_segment([](const double *column, double *block, const int n) {
          std::copy(column, column + n, block);
        });
        MPI_Alltoallv(buffer.data(),
                      column_count.data(),
                      column_offset.data(),
                      MPI_DOUBLE,
                      send_buffer.data(),
                      row_count.data(),
                      row_offset.data(),
                      MPI_DOUBLE,
                      comm);
        for_each_block(
          [](double &field, const double &block) { field = block; });
      }
  }

  void
  PoissonEigen::solve(DistributedArray    &phi,
                      const RightHandSide &right_hand_side,
                      const RowFunction   &visit)
  {
    const int  n_y    = grid.y.n_cells;
    const bool alone  = mpi::size(grid.communicator()) == 1;
    const int  stride = phi.row_stride();
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      {
        double *const row = phi.row(i);
        right_hand_side(i, root_weight[i], row);
        for (int j = 0; j < n_y; ++j)
          row[j] *= grid.y.width[j];
      }

    double *const field = phi.row(grid.first_row);
    if (alone)
      multiply('T',
               'T',
               n_r,
               n_y,
               n_r,
               vectors.data(),
               n_r,
               field,
               stride,
               modes.data(),
               n_r);
    else
      {
        transpose(phi, true);
        multiply('T',
                 'N',
                 n_r,
                 columns.count,
                 n_r,
                 vectors.data(),
                 n_r,
                 values.data(),
                 n_r,
                 modes.data(),
                 n_r);
      }
    tridiagonal.solve([&](const int j) {
      return &modes[static_cast<std::size_t>(j - columns.first) * n_r];
    });
    if (alone)
      multiply('T',
               'T',
               n_y,
               n_r,
               n_r,
               modes.data(),
               n_r,
               vectors.data(),
               n_r,
               field,
               stride);
    else
      {
        multiply('N',
                 'N',
                 n_r,
                 columns.count,
                 n_r,
                 vectors.data(),
                 n_r,
                 modes.data(),
                 n_r,
                 values.data(),
                 n_r);
        transpose(phi, false);
      }

    for (int i = grid.first_row; i < grid.end_row(); ++i)
      {
        double *const row   = phi.row(i);
        const double  scale = 1. / root_weight[i];
        for (int j = 0; j < n_y; ++j)
          row[j] *= scale;
        visit(i, row);
      }
  }
} // namespace ephyra::fluid
