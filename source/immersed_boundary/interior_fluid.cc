#include "ephyra/immersed_boundary/interior_fluid.h"

#include "ephyra/base/mpi.h"
#include "ephyra/splines/control_vector.h"

#include <algorithm>
#include <cmath>

namespace ephyra::immersed_boundary
{
  namespace
  {
    constexpr double piece_in_cells = 0.5;
  }

  InteriorFluid::InteriorFluid(const splines::NurbsPatch<2> &patch,
                               const fluid::StaggeredGrid   &grid,
                               const double                  density,
                               const double                  viscosity,
                               const Parameters             &parameters)
    : mls(grid, parameters)
    , density(density)
    , viscosity(viscosity)
  {
    using Parameter = splines::NurbsPatch<2>::Parameter;
    splines::BasisValues<2> basis;
    const auto             &b1 = patch.knot_vector(0).breaks();
    const auto             &b2 = patch.knot_vector(1).breaks();
    for (std::size_t e = 0; e + 1 < b1.size(); ++e)
      for (std::size_t f = 0; f + 1 < b2.size(); ++f)
        {
          const double size[2]  = {b1[e + 1] - b1[e], b2[f + 1] - b2[f]};
          double       cells[2] = {0, 0}; // largest extent of the element
          for (const double s : {0.01, 0.5, 0.99})
            for (const double q : {0.01, 0.5, 0.99})
              {
                const Parameter theta{
                  {b1[e] + s * size[0], b2[f] + q * size[1]}};
                const auto x = patch.point(theta);
                const auto g = patch.tangents(theta);
                for (int k = 0; k < 2; ++k)
                  cells[k] = std::max(
                    cells[k],
                    size[k] * length_in_cells(grid, x.r, x.y, g[k].r, g[k].y));
              }
          int n[2];
          for (int k = 0; k < 2; ++k)
            n[k] = std::max(
              1, static_cast<int>(std::ceil(cells[k] / piece_in_cells)));
          for (int i = 0; i < n[0]; ++i)
            for (int j = 0; j < n[1]; ++j)
              {
                patch.evaluate_basis({{b1[e] + (i + 0.5) / n[0] * size[0],
                                       b2[f] + (j + 0.5) / n[1] * size[1]}},
                                     basis);
                for (std::size_t a = 0; a < basis.index.size(); ++a)
                  {
                    R.column.push_back(basis.index[a]);
                    R.value.push_back(basis.value[a]);
                    dR[0].push_back(basis.derivative[0][a]);
                    dR[1].push_back(basis.derivative[1][a]);
                  }
                R.start.push_back(static_cast<int>(R.column.size()));
                weight.push_back(size[0] / n[0] * size[1] / n[1]);
              }
        }
    points.resize(weight.size());
    update(splines::control_vector(patch));
  }

  void
  InteriorFluid::update(const std::vector<double> &x)
  {
    for (int l = 0; l < size(); ++l)
      {
        Point &p = points[l];
        p.r = p.y      = 0;
        double g[2][2] = {{0, 0}, {0, 0}}; // g[k][c] = d x_c / d theta^k
        for (int k = R.start[l]; k < R.start[l + 1]; ++k)
          {
            const double *control = &x[2 * R.column[k]];
            p.r += R.value[k] * control[0];
            p.y += R.value[k] * control[1];
            for (int c = 0; c < 2; ++c)
              {
                g[0][c] += dR[0][k] * control[c];
                g[1][c] += dR[1][k] * control[c];
              }
          }
        const double det = g[0][0] * g[1][1] - g[0][1] * g[1][0];
        p.area           = std::abs(det) * weight[l];
        p.inverse[0][0]  = g[1][1] / det;
        p.inverse[0][1]  = -g[1][0] / det;
        p.inverse[1][0]  = -g[0][1] / det;
        p.inverse[1][1]  = g[0][0] / det;

        using Mls     = MovingLeastSquares;
        const auto rc = mls.r_centres(p.r), rf = mls.r_faces(p.r);
        const auto yc = mls.y_centres(p.y), yf = mls.y_faces(p.y);
        p.v_r   = Mls::value(rf, yc);
        p.v_r_r = Mls::derivative_r(rf, yc);
        p.v_r_y = Mls::derivative_y(rf, yc);
        p.v_y   = Mls::value(rc, yf);
        p.v_y_r = Mls::derivative_r(rc, yf);
        p.v_y_y = Mls::derivative_y(rc, yf);
        p.p     = Mls::value(rc, yc);
      }
  }

