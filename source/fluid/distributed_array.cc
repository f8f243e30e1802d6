#include "ephyra/fluid/distributed_array.h"

#include <algorithm>
#include <cstring>

namespace ephyra::fluid
{
  namespace
  {
    constexpr std::size_t doubles_per_line = 8;

    /// Distance of two rows: whole cache lines, and not a multiple of the page
    /// size, which would map neighbouring rows onto the same cache sets.
    std::size_t
    padded_stride(const std::size_t n)
    {
      std::size_t stride =
        (n + doubles_per_line - 1) / doubles_per_line * doubles_per_line;
      if (stride % 512 == 0)
        stride += doubles_per_line;
      return stride;
    }

    /// Ranks that hold the rows below and above.
    struct Neighbours
    {
      explicit Neighbours(const StaggeredGrid &grid)
        : below(grid.is_first_rank() ? MPI_PROC_NULL
                                     : mpi::rank(grid.communicator()) - 1)
        , above(grid.is_last_rank() ? MPI_PROC_NULL
                                    : mpi::rank(grid.communicator()) + 1)
      {
      }
      const int below, above;
    };
  } // namespace

  DistributedArray::DistributedArray(const StaggeredGrid &grid)
    : the_grid(&grid)
    , first_stored(grid.first_row - halo)
    , stride(padded_stride(doubles_per_line + grid.y.n_cells + halo))
    , offset(doubles_per_line)
    , data(stride * (grid.n_rows + 2 * halo), 0.)
  {
    static_assert(halo <= static_cast<int>(doubles_per_line));
  }

  void
  DistributedArray::fill(const double value)
  {
    std::fill(data.begin(), data.end(), value);
  }

  void
  DistributedArray::copy_from(const DistributedArray &other)
  {
    std::copy(other.data.begin(), other.data.end(), data.begin());
  }

  void
  DistributedArray::exchange_halo()
  {
    exchange_halos({this});
  }

  void
  DistributedArray::exchange_halos(
    const std::vector<DistributedArray *> &arrays)
  {
    const StaggeredGrid &grid = arrays.front()->grid();
    const Neighbours     ranks(grid);
    if (ranks.below == MPI_PROC_NULL && ranks.above == MPI_PROC_NULL)
      return;

    const std::size_t    block = halo * arrays.front()->stride;
    const std::size_t    n     = arrays.size() * block;
    static AlignedVector buffer; // kept: this runs several times a step
    buffer.resize(std::max(buffer.size(), 4 * n));
    double *const to_below   = buffer.data();
    double *const to_above   = to_below + n;
    double *const from_below = to_above + n;
    double *const from_above = from_below + n;

    const auto stored = [](DistributedArray &array, const int row) {
      return array.row(row) - array.offset;
    };
    const std::size_t bytes = block * sizeof(double);
    for (std::size_t a = 0; a < arrays.size(); ++a)
      {
        DistributedArray &array = *arrays[a];
        std::memcpy(to_below + a * block, stored(array, grid.first_row), bytes);
        std::memcpy(
          to_above + a * block, stored(array, grid.end_row() - halo), bytes);
      }

    MPI_Request    requests[4];
    const MPI_Comm comm = grid.communicator();
    const int      size = static_cast<int>(n);
    MPI_Irecv(from_below, size, MPI_DOUBLE, ranks.below, 0, comm, &requests[0]);
    MPI_Irecv(from_above, size, MPI_DOUBLE, ranks.above, 1, comm, &requests[1]);
    MPI_Isend(to_above, size, MPI_DOUBLE, ranks.above, 0, comm, &requests[2]);
    MPI_Isend(to_below, size, MPI_DOUBLE, ranks.below, 1, comm, &requests[3]);
    MPI_Waitall(4, requests, MPI_STATUSES_IGNORE);

    for (std::size_t a = 0; a < arrays.size(); ++a)
      {
        DistributedArray &array = *arrays[a];
        if (ranks.below != MPI_PROC_NULL)
          std::memcpy(stored(array, grid.first_row - halo),
                      from_below + a * block,
                      bytes);
        if (ranks.above != MPI_PROC_NULL)
          std::memcpy(
            stored(array, grid.end_row()), from_above + a * block, bytes);
      }
  }

  void
  DistributedArray::add_halo_to_owner()
  {
    const StaggeredGrid &grid = *the_grid;
    const Neighbours     ranks(grid);
    const int            size = static_cast<int>(halo * stride);
    AlignedVector        from_below(size, 0.), from_above(size, 0.);

    double *const  below = row(grid.first_row - halo) - offset;
    double *const  above = row(grid.end_row()) - offset;
    MPI_Request    requests[4];
    const MPI_Comm comm = grid.communicator();
    MPI_Irecv(
      from_below.data(), size, MPI_DOUBLE, ranks.below, 2, comm, &requests[0]);
    MPI_Irecv(
      from_above.data(), size, MPI_DOUBLE, ranks.above, 3, comm, &requests[1]);
    MPI_Isend(above, size, MPI_DOUBLE, ranks.above, 2, comm, &requests[2]);
    MPI_Isend(below, size, MPI_DOUBLE, ranks.below, 3, comm, &requests[3]);
    MPI_Waitall(4, requests, MPI_STATUSES_IGNORE);

    double *const lower = row(grid.first_row) - offset;
    double *const upper = row(grid.end_row() - halo) - offset;
    for (int k = 0; k < size; ++k)
      lower[k] += from_below[k];
    for (int k = 0; k < size; ++k)
      upper[k] += from_above[k];
    if (ranks.below != MPI_PROC_NULL)
      std::fill(below, below + size, 0.);
    if (ranks.above != MPI_PROC_NULL)
      std::fill(above, above + size, 0.);
  }

  RowLayout
  DistributedArray::layout(const int n_columns, const bool with_last_face) const
  {
    const int face = with_last_face ? 1 : 0;
    return {the_grid->r.n_cells + face,
            the_grid->first_row,
            the_grid->n_rows + (the_grid->is_last_rank() ? face : 0),
            n_columns,
            static_cast<std::int64_t>(stride)};
  }
} // namespace ephyra::fluid
