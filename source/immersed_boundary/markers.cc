#include "ephyra/immersed_boundary/markers.h"

#include "ephyra/base/exceptions.h"

#include <algorithm>
#include <cmath>

namespace ephyra::immersed_boundary
{
  namespace
  {
    struct CurvePoint
    {
      double r = 0, y = 0;   ///< position
      double dr = 0, dy = 0; ///< derivative by theta
    };

    CurvePoint
    evaluate(const BoundaryCurve       &c,
             const std::vector<double> &x,
             const double               theta,
             splines::BasisValues<1>   &basis)
    {
      c.curve.evaluate_basis({theta}, basis);
      CurvePoint p;
      for (std::size_t a = 0; a < basis.index.size(); ++a)
        {
          const int    i = c.control_points[basis.index[a]];
          const double N = basis.value[a], dN = basis.derivative[0][a];
          p.r += N * x[2 * i];
          p.y += N * x[2 * i + 1];
          p.dr += dN * x[2 * i];
          p.dy += dN * x[2 * i + 1];
        }
      return p;
    }

    double
    wrapped(const fluid::StaggeredGrid &grid, const double y)
    {
      if (!grid.periodic_y)
        return y;
      const double y0 = grid.y.face.front(), L = grid.y.face.back() - y0;
      return y - L * std::floor((y - y0) / L);
    }

    /// Where the curve may bend sharply: its ends and knots of multiplicity
    /// degree.
    std::vector<double>
    sharp_knots(const splines::KnotVector &kv)
    {
      std::vector<double> result;
      const auto         &knots = kv.knots();
      for (const double b : kv.breaks())
        if (std::count(knots.begin(), knots.end(), b) >= kv.degree())
          result.push_back(b);
      return result;
    }
  } // namespace

  double
  length_in_cells(const fluid::StaggeredGrid &grid,
                  const double                r,
                  const double                y,
                  const double                a_r,
                  const double                a_y)
  {
    const auto clamped = [](const fluid::GridLine &line, const double x) {
      return line.width[std::clamp(line.cell_of(x), 0, line.n_cells - 1)];
    };
    return std::hypot(a_r / clamped(grid.r, r),
                      a_y / clamped(grid.y, wrapped(grid, y)));
  }

  Markers::Markers(std::vector<BoundaryCurve>  curves,
                   const std::vector<double>  &x,
                   const fluid::StaggeredGrid &grid,
                   const Parameters           &parameters)
    : boundary(std::move(curves))
    , parameters(parameters)
  {
    distribute({x}, grid);
  }

  void
  Markers::distribute(const std::vector<std::vector<double>> &shapes,
                      const fluid::StaggeredGrid             &grid)
  {
    theta_of.clear();
    dtheta.clear();
    curve_of.clear();
    first.assign(1, 0);
    R  = SparseRows();
    dR = SparseRows();
    for (std::size_t c = 0; c < boundary.size(); ++c)
      {
        place_on_curve(static_cast<int>(c), shapes, grid);
        first.push_back(size());
      }

    splines::BasisValues<1> basis;
    for (int l = 0; l < size(); ++l)
      {
        const BoundaryCurve &c = boundary[curve_of[l]];
        c.curve.evaluate_basis({theta_of[l]}, basis);
        for (std::size_t a = 0; a < basis.index.size(); ++a)
          {
            R.column.push_back(c.control_points[basis.index[a]]);
            R.value.push_back(basis.value[a]);
            dR.value.push_back(basis.derivative[0][a]);
          }
        R.start.push_back(static_cast<int>(R.column.size()));
      }
    for (auto *v : {&now.r,
                    &now.y,
                    &now.v_r,
                    &now.v_y,
                    &now.a_r,
                    &now.a_y,
                    &now.t_r,
                    &now.t_y,
                    &now.n_r,
                    &now.n_y,
                    &now.length,
                    &now.dv_r_ds,
                    &now.dv_y_ds})
      v->assign(size(), 0.);
    const std::vector<double> rest(shapes.back().size(), 0.);
    move(shapes.back(), rest, rest);
  }

