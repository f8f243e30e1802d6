#include "ephyra/fluid/energy_budget.h"

#include "ephyra/base/timer_tree.h"
#include "ephyra/fluid/flow_diagnostics.h"

#include <algorithm>
#include <cmath>

namespace ephyra::fluid
{
  namespace
  {
    /// Rows of the mean of two fields.
    class Mean
    {
    public:
      Mean(const DistributedArray &a, const DistributedArray &b)
        : a(a)
        , b(b)
      {
      }
      double
      operator()(const int i, const int j) const
      {
        return 0.5 * (a(i, j) + b(i, j));
      }
      /// @p values[j] for j in [-1, n].
      void
      row(const int i, const int n, double *const values) const
      {
        const double *const from = a.row(i), *const to = b.row(i);
#pragma GCC ivdep
        for (int j = -1; j <= n; ++j)
          values[j] = 0.5 * (from[j] + to[j]);
      }

    private:
      const DistributedArray &a, &b;
    };

    double
    square(const double x)
    {
      return x * x;
    }
  } // namespace

  EnergyBudget::EnergyBudget(const FlowParameters &parameters,
                             const StaggeredGrid  &grid,
                             const Boundary       &boundary)
    : grid(grid)
    , boundary(boundary)
    , density(parameters.density)
    , viscosity(parameters.viscosity)
    , convection(parameters.convection)
    , has_window(parameters.window.on())
    , has_body_force(!Expression(parameters.body_force, {"t"}).is_zero())
    , open_lower(parameters.lower.kind == SideKind::pressure)
    , open_upper(parameters.upper.kind == SideKind::pressure)
    , open_outer(parameters.outer.kind == SideKind::pressure)
  {
  }

  void
  EnergyBudget::start(const VelocityField &velocity)
  {
    start_energy = kinetic_energy(velocity, density);
  }

  void
  EnergyBudget::add_inside(const VelocityField &before,
                           const VelocityField &after,
                           Powers              &power) const
  {
    const GridLine &r = grid.r, &y = grid.y;
    const int       n = y.n_cells, n_r = r.n_cells;
    const int  first = boundary.first_y_face(), end = boundary.end_y_face();
    const Mean mean_r(before.r, after.r), mean_y(before.y, after.y);

    // Along y: gaps of v_r, half where a side lies between.
    AlignedVector inv_gap(n + 1), width(n), inv_width(n), gap(n + 1, 0.);
    for (int j = 0; j <= n; ++j)
      {
        inv_gap[j] = 1. / y.mirrored_gap(j, grid.periodic_y);
        if (!grid.periodic_y && (j == 0 || j == n))
          inv_gap[j] *= 0.5;
        if (j >= first && j < end)
          gap[j] = y.centre_gap[j];
      }
    if (grid.periodic_y)
      inv_gap[n] = 0.; // the seam counts once
    for (int j = 0; j < n; ++j)
      {
        width[j]     = y.width[j];
        inv_width[j] = 1. / y.width[j];
      }

    std::vector<AlignedVector> rows(4, AlignedVector(n + 2));
    double *u = rows[0].data() + 1, *u_above = rows[1].data() + 1,
           *w_below = rows[2].data() + 1, *w = rows[3].data() + 1;
    mean_r.row(grid.first_row, n, u);
    mean_y.row(grid.first_row - 1, n, w_below);
    double along_r = 0, along_y = 0, axial = 0;
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      {
        mean_r.row(i + 1, n, u_above);
        mean_y.row(i, n, w);
        const double r_c = r.face[i], r_p = r.face[i + 1];
        const double area    = r.centre[i] * r.width[i];
        const double ring    = i > 0 ? r_c / r.mirrored_gap(i, false) : 0.;
        const double side    = i > 0 ? r_c * r.centre_gap[i] : 0.;
        double       cells_r = 0, cells_y = 0, corners_r = 0, corners_y = 0;
        double       flux = 0;
#pragma GCC ivdep
        for (int j = 0; j < n; ++j)
          {
            cells_r += width[j] * square(r_p * u_above[j] - r_c * u[j]);
            cells_y += inv_width[j] * square(w[j + 1] - w[j]);
          }
#pragma GCC ivdep
        for (int j = 0; j <= n; ++j)
          {
            corners_r += gap[j] * square(w[j] - w_below[j]);
            corners_y += inv_gap[j] * square(u[j] - u[j - 1]);
            flux += gap[j] * w[j];
          }
        along_r += cells_r / area + ring * corners_r;
        along_y += cells_y * area + side * corners_y;
        axial += area * flux;
        std::swap(u, u_above);
        std::swap(w, w_below);
      }
    if (grid.is_last_rank())
      {
        // The outer side: half of the gap is inside; v_r only where it is free.
        mean_y.row(n_r, n, w);
        const double ring = 0.5 * r.face[n_r] / r.mirrored_gap(n_r, false);
        const double half = open_outer ? r.face[n_r] * r.centre_gap[n_r] : 0.;
        for (int j = 0; j <= n; ++j)
          {
            along_r += ring * gap[j] * square(w[j] - w_below[j]);
            along_y += half * inv_gap[j] * square(u[j] - u[j - 1]);
          }
      }
    power.dissipation += viscosity * (along_r + along_y);
    power.body_force += axial;
  }

