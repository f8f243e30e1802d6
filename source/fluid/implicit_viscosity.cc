#include "ephyra/fluid/implicit_viscosity.h"

#include <algorithm>

namespace ephyra::fluid
{
  ImplicitViscosity::ImplicitViscosity(const FlowParameters &parameters,
                                       const StaggeredGrid  &grid,
                                       const Boundary       &boundary,
                                       const Momentum       &momentum)
    : grid(grid)
    , boundary(boundary)
    , momentum(momentum)
    , nu(parameters.kinematic_viscosity())
  {
  }

  RowTridiagonal::Rows
  ImplicitViscosity::radial_rows(const double a,
                                 const int    first,
                                 const int    end) const
  {
    RowTridiagonal::Rows rows;
    rows.first = grid.first_row;
    if (first == 0) // the axis, where v_r = 0
      {
        rows.lower.push_back(0.);
        rows.diagonal.push_back(1.);
        rows.upper.push_back(0.);
      }
    for (int i = std::max(1, first); i < end; ++i)
      {
        const ViscousStencil stencil = radial_stencil_of_v_r(grid, i);
        double               centre  = stencil.centre;
        if (i == grid.r.n_cells) // open side: r v_r does not change beyond
          centre -= stencil.plus * grid.r.face[i] /
                    (grid.r.face[i] + grid.r.width[i - 1]);
        rows.lower.push_back(-a * stencil.minus);
        rows.diagonal.push_back(1 + a * centre);
        rows.upper.push_back(-a * stencil.plus);
      }
    rows.weight.assign(rows.diagonal.size(), 0.);
    return rows;
  }

  RowTridiagonal::Rows
  ImplicitViscosity::axial_rows(const double a,
                                const int    first,
                                const int    end) const
  {
    RowTridiagonal::Rows rows;
    rows.first = grid.first_row;
    for (int i = first; i < end; ++i)
      {
        const ViscousStencil stencil = radial_stencil_of_v_y(grid, i);
        double               centre  = stencil.centre;
        if (i == grid.r.n_cells - 1)
          centre += boundary.fixes_tangential(Boundary::outer) ? stencil.plus
                                                               : -stencil.plus;
        rows.lower.push_back(-a * stencil.minus);
        rows.diagonal.push_back(1 + a * centre);
        rows.upper.push_back(-a * stencil.plus);
      }
    rows.weight.assign(rows.diagonal.size(), 0.);
    return rows;
  }

  ColumnTridiagonal
  ImplicitViscosity::radial_columns(const double a) const
  {
    const int           n = grid.y.n_cells;
    std::vector<double> lower(n), diagonal(n), upper(n);
    for (int j = 0; j < n; ++j)
      {
        lower[j]    = -a * momentum.cell_down[j];
        upper[j]    = -a * momentum.cell_up[j];
        diagonal[j] = 1 - lower[j] - upper[j];
      }
    if (!grid.periodic_y)
      {
        const auto mirror = [&](const Boundary::Side side) {
          return boundary.fixes_tangential(side) ? -1. : 1.;
        };
        diagonal.front() += mirror(Boundary::lower) * lower.front();
        diagonal.back() += mirror(Boundary::upper) * upper.back();
      }
    return {lower, diagonal, upper, grid.periodic_y};
  }

  ColumnTridiagonal
  ImplicitViscosity::axial_columns(const double a) const
  {
    std::vector<double> lower, diagonal, upper;
    for (int j = boundary.first_y_face(); j < boundary.end_y_face(); ++j)
      {
        lower.push_back(-a * momentum.face_down[j]);
        upper.push_back(-a * momentum.face_up[j]);
        diagonal.push_back(1 - lower.back() - upper.back());
      }
    return {lower, diagonal, upper, grid.periodic_y};
  }

  ImplicitViscosity::Factors &
  ImplicitViscosity::factors(const double step)
  {
    for (const std::unique_ptr<Factors> &f : cache)
      if (f->step == step)
        return *f;
    if (cache.size() == 3) // one for each Runge-Kutta substep
      cache.clear();
    const double              a = 0.5 * step * nu;
    const std::vector<double> one_matrix{0.};
    const int      n_faces = boundary.end_y_face() - boundary.first_y_face();
    const MPI_Comm comm    = grid.communicator();
    cache.push_back(std::make_unique<Factors>(Factors{
      step,
      RowTridiagonal(radial_rows(a, grid.first_row, boundary.end_r_face()),
                     one_matrix,
                     grid.y.n_cells,
                     false,
                     comm),
      RowTridiagonal(axial_rows(a, grid.first_row, grid.end_row()),
                     one_matrix,
                     n_faces,
                     false,
                     comm),
      radial_columns(a),
      axial_columns(a)}));
    return *cache.back();
  }

  void
  ImplicitViscosity::solve_along_r(Factors             &matrices,
                                   const double         a,
                                   const VelocityField *old,
                                   VelocityField       &field)
  {
    const int n_r = grid.r.n_cells, n_y = grid.y.n_cells;
    const int first = boundary.first_y_face(), end = boundary.end_y_face();
    if (old != nullptr && grid.is_last_rank())
      {
        if (boundary.end_r_face() == n_r) // v_r given on the outer side
          {
            const double plus = radial_stencil_of_v_r(grid, n_r - 1).plus;
            for (int j = 0; j < n_y; ++j)
              field.r(n_r - 1, j) +=
                a * plus * (field.r(n_r, j) - old->r(n_r, j));
          }
        if (boundary.fixes_tangential(Boundary::outer))
          {
            const double plus = radial_stencil_of_v_y(grid, n_r - 1).plus;
            for (int j = first; j < end; ++j)
              field.y(n_r - 1, j) +=
                a * plus *
                (2 * boundary.tangential(Boundary::outer, j) -
                 (old->y(n_r, j) + old->y(n_r - 1, j)));
          }
      }
    if (grid.is_first_rank())
      std::fill(field.r.row(0), field.r.row(0) + n_y, 0.);
    matrices.radial_r.solve([&](const int i) { return field.r.row(i); });
    matrices.axial_r.solve([&](const int i) { return field.y.row(i) + first; });
  }

