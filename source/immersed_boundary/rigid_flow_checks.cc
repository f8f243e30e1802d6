// What a flow around rigid bodies says about itself: loads, slip, statistics,
// and whether the bodies are where they may be.
#include "ephyra/base/exceptions.h"
#include "ephyra/immersed_boundary/rigid_flow.h"

#include <cmath>
#include <limits>
#include <sstream>

namespace ephyra::immersed_boundary
{
  void
  RigidFlow::check_start() const
  {
    const std::string reason = end_reason();
    EphyraThrowIf(!reason.empty(),
                  InputError,
                  "At the start, " << reason
                                   << ": move the body or refine the grid.");
    // A marker that lies behind the nearest marker of another body is in it.
    const MarkerState &m     = the_markers->state();
    const auto        &first = the_markers->first_of_curve();
    for (int a = 0; a < n_bodies(); ++a)
      for (int b = 0; b < n_bodies(); ++b)
        for (int l = first[first_curve[a]]; l < first[first_curve[a + 1]]; ++l)
          {
            double nearest = std::numeric_limits<double>::max(), side = 1;
            for (int k = first[first_curve[b]];
                 a != b && k < first[first_curve[b + 1]];
                 ++k)
              {
                const double d_r = m.r[l] - m.r[k], d_y = m.y[l] - m.y[k];
                if (const double d = d_r * d_r + d_y * d_y; d < nearest)
                  {
                    nearest = d;
                    side    = d_r * m.n_r[k] + d_y * m.n_y[k];
                  }
              }
            EphyraThrowIf(side < 0,
                          InputError,
                          "The bodies '"
                            << bodies[a]->parameters.name << "' and '"
                            << bodies[b]->parameters.name
                            << "' overlap at (r, y) = (" << m.r[l] << ", "
                            << m.y[l] << ") m at the start: move them apart.");
          }
  }

  const SurfaceLoads &
  RigidFlow::loads()
  {
    surface_loads.update(*the_markers);
    surface_loads.evaluate(*the_markers, flow.pressure(), flow.velocity());
    return surface_loads;
  }

  RigidFlow::NoSlip
  RigidFlow::no_slip_error()
  {
    const MarkerState &m = the_markers->state();
    const int          n = the_markers->size();
    forcing.update(*the_markers);
    std::vector<double> u;
    forcing.interpolate(flow.velocity(), u);
    NoSlip error;
    double area = 0;
    for (int l = 0; l < n; ++l)
      {
        const double dA  = 2 * M_PI * m.r[l] * m.length[l];
        const double d_r = u[l] - m.v_r[l], d_y = u[n + l] - m.v_y[l];
        area += dA;
        error.slip += dA * (d_r * d_r + d_y * d_y);
        error.leakage += dA * std::abs(d_r * m.n_r[l] + d_y * m.n_y[l]);
      }
    error.slip = std::sqrt(error.slip / area);
    error.leakage /= area;
    return error;
  }

  std::string
  RigidFlow::end_reason() const
  {
    const fluid::StaggeredGrid &grid = flow.grid();
    const MarkerState          &m    = the_markers->state();
    for (int l = 0; l < the_markers->size(); ++l)
      if (m.r[l] > grid.r.centre.back() ||
          (!grid.periodic_y &&
           (m.y[l] < grid.y.centre.front() || m.y[l] > grid.y.centre.back())))
        {
          std::ostringstream text;
          text << "body '" << the_markers->curves()[the_markers->curve(l)].name
               << "' has come within half a cell of the wall at (r, y) = ("
               << m.r[l] << ", " << m.y[l] << ") m";
          return text.str();
        }
    return "";
  }

  void
  RigidFlow::evaluate(Record &record)
  {
    loads();
    for (int b = 0; b < n_bodies(); ++b)
      {
        const RigidBody   &body   = *bodies[b];
        const std::string &name   = body.parameters.name;
        const auto         probes = surface_loads.axial_force(
          *the_markers, first_curve[b], first_curve[b + 1]);
        record.add(name + " y [m]", body.position);
        record.add(name + " velocity y [m/s]", body.velocity);
        record.add(name + " acceleration y [m/s^2]", body.acceleration);
        record.add(name + " force y by forcing [N]", force[b]);
        record.add(name + " force y by probes [N]", probes.total());
        record.add(name + " pressure force y by probes [N]", probes.pressure);
        record.add(name + " friction force y by probes [N]", probes.friction);
        if (body.parameters.reference_velocity > 0)
          {
            const double unit =
              0.5 * flow.density() * body.parameters.reference_velocity *
              body.parameters.reference_velocity * body.reference_area;
            record.add(name + " drag coefficient by forcing [-]",
                       force[b] / unit);
            record.add(name + " drag coefficient by probes [-]",
                       probes.total() / unit);
          }
      }
    const NoSlip error = no_slip_error();
    record.add("slip [m/s]", error.slip);
    record.add("leakage [m/s]", error.leakage);
    record.add("projections [-]", projections);
  }
} // namespace ephyra::immersed_boundary