  void
  EnergyBudget::add_lower_or_upper(const bool           upper,
                                   const VelocityField &before,
                                   const VelocityField &after,
                                   const Pressure      &pressure,
                                   const double         step,
                                   Powers              &work) const
  {
    const GridLine &r = grid.r, &y = grid.y;
    const int       n    = y.n_cells;
    const int       face = upper ? n : 0, cell = upper ? n - 1 : 0;
    const int       inner = upper ? n - 1 : 1, ghost = upper ? n : -1;
    const bool      open = upper ? open_upper : open_lower;
    const double    sign = upper ? -1. : 1.; // of a flow into the domain
    const double    gap  = y.mirrored_gap(face, false);
    const Mean      mean_r(before.r, after.r), mean_y(before.y, after.y);

    double power = 0;
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      {
        const double area = r.centre[i] * r.width[i];
        const double w = mean_y(i, face), w_in = mean_y(i, inner);
        const auto   side = [&](const DistributedArray &p) {
          return 0.5 * (p(i, cell) + p(i, ghost));
        };
        work.sides += sign * area * w *
                      (pressure.time_of_start * side(pressure.start) +
                       pressure.time_of_correction * side(pressure.correction));
        if (open)
          power += convection ? sign * 0.5 * density * area * w * w * w : 0.;
        else
          {
            if (convection)
              power += sign * 0.25 * density * area * (w + w_in) * w * w_in;
            power -= viscosity * area * w * (w_in - w) / y.width[cell];
            // This velocity is given: what it changes is done by the side.
            work.sides +=
              0.5 * density * area * y.centre_gap[face] *
              (square(after.y(i, face)) - square(before.y(i, face)));
          }
        if (i == 0)
          continue;
        const double area_below = r.centre[i - 1] * r.width[i - 1];
        const double u = mean_r(i, cell), u_out = mean_r(i, ghost);
        if (convection)
          power += sign * 0.25 * density *
                   (area_below * mean_y(i - 1, face) + area * w) * u * u_out;
        power -= viscosity * r.face[i] * r.centre_gap[i] * 0.5 * (u + u_out) *
                 (u - u_out) / gap;
      }
    if (grid.is_last_rank() && open_outer)
      {
        const int    i = r.n_cells;
        const double u = mean_r(i, cell), u_out = mean_r(i, ghost);
        if (convection)
          power += sign * 0.25 * density * r.centre[i - 1] * r.width[i - 1] *
                   mean_y(i - 1, face) * u * u_out;
        power -= viscosity * r.face[i] * r.centre_gap[i] * 0.5 * (u + u_out) *
                 (u - u_out) / gap;
      }
    work.sides += step * power;
  }

