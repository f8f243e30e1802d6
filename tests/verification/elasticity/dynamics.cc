// Oscillating tube: period and amplitude of the incompressible limit, order in
// the time step, energy.
#include "elasticity_patches.h"

#include "ephyra/elasticity/elasticity_solver.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra;
using namespace ephyra::elasticity;

namespace
{
  ElasticitySolver::Parameters
  tube_parameters(const std::string &pressure, const double K)
  {
    ElasticitySolver::Parameters prm;
    prm.body.material       = {400., K, false};
    prm.body.density        = 1100.;
    prm.body.sides[0].fixed = prm.body.sides[1].fixed = {{false, true}};
    prm.body.sides[2].pressure = Expression(pressure, SideCondition::variables);
    prm.newton.tolerance       = 1e-11;
    return prm;
  }

  const auto patch = test::tube(.5, .8, .1, 3, {1, 4});
} // namespace

BOOST_AUTO_TEST_SUITE(dynamics)

BOOST_AUTO_TEST_CASE(period_and_amplitude_of_a_tube)
{
  // p = 100 Pa from t = 0 on, incompressible limit (approached as 1/K): the
  // inner radius is largest, .626466860, at 1.353253 s.
  ElasticitySolver solver(tube_parameters("100", 5e7), patch, MPI_COMM_WORLD);
  solver.initialize(0.);
  const double        dt = 0.01;
  std::vector<double> a{.5};
  for (int step = 0; step < 150; ++step)
    {
      const auto status = solver.advance(step * dt, dt);
      BOOST_TEST(status.success, status.reason);
      solver.accept();
      a.push_back(.5 + solver.displacement()[0]);
    }
  const auto   top       = std::max_element(a.begin(), a.end()) - a.begin();
  const double d1        = 0.5 * (a[top + 1] - a[top - 1]);
  const double d2        = a[top + 1] - 2. * a[top] + a[top - 1];
  const double time      = (top - d1 / d2) * dt,
               amplitude = a[top] - 0.5 * d1 * d1 / d2;
  BOOST_TEST_MESSAGE("largest inner radius " << amplitude << " m at " << time
                                             << " s");
  BOOST_TEST(amplitude == .626466860, boost::test_tools::tolerance(2e-4));
  BOOST_TEST(time == 1.353253, boost::test_tools::tolerance(2e-3));
}

BOOST_AUTO_TEST_CASE(second_order_in_time)
{
  for (const double rho : {1., 0.5, 0.})
    {
      // Inner displacement at 25 times.
      const auto run = [&](const int steps) {
        auto prm         = tube_parameters("100*sin(3*t)^4", 4000.);
        prm.rho_infinity = rho;
        ElasticitySolver solver(prm, patch, MPI_COMM_WORLD);
        solver.initialize(0.);
        const double        dt = 1. / steps;
        std::vector<double> u;
        for (int step = 0; step < steps; ++step)
          {
            BOOST_TEST(solver.advance(step * dt, dt).success);
            solver.accept();
            if ((step + 1) % (steps / 25) == 0)
              u.push_back(solver.displacement()[0]);
          }
        return u;
      };
      const auto distance = [](const std::vector<double> &x,
                               const std::vector<double> &y) {
        double sum = 0.;
        for (std::size_t i = 0; i < x.size(); ++i)
          sum += (x[i] - y[i]) * (x[i] - y[i]);
        return std::sqrt(sum / x.size());
      };
      const auto   u1 = run(100), u2 = run(200), u3 = run(400);
      const double order = std::log2(distance(u2, u1) / distance(u3, u2));
      BOOST_TEST_MESSAGE("rho_infinity " << rho << ": order in time " << order);
      BOOST_TEST(order > 1.85);
      BOOST_TEST(order < 2.3);
    }
}

BOOST_AUTO_TEST_CASE(energy_of_free_oscillation)
{
  // Released from a uniform radial velocity profile v ~ 1/r.
  const auto drift = [&](const double rho, const int steps) {
    auto prm         = tube_parameters("0", 4000.);
    prm.rho_infinity = rho;
    ElasticitySolver    solver(prm, patch, MPI_COMM_WORLD);
    std::vector<double> v;
    for (const auto &x : patch.control_points())
      {
        v.push_back(0.05 / x.r);
        v.push_back(0.);
      }
    solver.initialize(0., {}, v);
    const auto   m0    = solver.measures();
    const double start = m0.kinetic_energy + m0.elastic_energy;
    const double dt    = 2. / steps;
    for (int step = 0; step < steps; ++step)
      {
        BOOST_TEST(solver.advance(step * dt, dt).success);
        solver.accept();
      }
    const auto m = solver.measures();
    return (m.kinetic_energy + m.elastic_energy) / start - 1.;
  };
  for (const double rho : {1., 0.5})
    {
      const double coarse = drift(rho, 200), fine = drift(rho, 400);
      BOOST_TEST_MESSAGE("rho_infinity " << rho << ": energy drift over 2 s "
                                         << coarse << ", " << fine);
      BOOST_TEST(std::abs(fine) < 2e-3);
      BOOST_TEST(std::abs(fine) < 0.4 * std::abs(coarse));
    }
}

BOOST_AUTO_TEST_SUITE_END()
