#include "ephyra/fluid/momentum.h"

#include <algorithm>

namespace ephyra::fluid
{
  ViscousStencil
  radial_stencil_of_v_r(const StaggeredGrid &grid, const int i)
  {
    const GridLine &r   = grid.r;
    const int       n   = r.n_cells;
    const double    gap = r.centre_gap[i];
    const auto   area   = [&](const int k) { return r.centre[k] * r.width[k]; };
    const double area_m = area(i - 1), area_p = i < n ? area(i) : area_m;
    const double r_p = i < n ? r.face[i + 1] : r.face[n] + r.width[n - 1];
    return {r.face[i - 1] / (area_m * gap),
            r.face[i] / gap * (1. / area_p + 1. / area_m),
            r_p / (area_p * gap)};
  }

  ViscousStencil
  radial_stencil_of_v_y(const StaggeredGrid &grid, const int i)
  {
    const GridLine &r        = grid.r;
    const double    inv_area = 1. / (r.centre[i] * r.width[i]);
    const double    minus    = r.face[i] * inv_area / r.mirrored_gap(i, false);
    const double plus = r.face[i + 1] * inv_area / r.mirrored_gap(i + 1, false);
    return {minus, minus + plus, plus};
  }

  Momentum::Momentum(const FlowParameters &parameters,
                     const StaggeredGrid  &grid,
                     const Boundary       &boundary)
    : grid(grid)
    , boundary(boundary)
    , nu(parameters.kinematic_viscosity())
    , convection(parameters.convection)
  {
    const int  n        = grid.y.n_cells;
    const bool periodic = grid.periodic_y;
    for (AlignedVector *a : {&inv_width,
                             &cell_down,
                             &cell_up,
                             &inv_gap,
                             &mean_below,
                             &mean_above,
                             &face_down,
                             &face_up,
                             &gradient})
      a->assign(n + 1, 0.);
    for (int j = 0; j < n; ++j)
      {
        inv_width[j] = 1. / grid.y.width[j];
        cell_down[j] = inv_width[j] / grid.y.mirrored_gap(j, periodic);
        cell_up[j]   = inv_width[j] / grid.y.mirrored_gap(j + 1, periodic);
      }
    for (int j = 0; j <= n; ++j)
      {
        // Outside an open side there is no cell: half a control volume.
        const bool   has_below = j > 0 || periodic;
        const bool   has_above = j < n || periodic;
        const double gap       = grid.y.centre_gap[j];
        const double below     = grid.y.width[j > 0 ? j - 1 : n - 1];
        const double above     = grid.y.width[j < n ? j : 0];
        inv_gap[j]             = 1. / gap;
        mean_below[j]          = has_below ? 0.5 * below / gap : 0.;
        mean_above[j]          = has_above ? 0.5 * above / gap : 0.;
        face_down[j]           = has_below ? 1. / (gap * below) : 0.;
        face_up[j]             = has_above ? 1. / (gap * above) : 0.;
        gradient[j]            = 1. / grid.y.mirrored_gap(j, periodic);
      }
  }