  void
  EnergyBudget::add_outer(const VelocityField &before,
                          const VelocityField &after,
                          const Pressure      &pressure,
                          const double         step,
                          Powers              &work) const
  {
    const GridLine &r = grid.r, &y = grid.y;
    const int       n = y.n_cells, i = r.n_cells;
    const double    R = r.face[i], r_in = r.face[i - 1];
    const double    area = r.centre[i - 1] * r.width[i - 1];
    const double    gap  = r.mirrored_gap(i, false);
    const Mean      mean_r(before.r, after.r), mean_y(before.y, after.y);

    double power = 0;
    for (int j = 0; j < n; ++j)
      {
        const double u    = mean_r(i, j);
        const auto   side = [&](const DistributedArray &p) {
          return 0.5 * (p(i - 1, j) + p(i, j));
        };
        work.sides -= R * y.width[j] * u *
                      (pressure.time_of_start * side(pressure.start) +
                       pressure.time_of_correction * side(pressure.correction));
        if (open_outer)
          {
            if (convection)
              power -=
                0.5 * density * y.width[j] * R * u * u * mean_r(i + 1, j);
            continue;
          }
        const double u_in = mean_r(i - 1, j);
        if (convection)
          power -=
            0.25 * density * y.width[j] * (R * u + r_in * u_in) * u * u_in;
        power += viscosity * y.width[j] * R * u * (R * u - r_in * u_in) / area;
        work.sides += 0.5 * density * R * r.centre_gap[i] * y.width[j] *
                      (square(after.r(i, j)) - square(before.r(i, j)));
      }
    for (int j = boundary.first_y_face(); j < boundary.end_y_face(); ++j)
      {
        const double w = mean_y(i - 1, j), w_out = mean_y(i, j);
        const double below =
          j > 0 || grid.periodic_y
            ? y.width[j > 0 ? j - 1 : n - 1] * mean_r(i, j > 0 ? j - 1 : n - 1)
            : 0.;
        const double above = j < n ? y.width[j] * mean_r(i, j) : 0.;
        if (convection)
          power -= 0.25 * density * R * (below + above) * w * w_out;
        power += viscosity * y.centre_gap[j] * R * 0.5 * (w + w_out) *
                 (w_out - w) / gap;
      }
    work.sides += step * power;
  }

  void
  EnergyBudget::add_stage(const VelocityField &before,
                          const VelocityField &after,
                          const Pressure      &pressure,
                          const double         step,
                          const double         body_force)
  {
    const TimerTree::Scope scope(timer(), "energy of flow");
    Powers                 power, work;
    add_inside(before, after, power);
    if (!grid.periodic_y)
      for (const bool upper : {false, true})
        add_lower_or_upper(upper, before, after, pressure, step, work);
    if (grid.is_last_rank())
      add_outer(before, after, pressure, step, work);

    std::vector<double> sums{step * power.dissipation,
                             work.sides,
                             step * body_force * power.body_force};
    mpi::sum_in_place(sums, grid.communicator());
    dissipation += 2. * M_PI * sums[0];
    sides += 2. * M_PI * sums[1];
    body_force_work += 2. * M_PI * sums[2];
  }

  double
  EnergyBudget::evaluate(const VelocityField &velocity,
                         const bool           bodies,
                         Record              &record) const
  {
    const double kinetic   = kinetic_energy(velocity, density);
    const double imbalance = kinetic - start_energy - forcing + dissipation -
                             sides - body_force_work - window;
    record.add("kinetic energy of fluid [J]", kinetic);
    if (bodies)
      record.add("work of forcing [J]", forcing);
    record.add("viscous dissipation [J]", dissipation);
    record.add("work at sides [J]", sides);
    if (has_body_force)
      record.add("work of body force on fluid [J]", body_force_work);
    if (has_window)
      record.add("energy through window [J]", window);
    record.add("energy imbalance of fluid [J]", imbalance);
    return imbalance;
  }

  void
  EnergyBudget::serialize(Archive &archive, const bool with_window)
  {
    const Archive::Group group(archive, "energy");
    archive.value("start", start_energy);
    archive.value("forcing", forcing);
    archive.value("dissipation", dissipation);
    archive.value("sides", sides);
    archive.value("body force", body_force_work);
    if (with_window)
      archive.value("window", window);
  }
} // namespace ephyra::fluid
