// Integrals of the vorticity on Hill's vortex of radius 1 moving at U = 1
// (Lamb, Hydrodynamics, art. 165): omega = 7.5 r inside, circulation 5, axial
// impulse 2 pi and kinetic energy 10 pi/7 at unit density.
#include "ephyra/fluid/flow_diagnostics.h"
#include "ephyra/fluid/flow_solver.h"
#include "ephyra/fluid/vortex_ring.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra;
using namespace ephyra::fluid;

namespace
{
  double
  hill_v_r(const double r, const double y)
  {
    const double rho = std::max(1., std::hypot(r, y));
    return 1.5 * r * y / std::pow(rho, 5);
  }

  double
  hill_v_y(const double r, const double y)
  {
    const double rho = std::hypot(r, y);
    return rho < 1 ? 2.5 - 3 * r * r - 1.5 * y * y
                   : (y * y - 0.5 * r * r) / std::pow(rho, 5);
  }

  FlowParameters
  tank(const int n)
  {
    FlowParameters parameters;
    parameters.density = parameters.viscosity = 1.;
    parameters.grid.r.breakpoints             = {0., 1.5, 6.};
    parameters.grid.r.spacings                = {1. / n, 1. / n, 8. / n};
    parameters.grid.y.breakpoints             = {-6., -1.5, 1.5, 6.};
    parameters.grid.y.spacings = {8. / n, 1. / n, 1. / n, 8. / n};
    for (SideParameters *side :
         {&parameters.lower, &parameters.upper, &parameters.outer})
      side->kind = SideKind::free_slip;
    return parameters;
  }

  /// Places the vortex there as it is, with v = +-Hill's.
  void
  set_hill(FlowSolver &flow, const double sign, const double place = 0)
  {
    const StaggeredGrid &grid = flow.grid();
    for (int i = grid.first_row; i < grid.end_row() + 1; ++i)
      for (int j = 0; j < grid.y.n_cells + 1; ++j)
        {
          if (j < grid.y.n_cells)
            flow.velocity().r(i, j) =
              sign * hill_v_r(grid.r.face[i], grid.y.centre[j] - place);
          if (i < grid.end_row())
            flow.velocity().y(i, j) =
              sign * hill_v_y(grid.r.centre[i], grid.y.face[j] - place);
        }
    flow.update_ghosts();
  }
} // namespace

BOOST_AUTO_TEST_SUITE(vorticity)

BOOST_AUTO_TEST_CASE(hills_vortex_converges)
{
  const Region around{0., 1.4, -1.4, 1.4};
  double       previous = 0;
  for (const int n : {16, 32, 64})
    {
      FlowSolver flow(tank(n), MPI_COMM_WORLD);
      set_hill(flow, 1.);
      const VorticityIntegrals all =
        vorticity_integrals(flow.velocity(), 1., around);
      const VortexRing ring = find_vortex_ring(
        flow.velocity(), 1., around, VorticitySign::positive, 0.02);
      const double error = std::max(std::abs(all.circulation() / 5 - 1),
                                    std::abs(all.impulse / (2 * M_PI) - 1));
      BOOST_TEST_MESSAGE("n = " << n << ": error " << error
                                << ", speed of the ring " << ring.speed);
      if (previous > 0)
        BOOST_TEST(std::log2(previous / error) > 1.8);
      previous = error;
      // The ring ends where r = 0.02 and at the surface, on which the
      // vorticity jumps.
      const double cut = 5 * (1 - std::pow(1 - 0.02 * 0.02, 1.5));
      BOOST_TEST(ring.circulation == 5 - cut,
                 boost::test_tools::tolerance(0.05 / n));
      BOOST_TEST(ring.impulse == 2 * M_PI,
                 boost::test_tools::tolerance(0.05 / n));
      BOOST_TEST(ring.speed == 1., boost::test_tools::tolerance(0.13 / n));
      BOOST_TEST(std::abs(ring.y) < 1e-12);
      BOOST_TEST(ring.r == 3 * M_PI / 16, boost::test_tools::tolerance(5e-3));
    }
  BOOST_TEST(previous < 3e-4);
}

BOOST_AUTO_TEST_CASE(sign_and_place)
{
  FlowSolver flow(tank(32), MPI_COMM_WORLD);
  set_hill(flow, -1., 0.25);
  const Region             around{0., 1.4, -1.4, 1.4};
  const VorticityIntegrals all =
    vorticity_integrals(flow.velocity(), 1., around);
  BOOST_TEST(all.negative == -5., boost::test_tools::tolerance(0.01));
  BOOST_TEST(all.positive < 0.02);
  BOOST_TEST(circulation(flow.velocity(), around, VorticitySign::negative) ==
             all.negative);
  const VortexRing ring = find_vortex_ring(
    flow.velocity(), 2., around, VorticitySign::negative, 0.02);
  BOOST_TEST(ring.y == 0.25, boost::test_tools::tolerance(0.01));
  BOOST_TEST(ring.speed == -1., boost::test_tools::tolerance(0.02));
  BOOST_TEST(ring.impulse == -4 * M_PI, boost::test_tools::tolerance(0.01));
  BOOST_TEST(ring.peak == -7.5, boost::test_tools::tolerance(0.1));
  BOOST_TEST(
    find_vortex_ring(
      flow.velocity(), 1., {3., 4., 3., 4.}, VorticitySign::positive, 0.5)
      .circulation < 1e-3);
}