  void
  InteriorFluid::sample(const fluid::VelocityField    &velocity,
                        const fluid::DistributedArray *pressure,
                        std::vector<double>           &values) const
  {
    const fluid::StaggeredGrid &grid  = mls.grid();
    const int                   begin = grid.first_row, end = grid.end_row();
    const int end_of_faces = end + (grid.is_last_rank() ? 1 : 0);
    values.assign(static_cast<std::size_t>(n_values) * size(), 0.);
    for (int l = 0; l < size(); ++l)
      {
        const Point &p = points[l];
        double      *v = values.data() + static_cast<std::size_t>(n_values) * l;
        v[0]           = p.v_r.apply(velocity.r, begin, end_of_faces);
        v[1]           = p.v_y.apply(velocity.y, begin, end);
        v[2]           = p.v_r_r.apply(velocity.r, begin, end_of_faces);
        v[3]           = p.v_r_y.apply(velocity.r, begin, end_of_faces);
        v[4]           = p.v_y_r.apply(velocity.y, begin, end);
        v[5]           = p.v_y_y.apply(velocity.y, begin, end);
        if (pressure)
          v[6] = p.p.apply(*pressure, begin, end);
      }
    mpi::sum_in_place(values, grid.communicator());
  }

  void
  InteriorFluid::start(const fluid::VelocityField &velocity)
  {
    sample(velocity, nullptr, old_values);
    old_r.resize(size());
    old_y.resize(size());
    for (int l = 0; l < size(); ++l)
      {
        old_r[l] = points[l].r;
        old_y[l] = points[l].y;
      }
  }

  void
  InteriorFluid::add_load(const double                   dt,
                          const fluid::DistributedArray &pressure,
                          const fluid::VelocityField    &velocity,
                          std::vector<double>           &load)
  {
    std::vector<double> values;
    sample(velocity, &pressure, values);
    for (int l = 0; l < size(); ++l)
      {
        const Point  &q = points[l];
        const double *v =
          values.data() + static_cast<std::size_t>(n_values) * l;
        const double *o =
          old_values.data() + static_cast<std::size_t>(n_values) * l;
        double mean[n_values - 1];
        for (int k = 0; k < n_values - 1; ++k)
          mean[k] = 0.5 * (v[k] + o[k]);
        const double L[2][2] = {{mean[2], mean[3]}, {mean[4], mean[5]}};
        // Along the moving point, and what the fluid moves beside it.
        const double slip[2] = {mean[0] - (q.r - old_r[l]) / dt,
                                mean[1] - (q.y - old_y[l]) / dt};
        double       inertia[2], stress[2][2];
        for (int c = 0; c < 2; ++c)
          {
            inertia[c] = density * ((v[c] - o[c]) / dt + L[c][0] * slip[0] +
                                    L[c][1] * slip[1]);
            for (int d = 0; d < 2; ++d)
              stress[c][d] = viscosity * (L[c][d] + L[d][c]);
            stress[c][c] -= v[6];
          }
        inertia[0] += (2 * viscosity * mean[0] / q.r - v[6]) / q.r; // hoop
        const double volume = 2 * M_PI * q.r * q.area;
        for (int k = R.start[l]; k < R.start[l + 1]; ++k)
          for (int c = 0; c < 2; ++c)
            {
              double f = inertia[c] * R.value[k];
              for (int d = 0; d < 2; ++d)
                f += stress[c][d] *
                     (dR[0][k] * q.inverse[0][d] + dR[1][k] * q.inverse[1][d]);
              load[2 * R.column[k] + c] += volume * f;
            }
      }
  }
} // namespace ephyra::immersed_boundary