  void
  ImplicitViscosity::solve_along_y(Factors             &matrices,
                                   const double         a,
                                   const VelocityField *old,
                                   VelocityField       &field)
  {
    constexpr int block = ColumnTridiagonal::block;
    const int     n_y   = grid.y.n_cells;
    double       *rows[block];

    for (int i0 = boundary.first_r_face(); i0 < boundary.end_r_face();
         i0 += block)
      {
        const int n = std::min(block, boundary.end_r_face() - i0);
        for (int k = 0; k < n; ++k)
          {
            const int     i = i0 + k;
            double *const f = field.r.row(i);
            if (old != nullptr && i < grid.r.n_cells &&
                boundary.fixes_tangential(Boundary::lower))
              f[0] += a * momentum.cell_down[0] *
                      (2 * boundary.tangential(Boundary::lower, i) -
                       (old->r(i, -1) + old->r(i, 0)));
            if (old != nullptr && i < grid.r.n_cells &&
                boundary.fixes_tangential(Boundary::upper))
              f[n_y - 1] += a * momentum.cell_up[n_y - 1] *
                            (2 * boundary.tangential(Boundary::upper, i) -
                             (old->r(i, n_y) + old->r(i, n_y - 1)));
            rows[k] = f;
          }
        matrices.radial_y.solve(rows, n);
      }

    const int first = boundary.first_y_face(), end = boundary.end_y_face();
    for (int i0 = grid.first_row; i0 < grid.end_row(); i0 += block)
      {
        const int n = std::min(block, grid.end_row() - i0);
        for (int k = 0; k < n; ++k)
          {
            const int     i = i0 + k;
            double *const f = field.y.row(i);
            if (old != nullptr && first == 1)
              f[1] += a * momentum.face_down[1] * (f[0] - old->y(i, 0));
            if (old != nullptr && end == n_y && !grid.periodic_y)
              f[n_y - 1] +=
                a * momentum.face_up[n_y - 1] * (f[n_y] - old->y(i, n_y));
            rows[k] = f + first;
          }
        matrices.axial_y.solve(rows, n);
      }
  }

  void
  ImplicitViscosity::solve(const double              step,
                           const ImplicitDirections &directions,
                           const VelocityField      &old,
                           VelocityField            &field)
  {
    Factors     &matrices = factors(step);
    const double a        = 0.5 * step * nu;
    if (directions.r)
      solve_along_r(matrices, a, &old, field);
    if (directions.y)
      solve_along_y(matrices, a, &old, field);

    for (int i = boundary.first_r_face(); i < boundary.end_r_face(); ++i)
      for (int j = 0; j < grid.y.n_cells; ++j)
        field.r(i, j) += old.r(i, j);
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      for (int j = boundary.first_y_face(); j < boundary.end_y_face(); ++j)
        field.y(i, j) += old.y(i, j);
  }

  void
  ImplicitViscosity::spread_out(const double              step,
                                const ImplicitDirections &directions,
                                VelocityField            &increment)
  {
    Factors     &matrices = factors(step);
    const double a        = 0.5 * step * nu;
    if (directions.r)
      solve_along_r(matrices, a, nullptr, increment);
    if (directions.y)
      solve_along_y(matrices, a, nullptr, increment);
  }

  std::vector<double>
  ImplicitViscosity::line_response(const double            step,
                                   const int               component,
                                   const bool              along_r,
                                   const std::vector<int> &nodes) const
  {
    const double a      = 0.5 * step * nu;
    const int    n_r    = grid.r.n_cells;
    int          first  = 0; // node of the first unknown
    const auto   matrix = [&]() {
      if (!along_r)
        {
          first = component == 0 ? 0 : boundary.first_y_face();
          return component == 0 ? radial_columns(a) : axial_columns(a);
        }
      const int end = component == 1 ? n_r : n_r + boundary.opens_outer_side();
      const RowTridiagonal::Rows rows =
        component == 0 ? radial_rows(a, 0, end) : axial_rows(a, 0, end);
      return ColumnTridiagonal(rows.lower, rows.diagonal, rows.upper, false);
    };
    ColumnTridiagonal   line = matrix();
    const int           n    = static_cast<int>(nodes.size());
    std::vector<double> result(static_cast<std::size_t>(n) * n, 0.);
    const auto          inside = [&](const int node) {
      return node >= first && node < first + line.size();
    };
    constexpr int       block = ColumnTridiagonal::block;
    std::vector<double> unit(static_cast<std::size_t>(block) * line.size());
    double             *row[block];
    for (int m0 = 0; m0 < n; m0 += block)
      {
        const int n_rows = std::min(block, n - m0);
        std::fill(unit.begin(), unit.end(), 0.);
        for (int m = 0; m < n_rows; ++m)
          {
            row[m] = unit.data() + static_cast<std::size_t>(m) * line.size();
            if (inside(nodes[m0 + m]))
              row[m][nodes[m0 + m] - first] = 1.;
          }
        line.solve(row, n_rows);
        for (int m = 0; m < n_rows; ++m)
          for (int k = 0; k < n; ++k)
            if (inside(nodes[k]))
              result[static_cast<std::size_t>(k) * n + m0 + m] =
                row[m][nodes[k] - first];
      }
    return result;
  }
} // namespace ephyra::fluid
