#include "ephyra/fluid/flow_diagnostics.h"
#include "ephyra/fluid/flow_solver.h"
#include "record_value.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra;
using fluid::FlowParameters;
using fluid::FlowSolver;
using fluid::SideKind;
using fluid::TimeScheme;
using test::value;

namespace
{
  /// Stretched in both directions, with all terms of the equations.
  FlowParameters
  box()
  {
    FlowParameters parameters;
    parameters.density            = 1.3;
    parameters.viscosity          = 0.02;
    parameters.energy_budget      = true;
    parameters.grid.r.breakpoints = {0., 0.4, 1.};
    parameters.grid.r.spacings    = {0.08, 0.08, 0.15};
    parameters.grid.y.breakpoints = {0., 0.5, 1.};
    parameters.grid.y.spacings    = {0.12, 0.07, 0.1};
    return parameters;
  }

  struct Result
  {
    double imbalance, dissipation, sides, body_force, change;
  };

  Result
  run(const FlowParameters &parameters, const double dt, const int n_steps)
  {
    FlowSolver flow(parameters, MPI_COMM_WORLD);
    // Without any symmetry; it is made free of divergence.
    flow.set_initial_velocity(
      [](const double r, const double y) {
        return r * std::cos(2. * y + r) + 0.3 * r * std::sin(5. * y);
      },
      [](const double r, const double y) {
        return 0.6 + std::sin(3. * y) * std::cos(2. * r) + r * y;
      });
    const double before =
      fluid::kinetic_energy(flow.velocity(), parameters.density);
    for (int n = 0; n < n_steps; ++n)
      flow.advance(n * dt, dt);
    Record record;
    flow.energy()->evaluate(flow.velocity(), false, record);
    return {value(record, "energy imbalance of fluid [J]"),
            value(record, "viscous dissipation [J]"),
            value(record, "work at sides [J]"),
            parameters.body_force == "0"
              ? 0.
              : value(record, "work of body force on fluid [J]"),
            value(record, "kinetic energy of fluid [J]") - before};
  }

  /// The terms add up but for what the time scheme does: over one step, the
  /// first, of second order in it. A term that were wrong in space would leave
  /// first order.
  void
  check_first_step(const FlowParameters &parameters, const std::string &name)
  {
    BOOST_TEST_CONTEXT(name)
    {
      const double dt     = 2e-4;
      const Result coarse = run(parameters, dt, 1);
      const Result fine   = run(parameters, dt / 2, 1);
      BOOST_TEST(coarse.dissipation > 0.);
      BOOST_TEST(std::abs(coarse.imbalance) <
                 0.05 * (std::abs(coarse.change) + coarse.dissipation));
      BOOST_TEST(coarse.imbalance / fine.imbalance > 3.7);
    }
  }
} // namespace

BOOST_AUTO_TEST_CASE(every_side_with_every_time_scheme)
{
  const auto scheme = [](FlowParameters p, const int k) {
    p.scheme                = k == 0 ? TimeScheme::ab2 : TimeScheme::rk3;
    p.project_every_substep = k < 2;
    return p;
  };
  for (int k = 0; k < 2; ++k)
    {
      FlowParameters p = scheme(box(), k);
      check_first_step(p, "walls");

      p.outer.kind = p.upper.kind = SideKind::free_slip;
      check_first_step(p, "free slip");

      p            = scheme(box(), k);
      p.outer.kind = p.lower.kind = SideKind::velocity;
      p.outer.axial_velocity      = "0.7 + 0.2*s";
      p.outer.radial_velocity     = "0.1*sin(2*pi*s)";
      p.lower.axial_velocity      = "0.3 + s*(1 - s)";
      p.lower.radial_velocity     = "0.2*s*(1 - s)";
      p.upper.kind                = SideKind::outflow;
      check_first_step(p, "given velocities and an outflow");

      p                      = scheme(box(), k);
      p.upper.kind           = SideKind::velocity;
      p.upper.axial_velocity = "-0.3 - s*(1 - s)";
      p.lower.kind           = SideKind::outflow;
      p.outer.kind           = SideKind::outflow;
      check_first_step(p, "outflows below and around");

      p            = scheme(box(), k);
      p.lower.kind = p.upper.kind = SideKind::pressure;
      p.lower.pressure            = "0.5 + 0.1*s";
      check_first_step(p, "pressures at the ends");

      p                = scheme(box(), k);
      p.outer.kind     = SideKind::pressure;
      p.outer.pressure = "0.2*s";
      check_first_step(p, "pressure around");

      p                    = scheme(box(), k);
      p.body_force         = "0.8";
      p.grid.y.breakpoints = {0., 1.};
      p.grid.y.spacings    = {0.1};
      p.lower.kind = p.upper.kind = SideKind::periodic;
      p.outer.kind                = SideKind::velocity;
      p.outer.axial_velocity      = "0.5";
      check_first_step(p, "periodic, with a body force and a moving wall");
      BOOST_TEST(run(p, 1e-3, 1).body_force != 0.);
    }
}

BOOST_AUTO_TEST_CASE(implicit_viscosity)
{
  FlowParameters p = box();
  p.scheme         = TimeScheme::ab2;
  p.viscous        = fluid::ViscousTreatment::implicit;
  check_first_step(p, "implicit");
}

/// A flow that is steady has no error of the time scheme: its terms balance to
/// round-off, with convection and all.
BOOST_AUTO_TEST_CASE(steady_flow_balances_to_round_off)
{
  FlowParameters p = box();
  p.scheme         = TimeScheme::ab2;
  p.viscosity      = 0.3;
  p.lower.kind = p.upper.kind = SideKind::pressure;
  p.lower.pressure            = "3";
  const double dt             = 2e-3;
  const int    n              = 4000;
  const Result before = run(p, dt, n), after = run(p, dt, n + 100);
  const double dissipated = after.dissipation - before.dissipation;
  BOOST_TEST(dissipated > 0.);
  BOOST_TEST(std::abs(after.imbalance - before.imbalance) < 1e-9 * dissipated);
  BOOST_TEST(after.sides - before.sides == dissipated,
             boost::test_tools::tolerance(1e-4));
}

/// The dissipation of a closed flow at rest on its walls is 2 mu e:e.
BOOST_AUTO_TEST_CASE(dissipation_is_that_of_the_rate_of_strain)
{
  double error[2];
  for (const int k : {0, 1})
    {
      FlowParameters p = box();
      for (auto *direction : {&p.grid.r, &p.grid.y})
        for (double &spacing : direction->spacings)
          spacing /= 2. * (k + 1);
      FlowSolver flow(p, MPI_COMM_WORLD);
      // Stream function (r (1 - r))^2 (y (1 - y))^2, v_r = -d/dy / r, ...
      flow.set_initial_velocity(
        [](const double r, const double y) {
          return -r * std::pow(1. - r, 2) * 2. * y * (1. - y) * (1. - 2. * y);
        },
        [](const double r, const double y) {
          return 2. * (1. - r) * (1. - 2. * r) * std::pow(y * (1. - y), 2);
        });
      const double expected = fluid::dissipation(flow.velocity(), p.viscosity);
      const double dt       = 1e-6;
      flow.advance(0., dt);
      Record record;
      flow.energy()->evaluate(flow.velocity(), false, record);
      error[k] =
        std::abs(value(record, "viscous dissipation [J]") / dt / expected - 1.);
    }
  BOOST_TEST(error[1] < 0.01);
  BOOST_TEST(error[0] / error[1] > 3.);
}
