#include "cases.h"

#include <cmath>

using namespace ephyra;
using namespace ephyra::test;

// The sphere of ten Cate et al. 2002 (10.1063/1.1512918) at Re = 31.9 in a
// closed cylinder of radius 50 mm. An independent body-fitted program
// (FreeFem++ P2-P1 ALE) finds the largest speed .12092 m/s.
constexpr double reference = 0.12092;

BOOST_AUTO_TEST_SUITE(settling_sphere)

BOOST_AUTO_TEST_CASE(largest_speed_at_reynolds_32)
{
  const double          D = 0.015, h = D / 16.;
  fluid::FlowParameters flow;
  flow.density            = 960.;
  flow.viscosity          = 0.058;
  flow.grid.r.breakpoints = {0., 0.0125, 0.05};
  flow.grid.r.spacings    = {h, h, 4. * h};
  flow.grid.y.breakpoints = {0., 0.16};
  flow.grid.y.spacings    = {h};

  immersed_boundary::RigidBody::Parameters sphere;
  sphere.name     = "sphere";
  sphere.radius   = 0.5 * D;
  sphere.centre_y = 8.5 * D;
  sphere.density  = 1120.;
  sphere.gravity  = -9.81;
  sphere.motion   = immersed_boundary::RigidBody::Motion::free;

  RigidCase    c(flow, {sphere});
  const double dt      = 2e-3;
  double       largest = 0;
  while (c.time < 0.75)
    {
      c.step(dt);
      largest = std::max(largest, -c.rigid->body(0).velocity);
    }
  BOOST_TEST_MESSAGE("largest speed " << largest << " m/s");
  BOOST_TEST(std::abs(largest / reference - 1) < 0.05);
}

BOOST_AUTO_TEST_SUITE_END()
