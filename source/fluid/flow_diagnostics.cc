#include "ephyra/fluid/flow_diagnostics.h"

#include "ephyra/fluid/flow_output.h"

#include <algorithm>
#include <cmath>

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

    /// int f(omega, r) omega dr dy over the cells of a region.
    template <typename Weight>
    double
    integrate_vorticity(const VelocityField &velocity,
                        const Region        &region,
                        const Weight        &weight)
    {
      const StaggeredGrid &grid = velocity.grid();
      double               sum  = 0;
      for_owned_cells(grid, [&](const int i, const int j) {
        const double r = grid.r.centre[i], y = grid.y.centre[j];
        if (r < region.r_min || r > region.r_max || y < region.y_min ||
            y > region.y_max)
          return;
        const double omega = cell_vorticity(velocity, i, j);
        sum += weight(omega, r) * omega * grid.r.width[i] * grid.y.width[j];
      });
      return mpi::sum(sum, grid.communicator());
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

  double
  circulation(const VelocityField &velocity,
              const Region        &region,
              const VorticitySign  sign)
  {
    return integrate_vorticity(
      velocity, region, [&](const double omega, double) {
        const bool counts = sign == VorticitySign::all ||
                            (sign == VorticitySign::positive) == (omega > 0);
        return counts ? 1. : 0.;
      });
  }

  double
  vortex_impulse(const VelocityField &velocity,
                 const double         density,
                 const Region        &region)
  {
    return M_PI * density *
           integrate_vorticity(
             velocity, region, [](double, const double r) { return r * r; });
  }
} // namespace ephyra::fluid
