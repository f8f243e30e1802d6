#include "ephyra/fluid/boundary.h"

#include "ephyra/base/exceptions.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace ephyra::fluid
{
  namespace
  {
    constexpr int halo = DistributedArray::halo;

    /// Whether the variable t occurs in a formula.
    bool
    holds_time(const std::string &formula)
    {
      const auto is_name = [&](const std::size_t k) {
        return k < formula.size() &&
               (std::isalnum(static_cast<unsigned char>(formula[k])) != 0 ||
                formula[k] == '_');
      };
      for (std::size_t k = 0; k < formula.size(); ++k)
        if (formula[k] == 't' && !is_name(k + 1) && (k == 0 || !is_name(k - 1)))
          return true;
      return false;
    }

    bool
    is_wall(const SideKind kind)
    {
      return kind == SideKind::no_slip || kind == SideKind::free_slip ||
             kind == SideKind::velocity;
    }
  } // namespace

  Boundary::Formula::Formula(const std::string &text)
    : zero(Expression(text, {"s", "t"}).is_zero())
    , expression(text, {"s", "t"})
  {
  }

  Boundary::Formulas::Formulas(const SideParameters &parameters)
    : kind(parameters.kind)
    , radial(parameters.radial_velocity)
    , axial(parameters.axial_velocity)
    , pressure(parameters.pressure)
    , steady(!holds_time(parameters.radial_velocity) &&
             !holds_time(parameters.axial_velocity) &&
             !holds_time(parameters.pressure))
  {
  }

  Boundary::Boundary(const FlowParameters &parameters,
                     const StaggeredGrid  &grid)
    : grid(grid)
    , sides{Formulas(parameters.lower),
            Formulas(parameters.upper),
            Formulas(parameters.outer)}
  {
    for (const Side side : {lower, upper})
      for (std::vector<double> *values : {&sides[side].radial_values,
                                          &sides[side].axial_values,
                                          &sides[side].pressure_values})
        values->assign(slot(grid.end_row() + halo), 0.);
    for (std::vector<double> *values : {&sides[outer].radial_values,
                                        &sides[outer].axial_values,
                                        &sides[outer].pressure_values})
      values->assign(grid.y.n_cells + 1, 0.);
  }

  PoissonSides
  Boundary::poisson_sides() const
  {
    return {sides[outer].kind == SideKind::pressure,
            sides[lower].kind == SideKind::pressure,
            sides[upper].kind == SideKind::pressure};
  }

  int
  Boundary::first_r_face() const
  {
    return std::max(1, grid.first_row);
  }

  int
  Boundary::end_r_face() const
  {
    return grid.end_row() + (grid.is_last_rank() ? opens_outer_side() : 0);
  }

  int
  Boundary::first_y_face() const
  {
    const SideKind kind = sides[lower].kind;
    return kind == SideKind::periodic || kind == SideKind::pressure ? 0 : 1;
  }

  int
  Boundary::end_y_face() const
  {
    return grid.y.n_cells + (sides[upper].kind == SideKind::pressure ? 1 : 0);
  }

  void
  Boundary::set_time(const double t)
  {
    now = t;
    for (Formulas &side : sides)
      {
        if (evaluated && side.steady)
          continue;
        const bool moving = side.kind == SideKind::velocity;
        const bool open   = side.kind == SideKind::pressure;
        if (&side == &sides[outer])
          {
            if (!grid.is_last_rank())
              continue;
            for (int j = 0; j <= grid.y.n_cells; ++j)
              {
                const double face = grid.y.face[j];
                const double centre =
                  grid.y.centre[std::min(j, grid.y.n_cells - 1)];
                if (moving)
                  {
                    side.radial_values[j] = side.radial(centre, t);
                    side.axial_values[j]  = side.axial(face, t);
                  }
                if (open)
                  side.pressure_values[j] = side.pressure(centre, t);
              }
          }
        else
          for (int i = std::max(0, grid.first_row - halo);
               i < std::min(grid.r.n_cells, grid.end_row() + halo);
               ++i)
            {
              if (moving)
                {
                  side.radial_values[slot(i)] = side.radial(grid.r.face[i], t);
                  side.axial_values[slot(i)]  = side.axial(grid.r.centre[i], t);
                }
              if (open)
                side.pressure_values[slot(i)] =
                  side.pressure(grid.r.centre[i], t);
            }
      }
    evaluated = true;
  }

  bool
  Boundary::fixes_tangential(const Side side) const
  {
    return sides[side].kind == SideKind::no_slip ||
           sides[side].kind == SideKind::velocity;
  }

  double
  Boundary::tangential(const Side side, const int index) const
  {
    return side == outer ? sides[outer].axial_values[index]
                         : sides[side].radial_values[slot(index)];
  }

  void
  Boundary::set_normal_velocities(const VelocityField &previous,
                                  const double         dt,
                                  VelocityField       &velocity) const
  {
    const int n_y = grid.y.n_cells, n_r = grid.r.n_cells;
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      {
        if (is_wall(sides[lower].kind))
          velocity.y(i, 0) = sides[lower].axial_values[slot(i)];
        if (is_wall(sides[upper].kind))
          velocity.y(i, n_y) = sides[upper].axial_values[slot(i)];
      }
    if (grid.is_first_rank())
      std::fill(velocity.r.row(0) - halo, velocity.r.row(0) + n_y + halo, 0.);
    if (grid.is_last_rank() && is_wall(sides[outer].kind))
      std::copy(sides[outer].radial_values.begin(),
                sides[outer].radial_values.begin() + n_y,
                velocity.r.row(n_r));

    bool flow_through = false, open = false;
    for (const Side side : {lower, upper, outer})
      {
        const Formulas &s = sides[side];
        flow_through      = flow_through || s.kind == SideKind::outflow ||
                       (s.kind == SideKind::velocity &&
                        !(side == outer ? s.radial.zero : s.axial.zero));
        open = open || s.kind == SideKind::pressure;
      }
    if (!flow_through)
      return;
    advance_outflow(previous, dt, velocity);
    if (!open)
      balance_mass(velocity);
  }

  void
  Boundary::advance_outflow(const VelocityField &previous,
                            const double         dt,
                            VelocityField       &velocity) const
  {
    const int n_y = grid.y.n_cells, n_r = grid.r.n_cells;
    // Speed and upwind update on each side; `in` is the face inside.
    const auto convect = [&](const double speed,
                             const double width,
                             const double boundary,
                             const double in) {
      return boundary - std::min(speed * dt / width, 1.) * (boundary - in);
    };
    if (sides[lower].kind == SideKind::outflow)
      {
        double speed = 0;
        for (int i = grid.first_row; i < grid.end_row(); ++i)
          speed = std::max(speed, -previous.y(i, 1));
        speed = mpi::max(speed, grid.communicator());
        for (int i = grid.first_row; i < grid.end_row(); ++i)
          velocity.y(i, 0) =
            convect(speed, grid.y.width[0], previous.y(i, 0), previous.y(i, 1));
      }
    if (sides[upper].kind == SideKind::outflow)
      {
        double speed = 0;
        for (int i = grid.first_row; i < grid.end_row(); ++i)
          speed = std::max(speed, previous.y(i, n_y - 1));
        speed = mpi::max(speed, grid.communicator());
        for (int i = grid.first_row; i < grid.end_row(); ++i)
          velocity.y(i, n_y) = convect(speed,
                                       grid.y.width[n_y - 1],
                                       previous.y(i, n_y),
                                       previous.y(i, n_y - 1));
      }
    if (sides[outer].kind == SideKind::outflow && grid.is_last_rank())
      {
        double speed = 0;
        for (int j = 0; j < n_y; ++j)
          speed = std::max(speed, previous.r(n_r - 1, j));
        for (int j = 0; j < n_y; ++j)
          velocity.r(n_r, j) = convect(speed,
                                       grid.r.width[n_r - 1],
                                       previous.r(n_r, j),
                                       previous.r(n_r - 1, j));
      }
  }

  void
  Boundary::balance_mass(VelocityField &velocity) const
  {
    const int n_y = grid.y.n_cells, n_r = grid.r.n_cells;
    // Net flux out of the domain, its scale, and the area of outflow sides,
    // all over 2 pi.
    std::vector<double> sums(3, 0.);
    const auto add = [&](const Side side, const double area, const double v) {
      sums[0] += area * v;
      sums[1] += area * std::abs(v);
      if (sides[side].kind == SideKind::outflow)
        sums[2] += area;
    };
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      {
        const double area = grid.r.centre[i] * grid.r.width[i];
        add(lower, area, -velocity.y(i, 0));
        add(upper, area, velocity.y(i, n_y));
      }
    if (grid.is_last_rank())
      for (int j = 0; j < n_y; ++j)
        add(outer, grid.r.face[n_r] * grid.y.width[j], velocity.r(n_r, j));
    mpi::sum_in_place(sums, grid.communicator());

    if (sums[2] == 0)
      {
        EphyraThrowIf(
          std::abs(sums[0]) > 1e-8 * sums[1],
          InputError,
          "The velocities given on the sides of the flow domain let "
            << 2 * M_PI * std::abs(sums[0]) << " m^3/s more "
            << (sums[0] < 0 ? "in than out" : "out than in")
            << " at t = " << now
            << " s, and an incompressible flow cannot store it: make "
               "one side \"outflow\" or \"pressure\", or balance "
               "the formulas.");
        return;
      }
    const double correction = -sums[0] / sums[2];
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      {
        if (sides[lower].kind == SideKind::outflow)
          velocity.y(i, 0) -= correction;
        if (sides[upper].kind == SideKind::outflow)
          velocity.y(i, n_y) += correction;
      }
    if (grid.is_last_rank() && sides[outer].kind == SideKind::outflow)
      for (int j = 0; j < n_y; ++j)
        velocity.r(n_r, j) += correction;
  }

  void
  Boundary::fill_ghosts(VelocityField &velocity) const
  {
    const int n_y = grid.y.n_cells, n_r = grid.r.n_cells;
    const int begin = std::max(0, grid.first_row - halo);
    const int end   = std::min(n_r, grid.end_row() + halo);

    for (int i = begin; i < end; ++i)
      {
        double *const u = velocity.r.row(i);
        double *const w = velocity.y.row(i);
        if (grid.periodic_y)
          {
            for (double *const a : {u, w})
              {
                a[-1]      = a[n_y - 1];
                a[-2]      = a[n_y - 2];
                a[n_y]     = a[0];
                a[n_y + 1] = a[1];
              }
            continue;
          }
        const auto ghost = [&](const Side side, const double inside) {
          return fixes_tangential(side)
                   ? 2 * sides[side].radial_values[slot(i)] - inside
                   : inside;
        };
        u[-1]      = ghost(lower, u[0]);
        u[-2]      = ghost(lower, u[1]);
        u[n_y]     = ghost(upper, u[n_y - 1]);
        u[n_y + 1] = ghost(upper, u[n_y - 2]);
        if (is_wall(sides[lower].kind))
          {
            w[-1] = 2 * w[0] - w[1];
            w[-2] = 2 * w[0] - w[2];
          }
        else
          w[-1] = w[-2] = w[0];
        w[n_y + 1] =
          is_wall(sides[upper].kind) ? 2 * w[n_y] - w[n_y - 1] : w[n_y];
      }

    if (grid.is_first_rank())
      for (int j = -halo; j < n_y + halo; ++j)
        {
          velocity.r(0, j)  = 0;
          velocity.r(-1, j) = -velocity.r(1, j);
          velocity.r(-2, j) = -velocity.r(2, j);
          velocity.y(-1, j) = velocity.y(0, j);
          velocity.y(-2, j) = velocity.y(1, j);
        }
    if (!grid.is_last_rank())
      return;

    double *const normal = velocity.r.row(n_r);
    for (int k = 1; k <= halo; ++k)
      {
        normal[-k]          = grid.periodic_y ? normal[n_y - k] : normal[k - 1];
        normal[n_y + k - 1] = grid.periodic_y ? normal[k - 1] : normal[n_y - k];
      }
    const double r_ratio =
      grid.r.face[n_r] / (grid.r.face[n_r] + grid.r.width[n_r - 1]);
    for (int j = -halo; j < n_y + halo; ++j)
      {
        velocity.r(n_r + 1, j) = is_wall(sides[outer].kind)
                                   ? 2 * normal[j] - velocity.r(n_r - 1, j)
                                   : r_ratio * normal[j];
        if (fixes_tangential(outer))
          {
            const double given =
              sides[outer].axial_values[std::clamp(j, 0, n_y)];
            velocity.y(n_r, j)     = 2 * given - velocity.y(n_r - 1, j);
            velocity.y(n_r + 1, j) = 2 * given - velocity.y(n_r - 2, j);
          }
        else
          {
            velocity.y(n_r, j)     = velocity.y(n_r - 1, j);
            velocity.y(n_r + 1, j) = velocity.y(n_r - 2, j);
          }
      }
  }

  void
  Boundary::fill_pressure_ghosts(DistributedArray &pressure) const
  {
    fill_scalar_ghosts(pressure, false);
  }

  void
  Boundary::fill_correction_ghosts(DistributedArray &phi) const
  {
    fill_scalar_ghosts(phi, true);
  }

  void
  Boundary::fill_correction_ghosts(double *const row) const
  {
    const int n_y = grid.y.n_cells;
    if (grid.periodic_y)
      {
        row[-1]  = row[n_y - 1];
        row[n_y] = row[0];
        return;
      }
    row[-1] = sides[lower].kind == SideKind::pressure ? -row[0] : row[0];
    row[n_y] =
      sides[upper].kind == SideKind::pressure ? -row[n_y - 1] : row[n_y - 1];
  }

  void
  Boundary::fill_scalar_ghosts(DistributedArray &field,
                               const bool        homogeneous) const
  {
    const int n_y = grid.y.n_cells, n_r = grid.r.n_cells;
    const int begin = std::max(0, grid.first_row - halo);
    const int end   = std::min(n_r, grid.end_row() + halo);
    // The value on a side where it is given, else the mirrored one.
    const auto ghost =
      [&](const Side side, const std::size_t k, const double inside) {
        if (sides[side].kind != SideKind::pressure)
          return inside;
        return (homogeneous ? 0. : 2 * sides[side].pressure_values[k]) - inside;
      };
    for (int i = begin; i < end; ++i)
      {
        double *const a = field.row(i);
        if (grid.periodic_y)
          {
            a[-1]      = a[n_y - 1];
            a[-2]      = a[n_y - 2];
            a[n_y]     = a[0];
            a[n_y + 1] = a[1];
            continue;
          }
        a[-1]      = ghost(lower, slot(i), a[0]);
        a[-2]      = ghost(lower, slot(i), a[1]);
        a[n_y]     = ghost(upper, slot(i), a[n_y - 1]);
        a[n_y + 1] = ghost(upper, slot(i), a[n_y - 2]);
      }
    for (int j = -halo; j < n_y + halo; ++j)
      {
        if (grid.is_first_rank())
          {
            field(-1, j) = field(0, j);
            field(-2, j) = field(1, j);
          }
        if (grid.is_last_rank())
          {
            const std::size_t k = std::clamp(j, 0, n_y - 1);
            field(n_r, j)       = ghost(outer, k, field(n_r - 1, j));
            field(n_r + 1, j)   = ghost(outer, k, field(n_r - 2, j));
          }
      }
  }
} // namespace ephyra::fluid
