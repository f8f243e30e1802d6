// Exact travelling wave of Nagumo's equation u_t = D u_xx + k u(1-u)(u-a) for
// D = 1e-3, k = 10, a = 0.1: speed sqrt(D k/2)(1 - 2a) = 0.0565685.
#include "ephyra/electrophysiology/electrophysiology_solver.h"

#include "straight_line.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra::electrophysiology;

namespace
{
  constexpr double length = 2, speed = 0.0565685425;

  double
  wave(const double x, const double t)
  {
    return 0.5 *
           (1. - std::tanh(std::sqrt(10. / 8e-3) * (x - 0.6 - speed * t)));
  }

  struct Result
  {
    double speed; ///< relative error
    double l2;    ///< of u at t = 4
  };

  Result
  run(const int       degree,
      const int       n_elements,
      const double    time_step,
      const Placement placement)
  {
    ElectrophysiologySolver::Parameters prm;
    prm.model            = ElectrophysiologySolver::Model::nagumo;
    prm.conductivity     = 1e-3;
    prm.capacitance      = 1;
    prm.time_step        = time_step;
    prm.placement        = placement;
    prm.stimulus.current = 0;
    // of constant radius: a plane wave
    ElectrophysiologySolver solver(
      prm,
      straight_line({1, 0}, {1, length}, degree, n_elements),
      MPI_COMM_WORLD);
    solver.set_potential([](const double s) { return wave(length * s, 0.); });
    const int first  = solver.add_crossing_probe(0.70 / length, 0.5);
    const int second = solver.add_crossing_probe(0.80 / length, 0.5);
    BOOST_REQUIRE(solver.advance(0., 4.).success);
    double sum = 0;
    for (int i = 0; i <= 2000; ++i)
      {
        const double e =
          solver.potential_at(i / 2000.) - wave(length * i / 2000., 4.);
        sum += e * e * length / 2000.;
      }
    return {0.1 /
                (solver.crossing_times(second).at(0) -
                 solver.crossing_times(first).at(0)) /
                speed -
              1.,
            std::sqrt(sum)};
  }
} // namespace

BOOST_AUTO_TEST_SUITE(nagumo_wave)

BOOST_AUTO_TEST_CASE(speed_within_a_thousandth)
{
  for (const Placement placement : {Placement::control_coefficients,
                                    Placement::greville_points,
                                    Placement::quadrature_points})
    BOOST_TEST(std::abs(run(3, 160, 5e-3, placement).speed) < 1e-3);
}

BOOST_AUTO_TEST_CASE(order_2_in_time)
{
  const double order =
    std::log2(run(3, 300, 0.02, Placement::greville_points).l2 /
              run(3, 300, 0.01, Placement::greville_points).l2);
  BOOST_TEST(std::abs(order - 2.) < 0.1);
}

BOOST_AUTO_TEST_CASE(order_p_plus_1_in_space_at_every_placement)
{
  for (const Placement placement : {Placement::control_coefficients,
                                    Placement::greville_points,
                                    Placement::quadrature_points})
    for (int degree = 1; degree <= 3; ++degree)
      BOOST_TEST(std::log2(run(degree, 120, 5e-4, placement).l2 /
                           run(degree, 240, 5e-4, placement).l2) >
                 degree + 0.8);
}

BOOST_AUTO_TEST_CASE(long_table_of_orders_in_space)
{
  for (const Placement placement : {Placement::control_coefficients,
                                    Placement::greville_points,
                                    Placement::quadrature_points})
    for (int degree = 1; degree <= 4; ++degree)
      {
        std::ostringstream row;
        row << "| " << static_cast<int>(placement) << " | " << degree;
        double before = 0, order = 0;
        for (const int n : {80, 160, 320})
          {
            const Result now = run(degree, n, 2e-4, placement);
            order            = std::log2(before / now.l2);
            before           = now.l2;
            row << " | " << now.l2 << " | " << now.speed;
          }
        BOOST_TEST_MESSAGE(row.str() << " | " << order << " |");
        BOOST_TEST(order > degree + 0.8);
      }
}

