#include "ephyra/immersed_boundary/surface_loads.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/log.h"
#include "ephyra/base/mpi.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace ephyra::immersed_boundary
{
  namespace
  {
    constexpr int n_sums = 8; ///< two of the pressure, three of each velocity
    constexpr int largest_halves = 4;

    /// Finds whether a point lies just below some part of the surface: the
    /// nearest marker in the cells around it tells the side.
    class SideOfSurface
    {
    public:
      SideOfSurface(const Markers &markers, const fluid::StaggeredGrid &grid)
        : state(markers.state())
        , grid(grid)
      {
        for (int l = 0; l < markers.size(); ++l)
          markers_in_cell[number(state.r[l], state.y[l], 0, 0)].push_back(l);
      }

      bool
      inside(const double r, const double y) const
      {
        double nearest = 1e300, side = 1;
        for (int i = -1; i <= 1; ++i)
          for (int j = -1; j <= 1; ++j)
            {
              const auto cell = markers_in_cell.find(number(r, y, i, j));
              if (cell == markers_in_cell.end())
                continue;
              for (const int l : cell->second)
                {
                  const double dr = r - state.r[l], dy = y - state.y[l];
                  if (const double d = dr * dr + dy * dy; d < nearest)
                    {
                      nearest = d;
                      side    = dr * state.n_r[l] + dy * state.n_y[l];
                    }
                }
            }
        return side < 0;
      }

    private:
      std::int64_t
      number(const double r, const double y, const int i, const int j) const
      {
        return static_cast<std::int64_t>(grid.r.cell_of(r) + i) *
                 (grid.y.n_cells + 2) +
               grid.y.cell_of(y) + j;
      }

      const MarkerState                                 &state;
      const fluid::StaggeredGrid                        &grid;
      std::unordered_map<std::int64_t, std::vector<int>> markers_in_cell;
    };
  } // namespace

  SurfaceLoads::SurfaceLoads(const fluid::StaggeredGrid &grid,
                             const double                density,
                             const double                viscosity,
                             const Parameters           &parameters)
    : mls(grid, parameters)
    , density(density)
    , viscosity(viscosity)
    , parameters(parameters)
  {
  }

  void
  SurfaceLoads::update(const Markers &markers)
  {
    using Line            = MovingLeastSquares::Line;
    const MarkerState  &m = markers.state();
    const SideOfSurface side(markers, mls.grid());
    const auto          valid = [&](const double r, const double y) {
      return mls.contains(r, y) && !side.inside(r, y);
    };
    const int before = n_shortened;
    n_shortened      = 0;
    probes.resize(markers.size());
    for (int l = 0; l < markers.size(); ++l)
      {
        Probe       &probe = probes[l];
        const double n_r = m.n_r[l], n_y = m.n_y[l];
        probe.h =
          parameters.probe_length *
          mls.cell_size(mls.r_centres(m.r[l]), mls.y_centres(m.y[l]), n_r, n_y);
        int halves = 0;
        while (halves < largest_halves &&
               !valid(m.r[l] + probe.h * n_r, m.y[l] + probe.h * n_y))
          {
            probe.h *= 0.5;
            ++halves;
          }
        EphyraThrowIf(halves == largest_halves,
                      DivergedError,
                      "No probe fits in front of body '"
                        << markers.curves()[markers.curve(l)].name
                        << "' at (r, y) = (" << m.r[l] << ", " << m.y[l]
                        << ") m: it touches the end of the grid or another "
                           "body; end the run earlier or refine the grid.");
        n_shortened += halves > 0;

        for (int k = 0; k < 3; ++k)
          {
            const double distance = (k + 1) * probe.h;
            const double r        = m.r[l] + distance * n_r;
            const double y        = m.y[l] + distance * n_y;
            if (k > 0 && !valid(r, y))
              break;
            probe.n_points = k + 1;
            const Line rc = mls.r_centres(r), yc = mls.y_centres(y);
            const Line rf = mls.r_faces(r), yf = mls.y_faces(y);
            if (k < 2)
              probe.p[k] = MovingLeastSquares::value(rc, yc);
            if (parameters.friction != FrictionFormula::one_point)
              {
                probe.v[0][k] = MovingLeastSquares::value(rf, yc);
                probe.v[1][k] = MovingLeastSquares::value(rc, yf);
              }
            else if (k == 0)
              {
                probe.v[0] = {MovingLeastSquares::derivative_r(rf, yc),
                              MovingLeastSquares::derivative_y(rf, yc),
                              Stencil{}};
                probe.v[1] = {MovingLeastSquares::derivative_r(rc, yf),
                              MovingLeastSquares::derivative_y(rc, yf),
                              Stencil{}};
              }
          }
      }
    if (before == 0 && n_shortened > 0)
      log().warning(std::to_string(n_shortened) +
                    " load probes were shortened because they reached a body "
                    "or the end of the grid.");
  }

  void
  SurfaceLoads::evaluate(const Markers                 &markers,
                         const fluid::DistributedArray &pressure,
                         const fluid::VelocityField    &velocity)
  {
    const fluid::StaggeredGrid &grid  = mls.grid();
    const int                   n     = markers.size();
    const int                   begin = grid.first_row, end = grid.end_row();
    const int end_of_faces = end + (grid.is_last_rank() ? 1 : 0);
    sums.resize(n_sums * n);
    for (int l = 0; l < n; ++l)
      {
        double      *s      = sums.data() + n_sums * l;
        const Probe &probe  = probes[l];
        const bool gradient = parameters.friction == FrictionFormula::one_point;
        const int  n_v      = gradient ? 2 : probe.n_points;
        std::fill(s, s + n_sums, 0.);
        for (int k = 0; k < std::min(2, probe.n_points); ++k)
          s[k] = probe.p[k].apply(pressure, begin, end);
        for (int k = 0; k < n_v; ++k)
          {
            s[2 + k] = probe.v[0][k].apply(velocity.r, begin, end_of_faces);
            s[5 + k] = probe.v[1][k].apply(velocity.y, begin, end);
          }
      }
    mpi::sum_in_place(sums, grid.communicator());

    const MarkerState &m = markers.state();
    t.resize(2 * n);
    p_wall.resize(n);
    for (int l = 0; l < n; ++l)
      {
        const double *s   = sums.data() + n_sums * l;
        const double  h   = probes[l].h;
        const double  n_r = m.n_r[l], n_y = m.n_y[l];
        const int     points = probes[l].n_points;
        p_wall[l]            = s[0];
        if (points > 1 && parameters.wall_pressure == WallPressure::linear)
          p_wall[l] = 2 * s[0] - s[1];
        else if (parameters.wall_pressure != WallPressure::probe)
          p_wall[l] += density * h * (m.a_r[l] * n_r + m.a_y[l] * n_y);

        double L_rr = s[2], L_ry = s[3], L_yr = s[5], L_yy = s[6];
        if (parameters.friction != FrictionFormula::one_point)
          {
            const auto slope = [&](const double wall, const double *v) {
              if (points == 3 &&
                  parameters.friction == FrictionFormula::extrapolated)
                return (-5 * v[0] + 8 * v[1] - 3 * v[2]) / (2 * h);
              if (points >= 2)
                return (-3 * wall + 4 * v[0] - v[1]) / (2 * h);
              return (v[0] - wall) / h;
            };
            const double g_r = slope(m.v_r[l], s + 2);
            const double g_y = slope(m.v_y[l], s + 5);
            L_rr             = g_r * n_r + m.dv_r_ds[l] * m.t_r[l];
            L_ry             = g_r * n_y + m.dv_r_ds[l] * m.t_y[l];
            L_yr             = g_y * n_r + m.dv_y_ds[l] * m.t_r[l];
            L_yy             = g_y * n_y + m.dv_y_ds[l] * m.t_y[l];
          }
        const double shear = L_ry + L_yr;
        t[l] = -p_wall[l] * n_r + viscosity * (2 * L_rr * n_r + shear * n_y);
        t[n + l] =
          -p_wall[l] * n_y + viscosity * (shear * n_r + 2 * L_yy * n_y);
      }
  }

  std::vector<double>
  SurfaceLoads::marker_forces(const Markers &markers) const
  {
    const MarkerState  &m = markers.state();
    const int           n = markers.size();
    std::vector<double> force(2 * n);
    for (int l = 0; l < n; ++l)
      {
        const double area = 2 * M_PI * m.r[l] * m.length[l];
        force[l]          = t[l] * area;
        force[n + l]      = t[n + l] * area;
      }
    return force;
  }

  SurfaceLoads::AxialForce
  SurfaceLoads::axial_force(const Markers &markers,
                            const int      first_curve,
                            const int      last_curve) const
  {
    const MarkerState &m = markers.state();
    const int          n = markers.size();
    AxialForce         force;
    for (int l = markers.first_of_curve()[first_curve];
         l < markers.first_of_curve()[last_curve];
         ++l)
      {
        const double area     = 2 * M_PI * m.r[l] * m.length[l];
        const double pressure = -p_wall[l] * m.n_y[l];
        force.pressure += pressure * area;
        force.friction += (t[n + l] - pressure) * area;
      }
    return force;
  }
} // namespace ephyra::immersed_boundary
