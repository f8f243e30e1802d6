#include "cases.h"

#include <cmath>

using namespace ephyra;
using namespace ephyra::test;

// Steady flow past a torus at Re = U D_s / nu = 70, D_s the diameter of its
// section, drag on pi D D_s; domain -15 ... 25 D_s by 20 D_s, free slip outside
// (FreeFem++ P2-P1, body fitted).

BOOST_AUTO_TEST_SUITE(torus_drag)

namespace
{
  void
  run(const double aspect_ratio, const double reference, const int n)
  {
    const double          h = 1. / n, R = 0.5 * aspect_ratio;
    fluid::FlowParameters flow;
    flow.density                = 1.;
    flow.viscosity              = 1. / 70.;
    flow.grid.r.breakpoints     = {0., R + 0.75, R + 20.};
    flow.grid.r.spacings        = {h, h, h + 0.1 * 19.};
    flow.grid.y.breakpoints     = {-15., -0.75, 1.5, 25.};
    flow.grid.y.spacings        = {h + 0.1 * 14.25, h, h, h + 0.06 * 23.5};
    flow.lower.kind             = fluid::SideKind::velocity;
    flow.lower.axial_velocity   = "1";
    flow.upper.kind             = fluid::SideKind::outflow;
    flow.outer.kind             = fluid::SideKind::free_slip;
    flow.initial_axial_velocity = "1";
    immersed_boundary::RigidBody::Parameters torus;
    torus.name        = "torus";
    torus.shape       = "torus";
    torus.ring_radius = R;
    torus.core_radius = 0.5;
    RigidCase    c(flow, {torus});
    const double dt = 0.4 / n;
    while (c.time < 60.)
      c.step(dt);
    const double unit       = 0.5 * M_PI * aspect_ratio;
    const double by_forcing = c.rigid->force_by_forcing(0) / unit;
    const double by_probes  = c.force_by_probes() / unit;
    BOOST_TEST_MESSAGE("aspect ratio " << aspect_ratio << ", " << n
                                       << " cells: Cd by forcing " << by_forcing
                                       << ", by probes " << by_probes
                                       << ", reference " << reference);
    BOOST_TEST(std::abs(by_forcing / reference - 1) < 0.02);
    BOOST_TEST(std::abs(by_probes / reference - 1) < 0.05);
  }
} // namespace

BOOST_AUTO_TEST_CASE(long_reynolds_70)
{
  run(1.3, 0.9278, 32);
  run(2.0, 1.0503, 32);
}

BOOST_AUTO_TEST_SUITE_END()
