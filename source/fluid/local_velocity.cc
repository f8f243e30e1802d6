#include "ephyra/fluid/local_velocity.h"

#include <algorithm>

namespace ephyra::fluid
{
  namespace
  {
    /// Values `lower` and `lower + 1` with the weights 1 - s and s.
    struct Weights
    {
      int    lower;
      double s;
    };

    int
    cell(const GridLine &line, const double x)
    {
      return std::clamp(line.cell_of(x), 0, line.n_cells - 1);
    }

    double
    fraction(const double x, const double from, const double to)
    {
      return std::clamp((x - from) / (to - from), 0., 1.);
    }

    Weights
    between_faces(const GridLine &line, const double x)
    {
      const int k = cell(line, x);
      return {k, fraction(x, line.face[k], line.face[k + 1])};
    }

    /// Beyond the ends are the mirror images of the first and last cell.
    double
    centre(const GridLine &line, const int k)
    {
      if (k < 0)
        return 2 * line.face.front() - line.centre.front();
      if (k >= line.n_cells)
        return 2 * line.face.back() - line.centre.back();
      return line.centre[k];
    }

    Weights
    between_centres(const GridLine &line, const double x)
    {
      int k = cell(line, x);
      if (x < line.centre[k])
        --k;
      return {k, fraction(x, centre(line, k), centre(line, k + 1))};
    }

    double
    bilinear(const DistributedArray &u, const Weights &r, const Weights &y)
    {
      // Row -1 mirrors row 0: the axial velocity is even at the axis.
      const double *const a = u.row(std::max(r.lower, 0));
      const double *const b = u.row(r.lower + 1);
      const int           j = y.lower;
      return (1 - r.s) * ((1 - y.s) * a[j] + y.s * a[j + 1]) +
             r.s * ((1 - y.s) * b[j] + y.s * b[j + 1]);
    }
  } // namespace

  std::vector<std::array<double, 2>>
  local_velocities(const VelocityField                      &velocity,
                   const std::vector<std::array<double, 2>> &points)
  {
    const StaggeredGrid &grid = velocity.grid();
    std::vector<double>  values(2 * points.size(), 0.);
    for (std::size_t k = 0; k < points.size(); ++k)
      {
        const auto [r, y] = points[k];
        if (!grid.owns_row(cell(grid.r, r)))
          continue;
        values[2 * k] = bilinear(
          velocity.r, between_faces(grid.r, r), between_centres(grid.y, y));
        values[2 * k + 1] = bilinear(
          velocity.y, between_centres(grid.r, r), between_faces(grid.y, y));
      }
    mpi::sum_in_place(values, grid.communicator());
    std::vector<std::array<double, 2>> result(points.size());
    for (std::size_t k = 0; k < points.size(); ++k)
      result[k] = {{values[2 * k], values[2 * k + 1]}};
    return result;
  }
} // namespace ephyra::fluid
