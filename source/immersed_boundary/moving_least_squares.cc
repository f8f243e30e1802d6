#include "ephyra/immersed_boundary/moving_least_squares.h"

#include <algorithm>
#include <cmath>

namespace ephyra::immersed_boundary
{
  namespace
  {
    int
    nearest_face(const fluid::GridLine &line, const double x)
    {
      const int i = std::clamp(line.cell_of(x), 0, line.n_cells - 1);
      return x < line.centre[i] ? i : i + 1;
    }

    int
    nearest_centre(const fluid::GridLine &line, const double x)
    {
      const int i = std::clamp(line.cell_of(x), 0, line.n_cells - 1);
      if (i > 0 && x - line.centre[i - 1] < line.centre[i] - x)
        return i - 1;
      if (i + 1 < line.n_cells && line.centre[i + 1] - x < x - line.centre[i])
        return i + 1;
      return i;
    }
  } // namespace

  double
  Stencil::apply(const fluid::DistributedArray &u,
                 const int                      begin,
                 const int                      end) const
  {
    double sum = 0;
    for (int a = 0; a < 3; ++a)
      if (row[a] >= begin && row[a] < end)
        {
          const double *values = u.row(row[a]);
          for (int b = 0; b < 3; ++b)
            sum += value[a][b] * values[column[b]];
        }
    return sum;
  }

  MovingLeastSquares::MovingLeastSquares(const fluid::StaggeredGrid &grid,
                                         const Parameters           &parameters)
    : the_grid(&grid)
    , weight_function(parameters.weight)
    , half_width(parameters.half_width)
    , exponential_width(parameters.exponential_width)
  {
  }

  double
  MovingLeastSquares::weight(const double d) const
  {
    if (weight_function == WeightFunction::exponential)
      {
        const double e = d / exponential_width;
        return std::exp(-e * e);
      }
    if (d <= 0.5)
      return 2. / 3. - 4. * d * d * (1. - d);
    const double c = std::max(0., 1. - d);
    return 4. / 3. * c * c * c;
  }

  double
  MovingLeastSquares::wrapped(const double y) const
  {
    if (!the_grid->periodic_y)
      return y;
    const double y0 = the_grid->y.face.front();
    const double L  = the_grid->y.face.back() - y0;
    return y - L * std::floor((y - y0) / L);
  }

  template <class Position>
  MovingLeastSquares::Line
  MovingLeastSquares::line(const double    x,
                           const int       nearest,
                           const int       lowest,
                           const int       highest,
                           const Position &position) const
  {
    const int first = std::clamp(nearest - 1, lowest, highest - 2);
    Line      line;
    double    xi[3];
    for (int i = 0; i < 3; ++i)
      {
        line.index[i] = first + i;
        xi[i]         = position(first + i) - x;
      }
    const double inverse = 2. / (half_width * (xi[2] - xi[0]));
    double       sum     = 0;
    for (int i = 0; i < 3; ++i)
      sum += line.weight[i] = weight(std::abs(xi[i]) * inverse);
    double m = 0, s = 0;
    for (int i = 0; i < 3; ++i)
      m += (line.weight[i] /= sum) * xi[i];
    for (int i = 0; i < 3; ++i)
      s += line.weight[i] * (xi[i] - m) * (xi[i] - m);
    for (int i = 0; i < 3; ++i)
      {
        line.slope[i]      = (xi[i] - m) * line.weight[i] / s;
        line.correction[i] = -m * line.slope[i];
      }
    return line;
  }

  MovingLeastSquares::Line
  MovingLeastSquares::r_faces(const double r) const
  {
    const fluid::GridLine &g = the_grid->r;
    Line l = line(r, nearest_face(g, r), -2, g.n_cells, [&](const int i) {
      return i < 0 ? -g.face[-i] : g.face[i];
    });
    for (int i = 0; i < 3; ++i)
      if (l.index[i] < 0)
        {
          l.index[i] = -l.index[i];
          l.weight[i] *= -1;
          l.correction[i] *= -1;
          l.slope[i] *= -1;
        }
    return l;
  }

  MovingLeastSquares::Line
  MovingLeastSquares::r_centres(const double r) const
  {
    const fluid::GridLine &g = the_grid->r;
    Line l = line(r, nearest_centre(g, r), -2, g.n_cells - 1, [&](const int i) {
      return i < 0 ? -g.centre[-i - 1] : g.centre[i];
    });
    for (int i = 0; i < 3; ++i)
      if (l.index[i] < 0)
        l.index[i] = -l.index[i] - 1;
    return l;
  }

  MovingLeastSquares::Line
  MovingLeastSquares::y_faces(const double y_in) const
  {
    const fluid::GridLine &g = the_grid->y;
    const double           y = wrapped(y_in);
    const int              n = g.n_cells;
    if (!the_grid->periodic_y)
      return line(
        y, nearest_face(g, y), 0, n, [&](const int j) { return g.face[j]; });
    const double L = g.face[n] - g.face[0];
    Line         l = line(y, nearest_face(g, y), -1, n + 1, [&](const int j) {
      return j < 0 ? g.face[j + n] - L : j > n ? g.face[j - n] + L : g.face[j];
    });
    for (int &j : l.index)
      j = (j + n) % n;
    return l;
  }

  MovingLeastSquares::Line
  MovingLeastSquares::y_centres(const double y_in) const
  {
    const fluid::GridLine &g = the_grid->y;
    const double           y = wrapped(y_in);
    const int              n = g.n_cells;
    if (!the_grid->periodic_y)
      return line(y, nearest_centre(g, y), 0, n - 1, [&](const int j) {
        return g.centre[j];
      });
    const double L = g.face[n] - g.face[0];
    Line         l = line(y, nearest_centre(g, y), -1, n, [&](const int j) {
      return j < 0    ? g.centre[j + n] - L
                     : j >= n ? g.centre[j - n] + L
                              : g.centre[j];
    });
    for (int &j : l.index)
      j = (j + n) % n;
    return l;
  }

  Stencil
  MovingLeastSquares::value(const Line &r, const Line &y)
  {
    Stencil s{r.index, y.index, {}};
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        s.value[a][b] = (r.weight[a] + r.correction[a]) * y.weight[b] +
                        r.weight[a] * y.correction[b];
    return s;
  }

  Stencil
  MovingLeastSquares::derivative_r(const Line &r, const Line &y)
  {
    Stencil s{r.index, y.index, {}};
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        s.value[a][b] = r.slope[a] * y.weight[b];
    return s;
  }

  Stencil
  MovingLeastSquares::derivative_y(const Line &r, const Line &y)
  {
    Stencil s{r.index, y.index, {}};
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        s.value[a][b] = r.weight[a] * y.slope[b];
    return s;
  }

  bool
  MovingLeastSquares::contains(const double r, const double y) const
  {
    return r >= 0 && r <= the_grid->r.face.back() &&
           (the_grid->periodic_y ||
            (y >= the_grid->y.face.front() && y <= the_grid->y.face.back()));
  }

  double
  MovingLeastSquares::cell_size(const Line  &r_centres,
                                const Line  &y_centres,
                                const double n_r,
                                const double n_y) const
  {
    const auto mean = [](const fluid::GridLine &g, const Line &l) {
      double width = 0;
      for (int i = 0; i < 3; ++i)
        width += l.weight[i] * g.width[l.index[i]];
      return width;
    };
    return std::hypot(n_r * mean(the_grid->r, r_centres),
                      n_y * mean(the_grid->y, y_centres));
  }
} // namespace ephyra::immersed_boundary
