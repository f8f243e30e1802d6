#include "ephyra/fluid/flow_diagnostics.h"

#include "ephyra/fluid/flow_output.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ephyra::fluid
{
  namespace
  {
    double
    divergence(const VelocityField &v, const int i, const int j)
    {
      const StaggeredGrid &grid = v.grid();
      return (grid.r.face[i + 1] * v.r(i + 1, j) - grid.r.face[i] * v.r(i, j)) /
               (grid.r.centre[i] * grid.r.width[i]) +
             (v.y(i, j + 1) - v.y(i, j)) / grid.y.width[j];
    }

    template <typename Function>
    void
    for_owned_cells(const StaggeredGrid &grid, const Function &function)
    {
      for (int i = grid.first_row; i < grid.end_row(); ++i)
        for (int j = 0; j < grid.y.n_cells; ++j)
          function(i, j);
    }

    /// Axial faces of each row: n_y, or one more with both ends.
    int
    end_face(const StaggeredGrid &grid)
    {
      return grid.y.n_cells + (grid.periodic_y ? 0 : 1);
    }

    /// Number of the face next to a place; the ends of the line beyond it.
    int
    nearest_face(const GridLine &line, const double x)
    {
      if (x <= line.face.front())
        return 0;
      const int cell = line.cell_of(x);
      if (cell >= line.n_cells)
        return line.n_cells;
      return x < line.centre[cell] ? cell : cell + 1;
    }

    /// The part of the limits that face k stands for: from the centre of the
    /// cell below it to that of the cell above.
    double
    share(const GridLine &line,
          const int       k,
          const double    smallest,
          const double    largest)
    {
      const double from = k > 0 ? line.centre[k - 1] : line.face[0];
      const double to   = k < line.n_cells ? line.centre[k] : line.face[k];
      return std::max(0., std::min(to, largest) - std::max(from, smallest));
    }
  } // namespace

  double
  max_divergence(const VelocityField &velocity)
  {
    double largest = 0;
    for_owned_cells(velocity.grid(), [&](const int i, const int j) {
      largest = std::max(largest, std::abs(divergence(velocity, i, j)));
    });
    return mpi::max(largest, velocity.grid().communicator());
  }

  double
  relative_divergence(const VelocityField &velocity)
  {
    const StaggeredGrid &grid = velocity.grid();
    double               rate = 0;
    for_owned_cells(grid, [&](const int i, const int j) {
      rate = std::max(rate,
                      std::abs(velocity.r(i, j)) / grid.r.width[i] +
                        std::abs(velocity.y(i, j)) / grid.y.width[j]);
    });
    rate = mpi::max(rate, grid.communicator());
    return rate > 0 ? max_divergence(velocity) / rate : 0.;
  }

  double
  kinetic_energy(const VelocityField &velocity, const double density)
  {
    const StaggeredGrid &grid = velocity.grid();
    const GridLine      &r = grid.r, &y = grid.y;
    const int end_row = grid.end_row() + (grid.is_last_rank() ? 1 : 0);
    double    sum     = 0;
    for (int i = grid.first_row; i < end_row; ++i)
      for (int j = 0; j < y.n_cells; ++j)
        sum += r.face[i] * r.centre_gap[i] * y.width[j] *
               std::pow(velocity.r(i, j), 2);
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      for (int j = 0; j < end_face(grid); ++j)
        sum += r.centre[i] * r.width[i] * y.centre_gap[j] *
               std::pow(velocity.y(i, j), 2);
    return M_PI * density * mpi::sum(sum, grid.communicator());
  }

  double
  axial_momentum(const VelocityField &velocity, const double density)
  {
    const StaggeredGrid &grid = velocity.grid();
    double               sum  = 0;
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      for (int j = 0; j < end_face(grid); ++j)
        sum += grid.r.centre[i] * grid.r.width[i] * grid.y.centre_gap[j] *
               velocity.y(i, j);
    return 2 * M_PI * density * mpi::sum(sum, grid.communicator());
  }

  double
  dissipation(const VelocityField &velocity, const double viscosity)
  {
    const StaggeredGrid &grid = velocity.grid();
    const GridLine      &r = grid.r, &y = grid.y;
    double               sum = 0;
    for_owned_cells(grid, [&](const int i, const int j) {
      const double e_rr =
        (velocity.r(i + 1, j) - velocity.r(i, j)) / r.width[i];
      const double e_tt =
        0.5 * (velocity.r(i + 1, j) + velocity.r(i, j)) / r.centre[i];
      const double e_yy =
        (velocity.y(i, j + 1) - velocity.y(i, j)) / y.width[j];
      double shear = 0; // mean square of 2 e_ry over the corners
      for (const int a : {0, 1})
        for (const int b : {0, 1})
          shear +=
            0.25 * std::pow(corner_shear_rate(velocity, i + a, j + b), 2);
      sum += r.centre[i] * r.width[i] * y.width[j] *
             (2 * (e_rr * e_rr + e_tt * e_tt + e_yy * e_yy) + shear);
    });
    return 2 * M_PI * viscosity * mpi::sum(sum, grid.communicator());
  }

  VorticityIntegrals
  vorticity_integrals(const VelocityField &velocity,
                      const double         density,
                      const Region        &region)
  {
    const StaggeredGrid &grid = velocity.grid();
    const GridLine      &r = grid.r, &y = grid.y;
    std::vector<double>  sums(3, 0.);
    for_owned_cells(grid, [&](const int i, const int j) {
      if (!region.contains(r.centre[i], y.centre[j]))
        return;
      const double part =
        cell_vorticity(velocity, i, j) * r.width[i] * y.width[j];
      sums[part > 0 ? 0 : 1] += part;
      sums[2] += part * r.centre[i] * r.centre[i];
    });
    mpi::sum_in_place(sums, grid.communicator());
    return {sums[0], sums[1], M_PI * density * sums[2]};
  }

  double
  circulation(const VelocityField &velocity,
              const Region        &region,
              const VorticitySign  sign)
  {
    const VorticityIntegrals all = vorticity_integrals(velocity, 1., region);
    return sign == VorticitySign::all        ? all.circulation()
           : sign == VorticitySign::positive ? all.positive
                                             : all.negative;
  }

  VorticityFlux
  vorticity_flux(const VelocityField &velocity,
                 const Region        &region,
                 const Side           side)
  {
    const StaggeredGrid &grid = velocity.grid();
    const GridLine      &r = grid.r, &y = grid.y;
    const int end_row = grid.end_row() + (grid.is_last_rank() ? 1 : 0);
    std::vector<double> sums(2, 0.);
    // At a corner omega = a - b and the shear rate = a + b, a = d v_r/dy and
    // b = d v_y/dr.
    const auto add = [&](const int i, const int j, const double v_n_ds) {
      const double omega = corner_vorticity(velocity, i, j);
      const double rate  = corner_shear_rate(velocity, i, j);
      sums[0] += v_n_ds * omega;
      sums[1] +=
        v_n_ds * 0.5 * (side == Side::outer ? rate + omega : omega - rate);
    };
    if (side == Side::outer)
      {
        const int i = nearest_face(r, region.r_max);
        if (i >= grid.first_row && i < end_row)
          for (int j = 0; j <= y.n_cells; ++j)
            add(i,
                j,
                -0.5 * (velocity.r(i, j - 1) + velocity.r(i, j)) *
                  share(y, j, region.y_min, region.y_max));
      }
    else
      {
        const bool lower = side == Side::lower;
        const int  j     = nearest_face(y, lower ? region.y_min : region.y_max);
        for (int i = std::max(1, grid.first_row); i < end_row; ++i)
          add(i,
              j,
              (lower ? 0.5 : -0.5) * (velocity.y(i - 1, j) + velocity.y(i, j)) *
                share(r, i, region.r_min, region.r_max));
      }
    mpi::sum_in_place(sums, grid.communicator());
    return {sums[0], sums[1]};
  }
} // namespace ephyra::fluid
