#include "ephyra/fluid/poisson_hybrid.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/fluid/poisson_fft.h"

#include <algorithm>
#include <cmath>

namespace ephyra::fluid
{
  namespace
  {
    mpi::Share
    checked_block(const StaggeredGrid &grid)
    {
      const mpi::Share block = longest_uniform_block(grid.y);
      EphyraThrowIf(grid.periodic_y || block.count == grid.y.n_cells ||
                      block.count < PoissonHybrid::shortest_block,
                    InputError,
                    "The Poisson solver \"hybrid\" needs an axial grid, not "
                    "periodic, with a uniform block of at least "
                      << PoissonHybrid::shortest_block
                      << " cells beside stretched ones, but of "
                      << grid.y.n_cells << " cells " << block.count
                      << " are uniform: choose \"automatic\".");
      return block;
    }

    RowEnds
    block_ends(const StaggeredGrid &grid,
               const PoissonSides  &sides,
               const mpi::Share    &block)
    {
      const bool below = block.first > 0 || sides.lower_dirichlet;
      const bool above =
        block.first + block.count < grid.y.n_cells || sides.upper_dirichlet;
      if (below)
        return above ? RowEnds::dirichlet_dirichlet
                     : RowEnds::dirichlet_neumann;
      return RowEnds::neumann_dirichlet; // not both are sides of the domain
    }

    double
    dot(const double *const a, const double *const b, const int n)
    {
      constexpr int width = 8;
      double        sums[width]{};
      int           m = 0;
      for (; m + width <= n; m += width)
        for (int k = 0; k < width; ++k)
          sums[k] += a[m + k] * b[m + k];
      for (; m < n; ++m)
        sums[0] += a[m] * b[m];
      double total = 0;
      for (const double sum : sums)
        total += sum;
      return total;
    }
  } // namespace

  mpi::Share
  longest_uniform_block(const GridLine &line)
  {
    const double scale =
      std::max(std::abs(line.face.front()), std::abs(line.face.back()));
    mpi::Share longest{0, 0};
    for (int first = 0, end; first < line.n_cells; first = end)
      {
        const double h = line.width[first];
        end            = first + 1;
        while (end < line.n_cells &&
               std::abs(line.width[end] - h) <= 1e-10 * h + 4e-16 * scale)
          ++end;
        if (end - first > longest.count)
          longest = {first, end - first};
      }
    return longest;
  }

  PoissonHybrid::PoissonHybrid(const StaggeredGrid &grid,
                               const PoissonSides  &sides)
    : grid(grid)
    , block(checked_block(grid))
    , spacing(
        (grid.y.face[block.first + block.count] - grid.y.face[block.first]) /
        block.count)
    , transforms(block.count, block_ends(grid, sides, block))
    , tridiagonal(radial_poisson_rows(grid, sides.outer_dirichlet),
                  transforms.eigenvalues(spacing),
                  block.count,
                  false,
                  grid.communicator())
    , ends(grid, sides, block)
    , end_rows(static_cast<std::size_t>(grid.n_rows) * ends.n_cells())
    , face_values(2 * grid.n_rows)
    , work{AlignedVector(block.count), AlignedVector(block.count)}
  {
    const auto set_up = [&](Face &face, const bool exists, const int cell) {
      if (!exists)
        return;
      face.source.assign(block.count, 0.);
      face.source[cell] = 1;
      transforms.forward(face.source.data(), nullptr);
      face.weight = transforms.value_weights(face.source);
    };
    set_up(faces[0], block.first > 0, 0);
    set_up(
      faces[1], block.first + block.count < grid.y.n_cells, block.count - 1);
  }

