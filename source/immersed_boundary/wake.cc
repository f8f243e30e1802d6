#include "ephyra/immersed_boundary/wake.h"

#include "ephyra/base/mpi.h"

#include <cmath>

namespace ephyra::immersed_boundary
{
  namespace
  {
    /// Traction along the tangent of the curve at a marker, Pa.
    double
    friction_at(const Markers &markers, const SurfaceLoads &loads, const int l)
    {
      const MarkerState &m = markers.state();
      return loads.traction()[l] * m.t_r[l] +
             loads.traction()[markers.size() + l] * m.t_y[l];
    }

    /// Where the friction towards the front, @p upstream, given from the rear to
    /// the front, turns from positive (reversed) to negative; 180 where it does
    /// not.
    double
    angle_of_separation(const std::vector<double> &upstream,
                        const std::vector<double> &angle)
    {
      for (std::size_t k = 1; k < upstream.size(); ++k)
        if (upstream[k - 1] > 0 && upstream[k] <= 0)
          return angle[k - 1] + (angle[k] - angle[k - 1]) * upstream[k - 1] /
                                  (upstream[k - 1] - upstream[k]);
      return 180.;
    }
  } // namespace

  std::vector<double>
  velocity_on_axis(const fluid::VelocityField &velocity)
  {
    const fluid::StaggeredGrid &grid = velocity.grid();
    std::vector<double>         v(grid.y.n_cells + 1, 0.);
    if (grid.is_first_rank()) // holds two rows at least
      {
        const double a = std::pow(grid.r.centre[0], 2);
        const double b = std::pow(grid.r.centre[1], 2);
        for (int j = 0; j <= grid.y.n_cells; ++j)
          v[j] = (b * velocity.y(0, j) - a * velocity.y(1, j)) / (b - a);
      }
    mpi::sum_in_place(v, grid.communicator());
    return v;
  }

  ReversedFlow
  reversed_flow(const fluid::GridLine     &y,
                const std::vector<double> &velocity_on_axis,
                const double               rear,
                const double               direction,
                const double               body_velocity)
  {
    ReversedFlow result;
    const int    n     = y.n_cells;
    double       s_old = 0, u_old = 0; // distance and velocity downstream
    bool         started = false, reversed = false;
    for (int k = 0; k <= n; ++k)
      {
        const int    j    = direction > 0 ? k : n - k;
        const double s    = direction * (y.face[j] - rear);
        const double u    = direction * (velocity_on_axis[j] - body_velocity);
        const auto   zero = [&]() {
          return s_old + (s - s_old) * u_old / (u_old - u);
        };
        if (s < y.width[std::min(j, n - 1)])
          continue;
        if (!reversed && u < 0)
          {
            reversed     = true;
            result.begin = started ? zero() : 0.;
            result.end   = s;
          }
        else if (reversed && u >= 0)
          {
            result.end = zero();
            break;
          }
        else if (reversed)
          result.end = s;
        started = true;
        s_old   = s;
        u_old   = u;
      }
    return result;
  }

  std::vector<Separation>
  separation(const RigidBody    &body,
             const int           curve,
             const Markers      &markers,
             const SurfaceLoads &loads,
             const double        direction)
  {
    const std::string &shape = body.parameters.shape;
    const bool         torus = shape == "torus";
    if (!torus && shape != "sphere" && shape != "spheroid")
      return {};
    const MarkerState &m      = markers.state();
    const int          begin  = markers.first_of_curve()[curve];
    const int          n      = markers.first_of_curve()[curve + 1] - begin;
    const double       centre = torus ? body.parameters.ring_radius : 0.;

    int rear = begin;
    for (int l = begin; l < begin + n; ++l)
      if (direction * m.y[l] > direction * m.y[rear])
        rear = l;

    std::vector<Separation> result;
    for (const int step : {1, -1})
      {
        // Along the curve and against it, to the front of the body.
        std::vector<double> upstream, angle;
        for (int k = 0; k < n; ++k)
          {
            int l = rear + step * k;
            if (torus)
              l = begin + (l - begin + n) % n;
            else if (l < begin || l >= begin + n)
              break;
            const double height = direction * (m.y[l] - body.position);
            const double alpha = std::atan2(std::abs(m.r[l] - centre), -height);
            if (k > n / 2 && torus) // past the front
              break;
            upstream.push_back(step * friction_at(markers, loads, l));
            angle.push_back(alpha * 180. / M_PI);
          }
        if (!torus && upstream.size() < 2) // the rear is an end of the curve
          continue;
        const bool outer =
          torus &&
          m.r[begin + (rear - begin + step * (n / 4) + n) % n] > centre;
        result.push_back({torus ? (outer ? "outer " : "inner ") : "",
                          angle_of_separation(upstream, angle)});
      }
    return result;
  }

  SurfaceProfile
  surface_profile(const Markers      &markers,
                  const SurfaceLoads &loads,
                  const int           first_curve,
                  const int           last_curve)
  {
    SurfaceProfile result;
    double         arc = 0;
    for (int l = markers.first_of_curve()[first_curve];
         l < markers.first_of_curve()[last_curve];
         ++l)
      {
        const double length = markers.state().length[l];
        result.arc.push_back(arc + 0.5 * length);
        result.pressure.push_back(loads.wall_pressure()[l]);
        result.friction.push_back(friction_at(markers, loads, l));
        arc += length;
      }
    return result;
  }
} // namespace ephyra::immersed_boundary