BOOST_AUTO_TEST_CASE(rings_that_do_not_touch)
{
  // Of two vortices of one region only the stronger belongs to the ring, on
  // all ranks together as on each alone; a thin spiral is followed across the
  // borders of the ranks as often as it takes.
  const auto spiral = [](const double r, const double y) {
    const double a     = std::hypot(r - 1.5, y);
    const double phase = std::atan2(y, r - 1.5) + 12 * a;
    return a < 1.2 ? std::exp(4 * std::cos(phase)) / (1 + a) : 0.;
  };
  FlowParameters parameters     = tank(20);
  parameters.grid.r.breakpoints = {0., 3.};
  parameters.grid.r.spacings    = {0.03};
  parameters.grid.y.breakpoints = {-2., 4.};
  parameters.grid.y.spacings    = {0.03};
  const auto set                = [&](FlowSolver &flow) {
    const StaggeredGrid &grid = flow.grid();
    // v_y alone: omega = -d v_y/dr.
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      for (int j = 0; j < grid.y.n_cells + 1; ++j)
        {
          const double r = grid.r.centre[i], y = grid.y.face[j];
          double       v = 0;
          for (int k = 0; k < 40; ++k) // int_r^3 omega dr
            v += spiral(r + (k + 0.5) * (3 - r) / 40, y) * (3 - r) / 40;
          flow.velocity().y(i, j) =
            v + 100 * std::exp(-std::pow(y - 3, 2) * 20 - r * r);
        }
    flow.update_ghosts();
  };
  FlowSolver together(parameters, MPI_COMM_WORLD),
    alone(parameters, MPI_COMM_SELF);
  set(together);
  set(alone);
  for (const Region &region : {Region{}, Region{0., 3., -2., 1.6}})
    for (const double level : {0.05, 0.3, 0.7})
      {
        const VortexRing a = find_vortex_ring(
          together.velocity(), 1., region, VorticitySign::positive, level);
        const VortexRing b = find_vortex_ring(
          alone.velocity(), 1., region, VorticitySign::positive, level);
        BOOST_TEST_MESSAGE("level " << level << ": " << a.n_cells
                                    << " cells around (" << a.r << ", " << a.y
                                    << ")");
        BOOST_TEST(a.n_cells == b.n_cells);
        BOOST_TEST(a.n_cells > 20);
        for (const auto &[x, z] : {std::pair(a.circulation, b.circulation),
                                   {a.impulse, b.impulse},
                                   {a.r, b.r},
                                   {a.y, b.y},
                                   {a.speed, b.speed}})
          BOOST_TEST(x == z, boost::test_tools::tolerance(1e-12));
        const double whole =
          circulation(together.velocity(), region, VorticitySign::positive);
        BOOST_TEST(a.circulation < whole);
        // Either the blob at y = 3 or a part of the spiral around y = 0.
        BOOST_TEST((region.y_max > 2 ? a.y > 2.5 : a.y < 1.3));
      }
}

BOOST_AUTO_TEST_CASE(flux_through_the_sides)
{
  // v_y = (2 + y) exp(-3 r^2), v_r = -(1 - exp(-3 r^2))/(6 r):
  // omega = (2 + y) 6 r exp(-3 r^2). Through y = b between r = 0 and R
  // v_y omega gives (2 + b)^2 (1 - exp(-6 R^2))/2, through r = R v_r omega
  // -(1 - E) E ((2 + b)^2 - (2 + a)^2)/2, E = exp(-3 R^2), on which v_r does
  // not change along the side.
  const Region region{0., 1., -1., 1.};
  const double e        = std::exp(-3.);
  double       previous = 0;
  for (const int n : {10, 20, 40})
    {
      FlowParameters parameters     = tank(n);
      parameters.grid.r.breakpoints = {0., 1., 2.};
      parameters.grid.r.spacings    = {1. / n, 0.8 / n, 1.2 / n};
      parameters.grid.y.breakpoints = {-1.5, -1., 1., 1.5};
      parameters.grid.y.spacings    = {1. / n, 1. / n, 0.8 / n, 1. / n};
      FlowSolver           flow(parameters, MPI_COMM_WORLD);
      const StaggeredGrid &grid = flow.grid();
      for (int i = grid.first_row; i < grid.end_row(); ++i)
        for (int j = 0; j < grid.y.n_cells; ++j)
          {
            const double r = grid.r.face[i], rc = grid.r.centre[i];
            flow.velocity().r(i, j) =
              r > 0 ? -(1 - std::exp(-3 * r * r)) / (6 * r) : 0.;
            flow.velocity().y(i, j) =
              (2 + grid.y.face[j]) * std::exp(-3 * rc * rc);
          }
      flow.update_ghosts();
      const VorticityFlux lower =
        vorticity_flux(flow.velocity(), region, Side::lower);
      const VorticityFlux upper =
        vorticity_flux(flow.velocity(), region, Side::upper);
      const VorticityFlux outer =
        vorticity_flux(flow.velocity(), region, Side::outer);
      const double exact_lower = 0.5 * (1 - e * e);
      const double exact_upper = -4.5 * (1 - e * e);
      const double exact_outer = (1 - e) * e * 4;
      double       error       = 0;
      for (const auto &[value, exact] : {std::pair(lower.total, exact_lower),
                                         {lower.shear, exact_lower},
                                         {upper.total, exact_upper},
                                         {upper.shear, exact_upper},
                                         {outer.total, exact_outer}})
        {
          BOOST_TEST_MESSAGE("n = " << n << ": " << value << ", " << exact);
          error = std::max(error, std::abs(value / exact - 1));
        }
      BOOST_TEST(std::abs(outer.shear) < 1e-12);
      if (previous > 0)
        BOOST_TEST(std::log2(previous / error) > 1.8);
      previous = error;
    }
  BOOST_TEST(previous < 2e-3);
}

BOOST_AUTO_TEST_SUITE_END()