  void
  PoissonHybrid::solve(DistributedArray    &phi,
                       const RightHandSide &right_hand_side,
                       const RowFunction   &visit)
  {
    const int n_steps = tridiagonal.n_steps();
    for (int s = 0; s < n_steps; s += 2)
      {
        double *const first = fill_row(phi, s, right_hand_side);
        double *const second =
          s + 1 < n_steps ? fill_row(phi, s + 1, right_hand_side) : nullptr;
        transforms.forward(first, second);
        tridiagonal.eliminate(s, first);
        if (second != nullptr)
          tridiagonal.eliminate(s + 1, second);
      }
    tridiagonal.solve_interfaces();
    evaluate_beside_faces(phi);
    ends.solve(end_rows.data(), face_values.data());
    add_faces(phi);

    const auto finish = [&](const int i) {
      const double *from = end_row(i);
      double *const row  = phi.row(i);
      std::copy_n(from, block.first, row);
      std::copy(from + block.first,
                from + ends.n_cells(),
                row + block.first + block.count);
      visit(i, row);
    };
    for (int s = n_steps - 1; s >= 0; s -= 2)
      {
        const int     i   = tridiagonal.row(s);
        double *const row = phi.row(i) + block.first;
        tridiagonal.substitute(s, row, work[0].data());
        if (s == 0)
          {
            transforms.backward(work[0].data(), nullptr, row, nullptr);
            finish(i);
            return;
          }
        const int     next     = tridiagonal.row(s - 1);
        double *const next_row = phi.row(next) + block.first;
        tridiagonal.substitute(s - 1, next_row, work[1].data());
        transforms.backward(work[0].data(), work[1].data(), row, next_row);
        finish(i);
        finish(next);
      }
  }

  double *
  PoissonHybrid::end_row(const int i)
  {
    return &end_rows[static_cast<std::size_t>(i - grid.first_row) *
                     ends.n_cells()];
  }

  double *
  PoissonHybrid::fill_row(DistributedArray    &phi,
                          const int            s,
                          const RightHandSide &right_hand_side)
  {
    const int     i   = tridiagonal.row(s);
    double *const row = phi.row(i);
    right_hand_side(i, ends.root_weight(i), row);
    double *const end = end_row(i);
    for (int j = 0; j < block.first; ++j)
      end[j] = row[j] * grid.y.width[j];
    for (int c = block.first; c < ends.n_cells(); ++c)
      end[c] = row[c + block.count] * grid.y.width[c + block.count];
    const double  scale = ends.root_weight(i) / transforms.scale();
    double *const own   = row + block.first;
    for (int j = 0; j < block.count; ++j)
      own[j] *= scale;
    return own;
  }

  void
  PoissonHybrid::evaluate_beside_faces(DistributedArray &phi)
  {
    for (int s = tridiagonal.n_steps() - 1; s >= 0; --s)
      {
        const int     i = tridiagonal.row(s);
        double *const x = work[s % 2].data();
        tridiagonal.substitute(s, phi.row(i) + block.first, x);
        for (const int side : {0, 1})
          if (!faces[side].weight.empty())
            face_values[side * grid.n_rows + i - grid.first_row] =
              ends.root_weight(i) * 2. / spacing *
              dot(faces[side].weight.data(), x, block.count);
      }
  }

  void
  PoissonHybrid::add_faces(DistributedArray &phi)
  {
    const double factor = -2. / (spacing * spacing * transforms.scale());
    const auto   add    = [&](const int s, double *const source) {
      const int    i      = tridiagonal.row(s);
      const double weight = factor * grid.r.centre[i] * grid.r.width[i];
      std::fill_n(source, block.count, 0.);
      for (const int side : {0, 1})
        if (!faces[side].source.empty())
          {
            const double value =
              weight * face_values[side * grid.n_rows + i - grid.first_row];
            const double *const unit = faces[side].source.data();
            for (int m = 0; m < block.count; ++m)
              source[m] += value * unit[m];
          }
      tridiagonal.eliminate(s, source);
      double *const row = phi.row(i) + block.first;
      for (int m = 0; m < block.count; ++m)
        row[m] += source[m];
    };
    for (int s = 0; s < tridiagonal.n_steps(); ++s)
      add(s, work[s % 2].data());
    tridiagonal.solve_interfaces(true);
  }
} // namespace ephyra::fluid
