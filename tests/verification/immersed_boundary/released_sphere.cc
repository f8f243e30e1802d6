#include "cases.h"

#include <cmath>

using namespace ephyra;
using namespace ephyra::test;

// A sphere released from rest in a viscous fluid at rest, before convection
// matters: Boussinesq and Basset,
//   m_s V' = (m_s - m_f) g - m_f V' / 2 - 6 pi mu R V
//            - 6 R^2 sqrt(pi rho mu) int_0^t V'(s) / sqrt(t - s) ds,
// integrated with V' constant in each of n intervals.

BOOST_AUTO_TEST_SUITE(released_sphere)

namespace
{
  constexpr double R = 0.5, mu = 0.01, end = 0.1, g = -1.;

  double
  basset_velocity(const double density_ratio)
  {
    constexpr int       n   = 2000;
    const double        dt  = end / n;
    const double        m_f = 4. / 3. * M_PI * R * R * R;
    const double        B   = 6 * R * R * std::sqrt(M_PI * mu);
    std::vector<double> a(n), kernel(n);
    for (int j = 0; j < n; ++j)
      kernel[j] = 2 * (std::sqrt((j + 1) * dt) - std::sqrt(j * dt));
    double V = 0;
    for (int k = 0; k < n; ++k)
      {
        double history = 0;
        for (int j = 0; j < k; ++j)
          history += a[j] * kernel[k - j];
        a[k] = ((density_ratio - 1) * m_f * g - 6 * M_PI * mu * R * V -
                B * history) /
               ((density_ratio + 0.5) * m_f + B * kernel[0] +
                6 * M_PI * mu * R * dt);
        V += dt * a[k];
      }
    return V;
  }

  double
  computed_velocity(const double density_ratio, const int n)
  {
    const double          h = 1. / n;
    fluid::FlowParameters flow;
    flow.density                                    = 1.;
    flow.viscosity                                  = mu;
    flow.grid.r.breakpoints                         = {0., 0.75, 4.};
    flow.grid.r.spacings                            = {h, h, h + 0.39};
    flow.grid.y.breakpoints                         = {-5., -0.75, 0.75, 5.};
    flow.grid.y.spacings                            = {h + 0.5, h, h, h + 0.5};
    immersed_boundary::RigidBody::Parameters sphere = unit_sphere();
    sphere.motion  = immersed_boundary::RigidBody::Motion::free;
    sphere.density = density_ratio;
    sphere.gravity = g;
    RigidCase c(flow, {sphere});
    for (int k = 0; k < 20; ++k)
      c.step(end / 20);
    return c.rigid->body(0).velocity;
  }
} // namespace

BOOST_AUTO_TEST_CASE(from_light_to_heavy)
{
  for (const double ratio : {0.01, 0.5, 1.1, 2., 100.})
    {
      const double exact = basset_velocity(ratio);
      const double error[2]{computed_velocity(ratio, 16) / exact - 1,
                            computed_velocity(ratio, 32) / exact - 1};
      BOOST_TEST_MESSAGE("density ratio " << ratio << ": error of the velocity "
                                          << error[0] << ", " << error[1]);
      BOOST_TEST(std::abs(error[1]) < 0.05);
      BOOST_TEST(std::abs(error[1]) < 0.5 * std::abs(error[0]));
    }
}

BOOST_AUTO_TEST_SUITE_END()