BOOST_AUTO_TEST_CASE(long_steps_are_second_order_at_every_placement)
{
  for (const Placement placement : {Placement::control_coefficients,
                                    Placement::greville_points,
                                    Placement::quadrature_points})
    {
      double before = 0;
      for (const double dt : {0.04, 0.02, 0.01, 0.005})
        {
          const Result now = run(3, 300, dt, placement);
          BOOST_TEST_MESSAGE("| " << static_cast<int>(placement) << " | " << dt
                                  << " | " << now.l2 << " | " << now.speed
                                  << " | ");
          if (before > 0)
            BOOST_TEST(std::abs(std::log2(before / now.l2) - 2.) < 0.1);
          before = now.l2;
        }
    }
}

BOOST_AUTO_TEST_CASE(a_circular_front_slows_with_its_curvature)
{
  // c - D/r for D/r << c, here around r = 0.8 on a disk.
  ElectrophysiologySolver::Parameters prm;
  prm.model            = ElectrophysiologySolver::Model::nagumo;
  prm.conductivity     = 1e-3;
  prm.capacitance      = 1;
  prm.time_step        = 5e-3;
  prm.stimulus.current = 0;
  ElectrophysiologySolver solver(
    prm, straight_line({0, 0}, {length, 0}, 3, 200), MPI_COMM_WORLD);
  solver.set_potential([](const double s) { return wave(length * s, 0.); });
  const int first  = solver.add_crossing_probe(0.75 / length, 0.5);
  const int second = solver.add_crossing_probe(0.85 / length, 0.5);
  BOOST_REQUIRE(solver.advance(0., 6.).success);
  const double measured = 0.1 / (solver.crossing_times(second).at(0) -
                                 solver.crossing_times(first).at(0));
  BOOST_TEST(std::abs(measured / (speed - 1e-3 / 0.8) - 1.) < 2e-3);
}

BOOST_AUTO_TEST_CASE(long_circular_fronts_of_all_radii)
{
  // dR/dt = c - D/R integrated between two places is
  // t = (R + D/c ln(c R - D))/c; what is left falls with 1/R^2.
  ElectrophysiologySolver::Parameters prm;
  prm.model            = ElectrophysiologySolver::Model::nagumo;
  prm.conductivity     = 1e-3;
  prm.capacitance      = 1;
  prm.time_step        = 2e-3;
  prm.stimulus.current = 0;
  ElectrophysiologySolver solver(
    prm, straight_line({0, 0}, {length, 0}, 3, 400), MPI_COMM_WORLD);
  solver.set_potential(
    [](const double s) { return wave(length * s + 0.5, 0.); });
  const std::vector<double> radii = {0.2, 0.4, 0.8, 1.6};
  for (const double r : radii)
    for (const double end : {r, 1.1 * r})
      solver.add_crossing_probe(end / length, 0.5);
  BOOST_REQUIRE(solver.advance(0., 40.).success);
  double before = 1;
  for (std::size_t i = 0; i < radii.size(); ++i)
    {
      const double a = radii[i], b = 1.1 * a, D = 1e-3;
      const double measured =
        (b - a) / (solver.crossing_times(2 * i + 1).at(0) -
                   solver.crossing_times(2 * i).at(0));
      const double theory =
        (b - a) * speed /
        (b - a + D / speed * std::log((speed * b - D) / (speed * a - D)));
      const double error = std::abs(measured / theory - 1.);
      BOOST_TEST_MESSAGE("| " << a << " | " << measured << " | " << theory
                              << " | " << measured / theory - 1. << " | "
                              << measured / speed - 1. << " |");
      BOOST_TEST(error < std::max(before / 3., 1e-4));
      before = error;
    }
  BOOST_TEST(before < 1e-4);
}

BOOST_AUTO_TEST_SUITE_END()
