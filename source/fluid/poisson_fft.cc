#include "ephyra/fluid/poisson_fft.h"

#include "ephyra/base/exceptions.h"

namespace ephyra::fluid
{
  namespace
  {
    RowEnds
    ends_of(const StaggeredGrid &grid, const PoissonSides &sides)
    {
      if (grid.periodic_y)
        return RowEnds::periodic;
      if (sides.lower_dirichlet)
        return sides.upper_dirichlet ? RowEnds::dirichlet_dirichlet
                                     : RowEnds::dirichlet_neumann;
      return sides.upper_dirichlet ? RowEnds::neumann_dirichlet
                                   : RowEnds::neumann_neumann;
    }
  } // namespace

  RowTridiagonal::Rows
  radial_poisson_rows(const StaggeredGrid &grid, const bool outer_dirichlet)
  {
    RowTridiagonal::Rows rows;
    rows.first = grid.first_row;
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      {
        const bool   outermost = i == grid.r.n_cells - 1;
        const double lower     = grid.r.face[i] / grid.r.centre_gap[i];
        const double upper     = outermost && !outer_dirichlet
                                   ? 0.
                                   : grid.r.face[i + 1] / grid.r.centre_gap[i + 1];
        rows.lower.push_back(lower);
        rows.upper.push_back(upper);
        rows.diagonal.push_back(-(lower + upper));
        rows.weight.push_back(grid.r.centre[i] * grid.r.width[i]);
      }
    return rows;
  }

  PoissonFft::PoissonFft(const StaggeredGrid &grid, const PoissonSides &sides)
    : grid(grid)
    , transforms(grid.y.n_cells, ends_of(grid, sides))
    , tridiagonal(radial_poisson_rows(grid, sides.outer_dirichlet),
                  transforms.eigenvalues(grid.y.length() / grid.y.n_cells),
                  grid.y.n_cells,
                  sides.singular(),
                  grid.communicator())
    , modes{AlignedVector(grid.y.n_cells), AlignedVector(grid.y.n_cells)}
  {
    EphyraThrowIf(!grid.y.uniform,
                  InputError,
                  "The Poisson solver \"fft\" needs a uniform axial spacing: "
                  "choose \"automatic\" or \"eigen\", or one axial spacing.");
  }

  void
  PoissonFft::solve(DistributedArray    &phi,
                    const RightHandSide &right_hand_side,
                    const RowFunction   &visit)
  {
    const int  n_steps = tridiagonal.n_steps();
    const auto fill    = [&](const int s) {
      const int     i   = tridiagonal.row(s);
      double *const row = phi.row(i);
      right_hand_side(
        i, grid.r.centre[i] * grid.r.width[i] / transforms.scale(), row);
      return row;
    };
    for (int s = 0; s < n_steps; s += 2)
      {
        const bool    pair  = s + 1 < n_steps;
        double *const first = fill(s), *const second =
                                         pair ? fill(s + 1) : nullptr;
        transforms.forward(first, second);
        tridiagonal.eliminate(s, first);
        if (pair)
          tridiagonal.eliminate(s + 1, second);
      }
    tridiagonal.solve_interfaces();
    // Modes are needed once more by the next row, so they have rows of their
    // own.
    for (int s = n_steps - 1; s >= 0; s -= 2)
      {
        const int     i   = tridiagonal.row(s);
        double *const row = phi.row(i);
        tridiagonal.substitute(s, row, modes[0].data());
        if (s == 0)
          {
            transforms.backward(modes[0].data(), nullptr, row, nullptr);
            visit(i, row);
            return;
          }
        const int     next     = tridiagonal.row(s - 1);
        double *const next_row = phi.row(next);
        tridiagonal.substitute(s - 1, next_row, modes[1].data());
        transforms.backward(modes[0].data(), modes[1].data(), row, next_row);
        visit(i, row);
        visit(next, next_row);
      }
  }
} // namespace ephyra::fluid
