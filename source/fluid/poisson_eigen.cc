#include "ephyra/fluid/poisson_eigen.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/fluid/poisson_fft.h"

namespace ephyra::fluid
{
  namespace
  {
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
    , radial(grid, sides.outer_dirichlet)
    , tridiagonal(axial_rows(grid, sides, columns),
                  radial.eigenvalues,
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
        transposition = std::make_unique<Transposition>(
          n_r, grid.y.n_cells, grid.communicator());
      }
  }

  void
  PoissonEigen::solve(DistributedArray    &phi,
                      const RightHandSide &right_hand_side,
                      const RowFunction   &visit)
  {
    const int  n_y    = grid.y.n_cells;
    const bool alone  = transposition == nullptr;
    const int  stride = phi.row_stride();
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      {
        double *const row = phi.row(i);
        right_hand_side(i, radial.root_weight[i], row);
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
               radial.vectors.data(),
               n_r,
               field,
               stride,
               modes.data(),
               n_r);
    else
      {
        transposition->to_columns(field, stride, values.data());
        multiply('T',
                 'N',
                 n_r,
                 columns.count,
                 n_r,
                 radial.vectors.data(),
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
               radial.vectors.data(),
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
                 radial.vectors.data(),
                 n_r,
                 modes.data(),
                 n_r,
                 values.data(),
                 n_r);
        transposition->to_rows(values.data(), field, stride);
      }

    for (int i = grid.first_row; i < grid.end_row(); ++i)
      {
        double *const row   = phi.row(i);
        const double  scale = 1. / radial.root_weight[i];
        for (int j = 0; j < n_y; ++j)
          row[j] *= scale;
        visit(i, row);
      }
  }
} // namespace ephyra::fluid