  template <bool convection, bool split, bool use_history, bool store_history>
  void
  Momentum::update_rows(const VelocityField    &u,
                        const DistributedArray &p,
                        VelocityField          &history,
                        VelocityField          &out,
                        const Factors          &factors) const
  {
    const GridLine &r   = grid.r;
    const int       n_r = r.n_cells, n_y = grid.y.n_cells;
    const double    beta = factors.beta, gamma = factors.gamma;
    const double    nu_r       = factors.directions.r ? 0. : nu;
    const double    nu_y       = factors.directions.y ? 0. : nu;
    const double    implicit_r = factors.implicit * (nu - nu_r);
    const double    implicit_y = factors.implicit * (nu - nu_y);
    const auto area = [&](const int i) { return r.centre[i] * r.width[i]; };

    // Stores H and the result at j; `viscous_*` without viscosity.
    const auto finish = [=](const double  h_convective,
                            const double  viscous_r,
                            const double  viscous_y,
                            const double  pressure_term,
                            const double  u_here,
                            double *const hist,
                            double *const result,
                            const int     j) {
      const double h    = h_convective + nu_r * viscous_r + nu_y * viscous_y;
      double       next = beta * h - pressure_term;
      if constexpr (split)
        next += implicit_r * viscous_r + implicit_y * viscous_y;
      else
        next += u_here;
      if constexpr (use_history)
        next += gamma * hist[j];
      if constexpr (store_history)
        hist[j] = h;
      result[j] = next;
    };

    const auto radial_row = [&](const int i) {
      const bool   open = i == n_r; // half a control volume on an open side
      const double gap  = r.centre_gap[i];
      const double r_m = r.face[i - 1], r_c = r.face[i];
      const double r_p     = open ? r_c + r.width[n_r - 1] : r.face[i + 1];
      const double scale_r = 0.25 / (r_c * gap);
      const double half_m  = 0.25 * area(i - 1) / (r_c * gap);
      const double half_p  = open ? 0. : 0.25 * area(i) / (r_c * gap);
      const ViscousStencil stencil = radial_stencil_of_v_r(grid, i);
      const double         visc_m = stencil.minus, visc_c = stencil.centre,
                   visc_p = stencil.plus;
      const double grad   = factors.pressure / r.mirrored_gap(i, false);

      const double *const um = u.r.row(i - 1), *const uc = u.r.row(i),
                          *const up = u.r.row(i + 1);
      const double *const wm = u.y.row(i - 1), *const wp = u.y.row(i);
      const double *const pm = p.row(i - 1), *const pp = p.row(i);
      const double *const inv_dy = inv_width.data();
      const double *const down = cell_down.data(), *const up_y = cell_up.data();
      double *const hist   = history.r.row(i);
      double *const result = out.r.row(i);
#pragma GCC ivdep
      for (int j = 0; j < n_y; ++j)
        {
          double h = 0;
          if constexpr (convection)
            {
              const double flux_p =
                (r_c * uc[j] + r_p * up[j]) * (uc[j] + up[j]);
              const double flux_m =
                (r_m * um[j] + r_c * uc[j]) * (um[j] + uc[j]);
              const double top =
                (half_m * wm[j + 1] + half_p * wp[j + 1]) * (uc[j] + uc[j + 1]);
              const double bottom =
                (half_m * wm[j] + half_p * wp[j]) * (uc[j - 1] + uc[j]);
              h = -((flux_p - flux_m) * scale_r + (top - bottom) * inv_dy[j]);
            }
          const double viscous_r =
            visc_p * up[j] - visc_c * uc[j] + visc_m * um[j];
          const double viscous_y =
            up_y[j] * (uc[j + 1] - uc[j]) - down[j] * (uc[j] - uc[j - 1]);
          finish(h,
                 viscous_r,
                 viscous_y,
                 grad * (pp[j] - pm[j]),
                 uc[j],
                 hist,
                 result,
                 j);
        }
    };

    const int    first = boundary.first_y_face(), end = boundary.end_y_face();
    const double body_force = factors.body_force;
    const auto   axial_row  = [&](const int i) {
      const double         inv_area = 1. / area(i);
      const double         flux_up  = 0.5 * r.face[i + 1] * inv_area;
      const double         flux_low = 0.5 * r.face[i] * inv_area;
      const ViscousStencil stencil  = radial_stencil_of_v_y(grid, i);
      const double         visc_m = stencil.minus, visc_p = stencil.plus;

      const double *const wm = u.y.row(i - 1), *const wc = u.y.row(i),
                          *const wp = u.y.row(i + 1);
      const double *const um = u.r.row(i), *const up = u.r.row(i + 1);
      const double *const pc   = p.row(i);
      const double *const igap = inv_gap.data(), *const grad = gradient.data();
      const double *const below = mean_below.data(), *const above =
                                                       mean_above.data();
      const double *const down = face_down.data(), *const up_y = face_up.data();
      const double  pressure = factors.pressure;
      double *const hist     = history.y.row(i);
      double *const result   = out.y.row(i);
#pragma GCC ivdep
      for (int j = first; j < end; ++j)
        {
          double h = body_force;
          if constexpr (convection)
            {
              const double sum_p = wc[j] + wc[j + 1], sum_m = wc[j - 1] + wc[j];
              const double flux_p = flux_up *
                                    (below[j] * up[j - 1] + above[j] * up[j]) *
                                    (wc[j] + wp[j]);
              const double flux_m = flux_low *
                                    (below[j] * um[j - 1] + above[j] * um[j]) *
                                    (wm[j] + wc[j]);
              h -= 0.25 * (sum_p * sum_p - sum_m * sum_m) * igap[j] +
                   (flux_p - flux_m);
            }
          const double viscous_r =
            visc_p * (wp[j] - wc[j]) - visc_m * (wc[j] - wm[j]);
          const double viscous_y =
            up_y[j] * (wc[j + 1] - wc[j]) - down[j] * (wc[j] - wc[j - 1]);
          finish(h,
                 viscous_r,
                 viscous_y,
                 pressure * grad[j] * (pc[j] - pc[j - 1]),
                 wc[j],
                 hist,
                 result,
                 j);
        }
    };

    // Both components of a row while its neighbours are in cache.
    const int first_face = boundary.first_r_face(),
              end_face   = boundary.end_r_face();
    for (int i = grid.first_row; i < std::max(grid.end_row(), end_face); ++i)
      {
        if (i >= first_face && i < end_face)
          radial_row(i);
        if (i < grid.end_row())
          axial_row(i);
      }
  }

