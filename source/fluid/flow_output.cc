#include "ephyra/fluid/flow_output.h"

namespace ephyra::fluid
{
  namespace
  {
    double
    dv_r_dy(const VelocityField &velocity, const int i, const int j)
    {
      const StaggeredGrid &grid = velocity.grid();
      return (velocity.r(i, j) - velocity.r(i, j - 1)) /
             grid.y.mirrored_gap(j, grid.periodic_y);
    }

    double
    dv_y_dr(const VelocityField &velocity, const int i, const int j)
    {
      return (velocity.y(i, j) - velocity.y(i - 1, j)) /
             velocity.grid().r.mirrored_gap(i, false);
    }
  } // namespace

  double
  corner_vorticity(const VelocityField &velocity, const int i, const int j)
  {
    return i == 0 ? 0. : dv_r_dy(velocity, i, j) - dv_y_dr(velocity, i, j);
  }

  double
  corner_shear_rate(const VelocityField &velocity, const int i, const int j)
  {
    return i == 0 ? 0. : dv_r_dy(velocity, i, j) + dv_y_dr(velocity, i, j);
  }

  double
  cell_vorticity(const VelocityField &velocity, const int i, const int j)
  {
    return 0.25 * (corner_vorticity(velocity, i, j) +
                   corner_vorticity(velocity, i + 1, j) +
                   corner_vorticity(velocity, i, j + 1) +
                   corner_vorticity(velocity, i + 1, j + 1));
  }

  void
  write_flow(const VelocityField    &velocity,
             const DistributedArray &pressure,
             GridOutput             &output)
  {
    const StaggeredGrid &grid = velocity.grid();
    output.r_faces            = grid.r.face;
    output.y_faces            = grid.y.face;
    output.first_row          = grid.first_row;
    output.n_rows             = grid.n_rows;

    const int  n_y       = grid.y.n_cells;
    const auto add_field = [&](const char *name,
                               const int   n_components) -> GridField & {
      GridField field;
      field.name = name;
      field.components.assign(
        n_components,
        std::vector<double>(static_cast<std::size_t>(grid.n_rows) * n_y, 0.));
      output.fields.push_back(std::move(field));
      return output.fields.back();
    };
    const auto for_cells = [&](const auto &function) {
      std::size_t k = 0;
      for (int i = grid.first_row; i < grid.end_row(); ++i)
        for (int j = 0; j < n_y; ++j)
          function(k++, i, j);
    };
    GridField &v = add_field("velocity [m/s]", 3);
    for_cells([&](const std::size_t k, const int i, const int j) {
      v.components[0][k] = 0.5 * (velocity.r(i, j) + velocity.r(i + 1, j));
      v.components[1][k] = 0.5 * (velocity.y(i, j) + velocity.y(i, j + 1));
    });
    GridField &p = add_field("pressure [Pa]", 1);
    for_cells([&](const std::size_t k, const int i, const int j) {
      p.components[0][k] = pressure(i, j);
    });
    GridField &omega = add_field("vorticity [1/s]", 1);
    for_cells([&](const std::size_t k, const int i, const int j) {
      omega.components[0][k] = cell_vorticity(velocity, i, j);
    });
  }
} // namespace ephyra::fluid
