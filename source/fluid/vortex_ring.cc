#include "ephyra/fluid/vortex_ring.h"

#include "ephyra/fluid/flow_output.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace ephyra::fluid
{
  namespace
  {
    struct Peak
    {
      double value = 0;
      int    i = -1, j = -1;
    };

    /// Flood fill over the rows of this rank and one row of each neighbour.
    class Flood
    {
    public:
      explicit Flood(const StaggeredGrid &grid)
        : grid(grid)
        , n_y(grid.y.n_cells)
        , mark(static_cast<std::size_t>(grid.n_rows + 2) * n_y, 0)
      {
      }

      bool
      holds(const int i, const int j) const
      {
        return mark[slot(i, j)] != 0;
      }

      /// Marks the cells connected to (i, j) through sides in which @p inside
      /// holds.
      template <typename Inside>
      void
      fill(const int i, const int j, const Inside &inside)
      {
        if (!grid.owns_row(i) || holds(i, j) || !inside(i, j))
          return;
        mark[slot(i, j)] = 1;
        std::vector<std::pair<int, int>> open{{i, j}};
        while (!open.empty())
          {
            const auto [a, b] = open.back();
            open.pop_back();
            const int below = b > 0 ? b - 1 : (grid.periodic_y ? n_y - 1 : b);
            const int above = b + 1 < n_y ? b + 1 : (grid.periodic_y ? 0 : b);
            for (const auto &[c, d] : {std::pair<int, int>{a - 1, b},
                                       {a + 1, b},
                                       {a, below},
                                       {a, above}})
              if (grid.owns_row(c) && !holds(c, d) && inside(c, d))
                {
                  mark[slot(c, d)] = 1;
                  open.emplace_back(c, d);
                }
          }
      }

      /// Fetches the marks of the rows beside those of this rank, and fills
      /// from them; returns whether any rank found more.
      template <typename Inside>
      bool
      cross_ranks(const Inside &inside)
      {
        exchange();
        const std::size_t before = n_marked();
        for (const int side : {-1, 1})
          {
            const int own    = side < 0 ? grid.first_row : grid.end_row() - 1;
            const int beyond = own + side;
            for (int j = 0; j < n_y; ++j)
              if (holds(beyond, j))
                fill(own, j, inside);
          }
        const double more = n_marked() > before ? 1. : 0.;
        return mpi::max(more, grid.communicator()) > 0;
      }

    private:
      std::size_t
      slot(const int i, const int j) const
      {
        return static_cast<std::size_t>(i - grid.first_row + 1) * n_y + j;
      }

      std::size_t
      n_marked() const
      {
        std::size_t n = 0;
        for (std::size_t k = slot(grid.first_row, 0);
             k < slot(grid.end_row(), 0);
             ++k)
          n += mark[k];
        return n;
      }

      void
      exchange()
      {
        const MPI_Comm comm  = grid.communicator();
        const int      rank  = mpi::rank(comm);
        const int      lower = grid.is_first_rank() ? MPI_PROC_NULL : rank - 1;
        const int      upper = grid.is_last_rank() ? MPI_PROC_NULL : rank + 1;
        const auto     row = [this](const int i) { return &mark[slot(i, 0)]; };
        MPI_Sendrecv(row(grid.first_row),
                     n_y,
                     MPI_CHAR,
                     lower,
                     0,
                     row(grid.end_row()),
                     n_y,
                     MPI_CHAR,
                     upper,
                     0,
                     comm,
                     MPI_STATUS_IGNORE);
        MPI_Sendrecv(row(grid.end_row() - 1),
                     n_y,
                     MPI_CHAR,
                     upper,
                     1,
                     row(grid.first_row - 1),
                     n_y,
                     MPI_CHAR,
                     lower,
                     1,
                     comm,
                     MPI_STATUS_IGNORE);
      }

      const StaggeredGrid &grid;
      const int            n_y;
      std::vector<char>    mark; ///< rows first_row - 1 ... end_row
    };

    /// Over all ranks; of equal values that of the lowest rank.
    Peak
    strongest(const Peak &mine, const MPI_Comm comm)
    {
      struct
      {
        double value;
        int    rank;
      } best{mine.value, mpi::rank(comm)};
      MPI_Allreduce(MPI_IN_PLACE, &best, 1, MPI_DOUBLE_INT, MPI_MAXLOC, comm);
      std::array<int, 2> place{{mine.i, mine.j}};
      MPI_Bcast(place.data(), 2, MPI_INT, best.rank, comm);
      return {best.value, place[0], place[1]};
    }
  } // namespace

  VortexRing
  find_vortex_ring(const VelocityField &velocity,
                   const double         density,
                   const Region        &region,
                   const VorticitySign  sign,
                   const double         level)
  {
    const StaggeredGrid &grid = velocity.grid();
    const GridLine      &r = grid.r, &y = grid.y;
    const double         factor = sign == VorticitySign::negative ? -1. : 1.;

    Peak mine;
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      for (int j = 0; j < y.n_cells; ++j)
        if (region.contains(r.centre[i], y.centre[j]))
          {
            const double omega = factor * cell_vorticity(velocity, i, j);
            if (omega > mine.value)
              mine = {omega, i, j};
          }
    const Peak peak = strongest(mine, grid.communicator());
    VortexRing ring;
    if (peak.i < 0)
      return ring;

    const auto inside = [&](const int i, const int j) {
      return region.contains(r.centre[i], y.centre[j]) &&
             factor * cell_vorticity(velocity, i, j) >= level * peak.value;
    };
    Flood flood(grid);
    flood.fill(peak.i, peak.j, inside);
    while (flood.cross_ranks(inside))
      ;

    enum
    {
      gamma,    // int omega
      moment_r, // int omega r, ...
      moment_y,
      moment_rr,
      excess,      // int (omega - c), c = level * peak
      carried,     // int (omega - c) v_y
      stretched,   // int v_r/r
      stretched_y, // int y v_r/r
      cells,
      n_sums
    };
    const double        c = factor * level * peak.value;
    std::vector<double> sums(n_sums, 0.);
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      for (int j = 0; j < y.n_cells; ++j)
        if (flood.holds(i, j))
          {
            const double area  = r.width[i] * y.width[j];
            const double omega = cell_vorticity(velocity, i, j);
            const double v_r = 0.5 * (velocity.r(i, j) + velocity.r(i + 1, j));
            const double v_y = 0.5 * (velocity.y(i, j) + velocity.y(i, j + 1));
            sums[gamma] += omega * area;
            sums[moment_r] += omega * area * r.centre[i];
            sums[moment_y] += omega * area * y.centre[j];
            sums[moment_rr] += omega * area * r.centre[i] * r.centre[i];
            sums[excess] += (omega - c) * area;
            sums[carried] += (omega - c) * v_y * area;
            sums[stretched] += v_r / r.centre[i] * area;
            sums[stretched_y] += v_r / r.centre[i] * y.centre[j] * area;
            sums[cells] += 1;
          }
    mpi::sum_in_place(sums, grid.communicator());
    ring.peak        = factor * peak.value;
    ring.circulation = sums[gamma];
    ring.impulse     = M_PI * density * sums[moment_rr];
    ring.r           = sums[moment_r] / sums[gamma];
    ring.y           = sums[moment_y] / sums[gamma];
    ring.speed =
      (sums[carried] + c * (sums[stretched_y] - ring.y * sums[stretched])) /
      sums[excess];
    ring.n_cells = std::llround(sums[cells]);
    return ring;
  }
} // namespace ephyra::fluid
