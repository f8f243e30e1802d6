#pragma once

#include "ephyra/immersed_boundary/rigid_flow.h"

#include <boost/test/unit_test.hpp>

#include <memory>
#include <utility>
#include <vector>

namespace ephyra::test
{
  /// The automatic choices for rigid bodies.
  inline immersed_boundary::Parameters
  rigid_defaults()
  {
    immersed_boundary::Parameters p;
    p.weight         = immersed_boundary::WeightFunction::cubic_spline;
    p.forcing_solver = immersed_boundary::ForcingSolver::sweeps;
    p.wall_pressure  = immersed_boundary::WallPressure::linear;
    return p;
  }

  /// A flow with rigid bodies.
  struct RigidCase
  {
    RigidCase(
      const fluid::FlowParameters                                 &flow_in,
      const std::vector<immersed_boundary::RigidBody::Parameters> &bodies,
      const immersed_boundary::Parameters &parameters = rigid_defaults())
      : the_flow(std::make_unique<fluid::FlowSolver>(flow_in, MPI_COMM_WORLD))
      , flow(*the_flow)
    {
      std::vector<std::unique_ptr<immersed_boundary::RigidBody>> made;
      for (const auto &b : bodies)
        made.push_back(std::make_unique<immersed_boundary::RigidBody>(b));
      rigid = std::make_unique<immersed_boundary::RigidFlow>(
        flow, std::move(made), parameters);
    }

    void
    step(const double dt)
    {
      const StepStatus status = rigid->advance(time, dt);
      BOOST_REQUIRE_MESSAGE(status.success, status.reason);
      time += dt;
    }

    double
    force_by_probes()
    {
      return rigid->loads().axial_force(rigid->markers(), 0, 1).total();
    }

    std::unique_ptr<fluid::FlowSolver>            the_flow;
    fluid::FlowSolver                            &flow;
    std::unique_ptr<immersed_boundary::RigidFlow> rigid;
    double                                        time = 0;
  };

  /// Uniform stream U = 1 past a sphere of diameter 1 at the origin; fine cells
  /// of 1/n around it and in its wake, wider ones outside.
  inline fluid::FlowParameters
  stream(const double reynolds,
         const int    n,
         const double outer,
         const double upstream,
         const double downstream)
  {
    fluid::FlowParameters p;
    p.density            = 1.;
    p.viscosity          = 1. / reynolds;
    const double h       = 1. / n;
    p.grid.r.breakpoints = {0., 0.75, outer};
    p.grid.r.spacings    = {h, h, h + 0.12 * (outer - 0.75)};
    p.grid.y.breakpoints = {-upstream, -0.75, 1., downstream};
    p.grid.y.spacings    = {
         h + 0.12 * (upstream - 0.75), h, h, h + 0.06 * (downstream - 1.)};
    p.lower.kind             = fluid::SideKind::velocity;
    p.lower.axial_velocity   = "1";
    p.upper.kind             = fluid::SideKind::outflow;
    p.outer.kind             = fluid::SideKind::free_slip;
    p.initial_axial_velocity = "1";
    return p;
  }

  inline immersed_boundary::RigidBody::Parameters
  unit_sphere()
  {
    immersed_boundary::RigidBody::Parameters p;
    p.name               = "sphere";
    p.radius             = 0.5;
    p.reference_velocity = 1.;
    return p;
  }

  constexpr double unit_of_drag = 0.5 * M_PI * 0.25; ///< rho U^2 A / 2
} // namespace ephyra::test