  void
  Momentum::update(const VelocityField    &u,
                   const DistributedArray &p,
                   VelocityField          &history,
                   VelocityField          &out,
                   const Factors          &factors) const
  {
    const bool use_history = factors.gamma != 0;
    const auto choose      = [&](const auto convective, const auto split) {
      constexpr bool c = decltype(convective)::value,
                     s = decltype(split)::value;
      if (use_history && factors.store_history)
        update_rows<c, s, true, true>(u, p, history, out, factors);
      else if (use_history)
        update_rows<c, s, true, false>(u, p, history, out, factors);
      else if (factors.store_history)
        update_rows<c, s, false, true>(u, p, history, out, factors);
      else
        update_rows<c, s, false, false>(u, p, history, out, factors);
    };
    if (convection && factors.directions.any())
      choose(std::true_type(), std::true_type());
    else if (convection)
      choose(std::true_type(), std::false_type());
    else if (factors.directions.any())
      choose(std::false_type(), std::true_type());
    else
      choose(std::false_type(), std::false_type());
  }

  void
  Momentum::correct_radial(VelocityField          &u,
                           const DistributedArray &phi,
                           const double            factor,
                           const int               i) const
  {
    const double        scale = factor / grid.r.mirrored_gap(i, false);
    const double *const below = phi.row(i - 1), *const above = phi.row(i);
    double *const v = u.r.row(i);
#pragma GCC ivdep
    for (int j = 0; j < grid.y.n_cells; ++j)
      v[j] -= scale * (above[j] - below[j]);
  }

  void
  Momentum::correct_axial(VelocityField          &u,
                          const DistributedArray &phi,
                          const double            factor,
                          const int               i) const
  {
    const double *const f    = phi.row(i);
    const double *const grad = gradient.data();
    double *const       v    = u.y.row(i);
    const int           end  = boundary.end_y_face();
#pragma GCC ivdep
    for (int j = boundary.first_y_face(); j < end; ++j)
      v[j] -= factor * grad[j] * (f[j] - f[j - 1]);
  }

  void
  Momentum::divergence(const VelocityField &u,
                       const double         factor,
                       const int            i,
                       double *const        row) const
  {
    const double        scale = factor / (grid.r.centre[i] * grid.r.width[i]);
    const double        up    = scale * grid.r.face[i + 1];
    const double        low   = scale * grid.r.face[i];
    const double *const v_low = u.r.row(i), *const v_up = u.r.row(i + 1);
    const double *const w      = u.y.row(i);
    const double *const inv_dy = inv_width.data();
#pragma GCC ivdep
    for (int j = 0; j < grid.y.n_cells; ++j)
      row[j] =
        up * v_up[j] - low * v_low[j] + factor * inv_dy[j] * (w[j + 1] - w[j]);
  }
} // namespace ephyra::fluid
