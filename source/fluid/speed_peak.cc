#include "ephyra/fluid/speed_peak.h"

#include <Eigen/Core>

#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace ephyra::fluid
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    void
    set_cell(const VelocityField &v, const int i, const int j, SpeedPeak &peak)
    {
      peak.i   = i;
      peak.j   = j;
      peak.r   = v.grid().r.centre[i];
      peak.y   = v.grid().y.centre[j];
      peak.v_r = 0.5 * (v.r(i, j) + v.r(i + 1, j));
      peak.v_y = 0.5 * (v.y(i, j) + v.y(i, j + 1));
    }
  } // namespace

  std::string
  SpeedPeak::description() const
  {
    std::ostringstream text;
    text << "(v_r, v_y) = (" << v_r << ", " << v_y << ") m/s at (r, y) = (" << r
         << ", " << y << ") m";
    return text.str();
  }

  SpeedPeak
  local_speed_peak(const VelocityField &velocity)
  {
    using Values                = Eigen::Map<const Eigen::ArrayXd>;
    const StaggeredGrid &grid   = velocity.grid();
    const int            n_y    = grid.y.n_cells;
    const Eigen::ArrayXd inv_dy = Values(grid.y.width.data(), n_y).inverse();
    SpeedPeak            peak;
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      {
        const double *const w = velocity.y.row(i);
        const auto          rate =
          0.5 / grid.r.width[i] *
            (Values(velocity.r.row(i), n_y).abs() +
             Values(velocity.r.row(i + 1), n_y).abs()) +
          0.5 * inv_dy * (Values(w, n_y).abs() + Values(w + 1, n_y).abs());
        const double largest = rate.maxCoeff<Eigen::PropagateNaN>();
        if (std::isfinite(largest))
          {
            if (largest <= peak.rate)
              continue;
            Eigen::Index place = 0;
            rate.maxCoeff(&place);
            peak.rate = largest;
            set_cell(velocity, i, static_cast<int>(place), peak);
            continue;
          }
        for (int j = 0; j < n_y; ++j)
          if (!std::isfinite(rate(j)))
            {
              if (peak.n_not_finite == 0)
                {
                  peak.rate = infinity;
                  set_cell(velocity, i, j, peak);
                }
              peak.n_not_finite += 1;
            }
      }
    return peak;
  }

  SpeedPeak
  global_speed_peak(const SpeedPeak &local, const MPI_Comm comm)
  {
    SpeedPeak peak    = local;
    peak.rate         = mpi::max(local.rate, comm);
    peak.n_not_finite = mpi::sum(local.n_not_finite, comm);
    // Of equal ones that of the lowest row; a row is on one rank.
    const bool candidate = local.rate == peak.rate;
    peak.i = static_cast<int>(mpi::min(candidate ? local.i : infinity, comm));
    std::vector<double> cell(5, 0.);
    if (candidate && local.i == peak.i)
      cell = {
        static_cast<double>(local.j), local.r, local.y, local.v_r, local.v_y};
    mpi::sum_in_place(cell, comm);
    peak.j   = static_cast<int>(cell[0]);
    peak.r   = cell[1];
    peak.y   = cell[2];
    peak.v_r = cell[3];
    peak.v_y = cell[4];
    return peak;
  }
} // namespace ephyra::fluid