  void
  Markers::place_on_curve(const int                               c_index,
                          const std::vector<std::vector<double>> &shapes,
                          const fluid::StaggeredGrid             &grid)
  {
    const BoundaryCurve       &c  = boundary[c_index];
    const splines::KnotVector &kv = c.curve.knot_vector(0);
    splines::BasisValues<1>    basis;

    // Running length in cells, tabulated finely enough to see every cell.
    std::vector<double> theta{0.}, cells{0.};
    for (int e = 0; e < kv.n_elements(); ++e)
      {
        const double a = kv.breaks()[e], b = kv.breaks()[e + 1];
        const auto rate_of = [&](const std::vector<double> &x, const double t) {
          const CurvePoint p = evaluate(c, x, t, basis);
          EphyraThrowIf(
            grid.r.cell_of(p.r) == grid.r.n_cells || p.r < -1e-12 ||
              (!grid.periodic_y && (grid.y.cell_of(p.y) < 0 ||
                                    grid.y.cell_of(p.y) == grid.y.n_cells)),
            InputError,
            "Body '" << c.name << "' reaches (r, y) = (" << p.r << ", " << p.y
                     << ") m, outside of the flow grid [0, "
                     << grid.r.face.back() << "] x [" << grid.y.face.front()
                     << ", " << grid.y.face.back()
                     << "] m: move the body or enlarge the grid.");
          return length_in_cells(grid, p.r, p.y, p.dr, p.dy);
        };
        const auto rate = [&](const double t) {
          double longest = 0.;
          for (const std::vector<double> &x : shapes)
            longest = std::max(longest, rate_of(x, t));
          return longest;
        };
        const double largest =
          std::max({rate(a), rate(0.5 * (a + b)), rate(b)}) * (b - a);
        const int n = std::max(16, static_cast<int>(4 * largest));
        for (int k = 0; k < n; ++k)
          {
            const double h = (b - a) / n;
            cells.push_back(cells.back() + h * rate(a + (k + 0.5) * h));
            theta.push_back(k + 1 == n ? b : a + (k + 1) * h);
          }
      }
    const auto interpolate = [](const std::vector<double> &from,
                                const std::vector<double> &to,
                                const double               value) {
      const auto   it = std::upper_bound(from.begin(), from.end() - 1, value);
      const auto   i  = std::max<std::ptrdiff_t>(1, it - from.begin());
      const double s  = (value - from[i - 1]) / (from[i] - from[i - 1]);
      return to[i - 1] + s * (to[i] - to[i - 1]);
    };

    const std::vector<double> sharp = sharp_knots(kv);
    for (std::size_t piece = 0; piece + 1 < sharp.size(); ++piece)
      {
        const double begin = interpolate(theta, cells, sharp[piece]);
        const double end   = interpolate(theta, cells, sharp[piece + 1]);
        if (!(end > begin)) // shrunk to a point
          continue;
        const int n = static_cast<int>(
          std::ceil((end - begin) / parameters.marker_spacing - 1e-9));
        double left = sharp[piece];
        for (int k = 0; k < n; ++k)
          {
            const double right =
              k + 1 == n ? sharp[piece + 1]
                         : interpolate(
                             cells, theta, begin + (k + 1) * (end - begin) / n);
            theta_of.push_back(0.5 * (left + right));
            dtheta.push_back(right - left);
            curve_of.push_back(c_index);
            left = right;
          }
      }
  }

