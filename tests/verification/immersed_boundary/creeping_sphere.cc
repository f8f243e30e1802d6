#include "cases.h"

#include <cmath>

using namespace ephyra;
using namespace ephyra::test;

// A sphere on the axis of a tube without inertia: the drag is that of Stokes
// times a wall factor, 1.680, 3.596 where the tube is 5, 2.5 times as wide
// (Haberman & Sayre 1958, David Taylor Model Basin report 1143; Happel &
// Brenner, Low Reynolds Number Hydrodynamics, table 7-3.1). Time steps are far
// above the limit of explicit viscosity.

BOOST_AUTO_TEST_SUITE(creeping_sphere)

namespace
{
  constexpr double mu = 1., R = 0.5;

  /// Unit density, a tube of the given radius and length around the origin.
  fluid::FlowParameters
  tube(const int n, const double radius, const double half_length)
  {
    const double          h = 1. / n, wide = 1.2 / n; // outside of 3/4
    fluid::FlowParameters p;
    p.density            = 1.;
    p.viscosity          = mu;
    p.convection         = false;
    p.grid.r.breakpoints = {0., 0.75, radius};
    p.grid.r.spacings    = {h, h, h + wide * (radius - 0.75)};
    p.grid.y.breakpoints = {-half_length, -0.75, 0.75, half_length};
    p.grid.y.spacings    = {
         h + wide * (half_length - 0.75), h, h, h + wide * (half_length - 0.75)};
    return p;
  }
} // namespace

BOOST_AUTO_TEST_CASE(drag_does_not_depend_on_the_step)
{
  const double exact = 6 * M_PI * mu * R * 1.680;
  double       error[2], error_of_spline = 0;
  // The exponential weight, whose error is large enough to fall clearly, and
  // once the default one.
  immersed_boundary::Parameters exponential;
  exponential.weight = immersed_boundary::WeightFunction::exponential;
  for (const int n : {12, 24})
    {
      std::vector<double> drag;
      // nu dt / Delta^2 = 1, 10 and 100.
      for (const double number : {1., 10., 100.})
        {
          fluid::FlowParameters p = tube(n, 2.5, 6.);
          for (fluid::SideParameters *side : {&p.lower, &p.upper, &p.outer})
            {
              side->kind           = fluid::SideKind::velocity;
              side->axial_velocity = "1";
            }
          p.initial_axial_velocity = "1";
          RigidCase    c(p, {unit_sphere()}, exponential);
          const double dt      = number / (n * n);
          const int    n_steps = std::max(30, static_cast<int>(5. / dt));
          for (int k = 0; k < (n == 24 && number == 1. ? 0 : n_steps); ++k)
            c.step(dt);
          if (c.time > 0)
            drag.push_back(c.rigid->force_by_forcing(0));
          if (n == 24 && number == 100.)
            {
              RigidCase spline(p, {unit_sphere()});
              for (int k = 0; k < n_steps; ++k)
                spline.step(dt);
              error_of_spline =
                std::abs(spline.rigid->force_by_forcing(0) / exact - 1);
            }
        }
      for (const double d : drag)
        BOOST_TEST(std::abs(d / drag.back() - 1) < 1e-5);
      error[n / 24] = std::abs(drag.back() / exact - 1);
      BOOST_TEST_MESSAGE(n << " cells: drag off by " << error[n / 24]);
    }
  BOOST_TEST_MESSAGE("cubic spline, 24 cells: drag off by " << error_of_spline);
  BOOST_TEST(error_of_spline < 0.005);
  BOOST_TEST(error[1] < 0.01);
  BOOST_TEST(error[1] < 0.6 * error[0]);
}

BOOST_AUTO_TEST_CASE(settling_does_not_depend_on_the_step)
{
  constexpr int       n     = 16;
  constexpr double    exact = 0.1;
  std::vector<double> speed;
  // nu dt / Delta^2 = 0.25, explicit, and 20.
  for (const double number : {0.25, 20.})
    {
      immersed_boundary::RigidBody::Parameters sphere = unit_sphere();
      sphere.motion  = immersed_boundary::RigidBody::Motion::free;
      sphere.density = 2.;
      sphere.gravity = -6 * M_PI * mu * R * 3.596 * exact / (M_PI / 6);
      RigidCase    c(tube(n, 1.25, 3.), {sphere});
      const double dt = number / (n * n);
      while (c.time < 1.)
        c.step(dt);
      speed.push_back(-c.rigid->body(0).velocity);
      BOOST_TEST(c.flow.implicit_directions().any() == (number > 1.));
    }
  BOOST_TEST_MESSAGE("speed over exact " << speed[0] / exact << ", "
                                         << speed[1] / exact);
  BOOST_TEST(std::abs(speed[0] / exact - 1) < 0.02);
  BOOST_TEST(std::abs(speed[1] / speed[0] - 1) < 0.005);
}

BOOST_AUTO_TEST_SUITE_END()
