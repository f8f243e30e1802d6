// What a flow around rigid bodies says about itself: loads, slip, statistics,
// and whether the bodies are where they may be.
#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"
#include "ephyra/immersed_boundary/rigid_flow.h"

#include <algorithm>
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
  RigidFlow::mean_error(const std::vector<double> &u,
                        const std::vector<char>   &used) const
  {
    const MarkerState &m = the_markers->state();
    const int          n = the_markers->size();
    NoSlip             error;
    double             area = 0;
    for (int l = 0; l < n; ++l)
      if (used[l])
        {
          const double dA  = 2 * M_PI * m.r[l] * m.length[l];
          const double d_r = u[l] - m.v_r[l], d_y = u[n + l] - m.v_y[l];
          area += dA;
          error.slip += dA * (d_r * d_r + d_y * d_y);
          error.leakage += dA * std::abs(d_r * m.n_r[l] + d_y * m.n_y[l]);
        }
    if (area > 0)
      {
        error.slip = std::sqrt(error.slip / area);
        error.leakage /= area;
      }
    return error;
  }

  RigidFlow::NoSlip
  RigidFlow::no_slip_error()
  {
    forcing.update(*the_markers);
    std::vector<double> u;
    forcing.interpolate(flow.velocity(), u);
    return mean_error(u, std::vector<char>(the_markers->size(), 1));
  }

  RigidFlow::NoSlip
  RigidFlow::no_slip_error_on_surface() const
  {
    using MLS = MovingLeastSquares;
    const MLS                   mls(flow.grid(), parameters);
    const fluid::StaggeredGrid &grid = flow.grid();
    const int                   end  = grid.end_row();
    const int           end_of_faces = end + (grid.is_last_rank() ? 1 : 0);
    const MarkerState  &m            = the_markers->state();
    const int           n            = the_markers->size();
    constexpr double    factor[3]    = {6., -8., 3.};
    constexpr double    cells[3]     = {1., 1.5, 2.};
    std::vector<double> u(2 * n, 0.);
    std::vector<char>   used(n, 1);
    for (int l = 0; l < n; ++l)
      {
        const double size = mls.cell_size(
          mls.r_centres(m.r[l]), mls.y_centres(m.y[l]), m.n_r[l], m.n_y[l]);
        for (int k = 0; k < 3; ++k)
          {
            const double r = m.r[l] + cells[k] * size * m.n_r[l];
            const double y = m.y[l] + cells[k] * size * m.n_y[l];
            if (!mls.contains(r, y))
              {
                used[l] = 0;
                break;
              }
            u[l] += factor[k] *
                    MLS::value(mls.r_faces(r), mls.y_centres(y))
                      .apply(flow.velocity().r, grid.first_row, end_of_faces);
            u[n + l] +=
              factor[k] * MLS::value(mls.r_centres(r), mls.y_faces(y))
                            .apply(flow.velocity().y, grid.first_row, end);
          }
      }
    mpi::sum_in_place(u, grid.communicator());
    return mean_error(u, used);
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

  SurfaceProfile
  RigidFlow::surface_profile(const int b)
  {
    return immersed_boundary::surface_profile(
      *the_markers, loads(), first_curve[b], first_curve[b + 1]);
  }

  void
  RigidFlow::evaluate_wake(const int b, Record &record) const
  {
    const RigidBody &body = *bodies[b];
    if (body.parameters.wake == RigidBody::Wake::none)
      return;
    const double direction =
      body.parameters.wake == RigidBody::Wake::above ? 1. : -1.;
    const std::string &name = body.parameters.name;
    // The markers at the ends are half an arc away from the poles.
    double rear = -std::numeric_limits<double>::max();
    for (int l = the_markers->first_of_curve()[first_curve[b]];
         l < the_markers->first_of_curve()[first_curve[b + 1]];
         ++l)
      rear = std::max(rear, direction * the_markers->state().y[l]);
    const ReversedFlow flow_back =
      reversed_flow(flow.grid().y,
                    velocity_on_axis(flow.velocity()),
                    direction * rear,
                    direction,
                    body.velocity);
    record.add(name + " wake begin [m]", flow_back.begin);
    record.add(name + " wake end [m]", flow_back.end);
    for (const Separation &s : separation(
           body, first_curve[b], *the_markers, surface_loads, direction))
      record.add(name + " " + s.where + "separation angle [deg]", s.angle);
  }

  double
  RigidFlow::largest_step(const double t,
                          const double longest,
                          const double cfl_number) const
  {
    constexpr int          n_samples = 16;
    const MarkerState     &m         = the_markers->state();
    const auto            &first     = the_markers->first_of_curve();
    const fluid::GridLine &y         = flow.grid().y;
    double                 largest   = std::numeric_limits<double>::infinity();
    for (int b = 0; b < n_bodies(); ++b)
      {
        const RigidBody &body  = *bodies[b];
        double           width = y.length();
        for (int l = first[first_curve[b]]; l < first[first_curve[b + 1]]; ++l)
          width = std::min(
            width, y.width[std::clamp(y.cell_of(m.y[l]), 0, y.n_cells - 1)]);
        const double reach = cfl_number * width;
        double       speed = std::abs(body.velocity), acceleration = 0;
        if (body.is_free())
          {
            const double ratio = body.parameters.density / flow.density();
            acceleration       = t > 0 ? std::abs(body.acceleration)
                                       : std::abs((ratio - 1) / (ratio + 0.5) *
                                            body.parameters.gravity);
          }
        else
          for (int k = 0; k <= n_samples; ++k)
            speed =
              std::max(speed, std::abs(body.law(t + longest * k / n_samples)));
        largest = std::min(
          largest,
          2 * reach /
            (speed + std::sqrt(speed * speed + 4 * acceleration * reach)));
      }
    return largest;
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
        evaluate_wake(b, record);
      }
    const NoSlip error = no_slip_error();
    record.add("slip [m/s]", error.slip);
    record.add("leakage [m/s]", error.leakage);
    if (parameters.surface_slip)
      {
        const NoSlip outside = no_slip_error_on_surface();
        record.add("slip on the surface [m/s]", outside.slip);
        record.add("leakage on the surface [m/s]", outside.leakage);
      }
    record.add("projections [-]", projections);
  }
} // namespace ephyra::immersed_boundary