  void
  Markers::move(const std::vector<double> &x,
                const std::vector<double> &velocity,
                const std::vector<double> &acceleration)
  {
    for (int l = 0; l < size(); ++l)
      {
        double r = 0, y = 0, v_r = 0, v_y = 0, a_r = 0, a_y = 0;
        double dr = 0, dy = 0, dv_r = 0, dv_y = 0;
        for (int k = R.start[l]; k < R.start[l + 1]; ++k)
          {
            const int    i = 2 * R.column[k];
            const double N = R.value[k], dN = dR.value[k];
            r += N * x[i];
            y += N * x[i + 1];
            v_r += N * velocity[i];
            v_y += N * velocity[i + 1];
            a_r += N * acceleration[i];
            a_y += N * acceleration[i + 1];
            dr += dN * x[i];
            dy += dN * x[i + 1];
            dv_r += dN * velocity[i];
            dv_y += dN * velocity[i + 1];
          }
        const double speed = std::hypot(dr, dy);
        EphyraThrowIf(!std::isfinite(speed + r + y + v_r + v_y) || speed == 0,
                      DivergedError,
                      "The surface of body '"
                        << boundary[curve_of[l]].name
                        << "' at theta = " << theta_of[l] << ", (r, y) = (" << r
                        << ", " << y << ") m, velocity (" << v_r << ", " << v_y
                        << ") m/s, has collapsed or is not finite: reduce the "
                           "time step.");
        const double o = boundary[curve_of[l]].orientation;
        now.r[l]       = r;
        now.y[l]       = y;
        now.v_r[l]     = v_r;
        now.v_y[l]     = v_y;
        now.a_r[l]     = a_r;
        now.a_y[l]     = a_y;
        now.t_r[l]     = dr / speed;
        now.t_y[l]     = dy / speed;
        now.n_r[l]     = o * dy / speed;
        now.n_y[l]     = -o * dr / speed;
        now.length[l]  = speed * dtheta[l];
        now.dv_r_ds[l] = dv_r / speed;
        now.dv_y_ds[l] = dv_y / speed;
      }
  }

  double
  Markers::largest_spacing(const fluid::StaggeredGrid &grid) const
  {
    double largest = 0;
    for (int l = 0; l < size(); ++l)
      largest = std::max(largest,
                         length_in_cells(grid,
                                         now.r[l],
                                         now.y[l],
                                         now.length[l] * now.t_r[l],
                                         now.length[l] * now.t_y[l]));
    return largest;
  }

  void
  Markers::check_inside(const fluid::StaggeredGrid &grid) const
  {
    for (int l = 0; l < size(); ++l)
      {
        const std::string &name = boundary[curve_of[l]].name;
        EphyraThrowIf(now.r[l] < 0 || now.r[l] >= grid.r.face.back() ||
                        (!grid.periodic_y && (now.y[l] <= grid.y.face.front() ||
                                              now.y[l] >= grid.y.face.back())),
                      immersed_boundary::LeftTheGrid,
                      "Body '"
                        << name << "' has left the flow grid at (r, y) = ("
                        << now.r[l] << ", " << now.y[l]
                        << ") m; the grid covers [0, " << grid.r.face.back()
                        << "] x [" << grid.y.face.front() << ", "
                        << grid.y.face.back()
                        << "] m: enlarge it or end the run earlier.");
      }
  }

  void
  Markers::check(const fluid::StaggeredGrid &grid) const
  {
    check_inside(grid);
    for (int l = 0; l < size(); ++l)
      {
        const double spacing = length_in_cells(grid,
                                               now.r[l],
                                               now.y[l],
                                               now.length[l] * now.t_r[l],
                                               now.length[l] * now.t_y[l]);
        EphyraThrowIf(
          spacing > parameters.largest_spacing,
          DivergedError,
          "The markers of body '"
            << boundary[curve_of[l]].name << "' at (r, y) = (" << now.r[l]
            << ", " << now.y[l] << ") m are " << spacing
            << " cells apart, more than " << parameters.largest_spacing
            << ": reduce 'Marker spacing' or coarsen the grid there.");
      }
  }

  void
  Markers::to_control_points(const std::vector<double> &marker_force,
                             std::vector<double>       &control_force) const
  {
    std::fill(control_force.begin(), control_force.end(), 0.);
    for (int l = 0; l < size(); ++l)
      for (int k = R.start[l]; k < R.start[l + 1]; ++k)
        {
          control_force[2 * R.column[k]] += R.value[k] * marker_force[l];
          control_force[2 * R.column[k] + 1] +=
            R.value[k] * marker_force[size() + l];
        }
  }
} // namespace ephyra::immersed_boundary
