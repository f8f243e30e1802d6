// Axisymmetric heat equation on a disk, section A.1 of Nitti et al. 2023
// (10.1016/j.apm.2023.08.003): the diffusion part of the monodomain operator.
#include "ephyra/electrophysiology/electrophysiology_solver.h"

#include "reference_table.h"
#include "straight_line.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra::electrophysiology;

namespace
{
  constexpr double radius = 40; ///< m

  /// The series (A.1), from t = 0.5 s on exact to round-off.
  double
  exact(const double r, const double t)
  {
    static const std::vector<double> zeros = [] {
      std::vector<double> result;
      for (int n = 1; n <= 20; ++n)
        {
          double x = (n - 0.25) * M_PI;
          for (int k = 0; k < 20; ++k)
            x += std::cyl_bessel_j(0, x) / std::cyl_bessel_j(1, x);
          result.push_back(x);
        }
      return result;
    }();
    double phi = 1;
    for (const double x : zeros)
      phi -= 2. * std::cyl_bessel_j(0, x * r / radius) /
             (x * std::cyl_bessel_j(1, x)) *
             std::exp(-x * x * 60. * t / (radius * radius));
    return phi;
  }

  /// Errors at t = 1 s.
  struct Error
  {
    double l2      = 0; ///< r-weighted root mean square
    double largest = 0;
    double axis    = 0; ///< at r = 0
  };

  Error
  error(const int degree, const int n_elements, const double time_step)
  {
    ElectrophysiologySolver::Parameters prm;
    prm.model               = ElectrophysiologySolver::Model::none;
    prm.conductivity        = 60;
    prm.capacitance         = 1;
    prm.time_step           = time_step;
    prm.stimulus.current    = 0;
    prm.end.holds_potential = true;
    prm.end.potential       = "1";
    ElectrophysiologySolver solver(
      prm,
      straight_line({0, 0}, {radius, 0}, degree, n_elements),
      MPI_COMM_WORLD);
    BOOST_REQUIRE(solver.advance(0., 1.).success);
    // At points that no mesh knows: splines are more accurate at some of theirs.
    Error         result;
    double        sum = 0, weight = 0;
    constexpr int n_points = 997;
    for (int i = 0; i < n_points; ++i)
      {
        const double r = radius * (i + 0.3) / n_points;
        const double e =
          std::abs(solver.potential_at(r / radius) - exact(r, 1.));
        sum += r * e * e;
        weight += r;
        result.largest = std::max(result.largest, e);
      }
    result.axis = std::abs(solver.potential_at(0.) - exact(0., 1.));
    result.l2   = std::sqrt(sum / weight);
    return result;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(disk_heat)

BOOST_AUTO_TEST_CASE(series_is_that_of_the_reference)
{
  for (const std::vector<double> &row : read_reference("A1_disk_heat.csv"))
    BOOST_TEST(std::abs(exact(row[0], 1.) - row[3]) < 1e-11);
}

BOOST_AUTO_TEST_CASE(discretisation_of_the_paper)
{
  const Error e = error(2, 600, 0.01);
  BOOST_TEST_MESSAGE("L2 " << e.l2 << ", largest " << e.largest << ", axis "
                           << e.axis);
  BOOST_TEST(e.l2 < 1e-5);
  BOOST_TEST(e.largest < 2e-5);
}

BOOST_AUTO_TEST_CASE(order_2_in_time)
{
  const Error coarse = error(3, 60, 0.05), fine = error(3, 60, 0.0125);
  BOOST_TEST(std::abs(std::log2(coarse.l2 / fine.l2) / 2. - 2.) < 0.05);
  BOOST_TEST(std::abs(std::log2(coarse.axis / fine.axis) / 2. - 2.) < 0.05);
}

BOOST_AUTO_TEST_CASE(order_p_plus_1_in_space)
{
  // The time error is 7e-4 (dt / 0.1 s)^2, well below the errors in space.
  for (int degree = 1; degree <= 4; ++degree)
    {
      const int    n      = degree < 3 ? 20 : 10;
      const double dt     = degree < 3 ? 1e-3 : 2e-4;
      const Error  coarse = error(degree, n, dt),
                  fine    = error(degree, 2 * n, dt);
      const double order  = std::log2(coarse.l2 / fine.l2);
      BOOST_TEST(order > degree + 0.85);
      BOOST_TEST(order < degree + 1.7);
      BOOST_TEST(std::log2(coarse.largest / fine.largest) > degree + 0.7);
    }
}

BOOST_AUTO_TEST_CASE(long_table_of_refinements)
{
  Error      before{};
  const auto report =
    [&before](const int degree, const int n, const double dt) {
      const Error e     = error(degree, n, dt);
      const auto  order = [](const double coarse, const double fine) {
        return coarse > 0 ? std::log2(coarse / fine) : 0.;
      };
      BOOST_TEST_MESSAGE("| " << degree << " | " << n << " | " << dt << " | "
                              << e.l2 << " | " << e.largest << " | " << e.axis
                              << " | " << order(before.l2, e.l2) << " | "
                              << order(before.largest, e.largest) << " | "
                              << order(before.axis, e.axis) << " |");
      const double found = order(before.l2, e.l2);
      before             = e;
      return found;
    };
  for (int k = 0; k < 3; ++k)
    report(2, 600 << k, 0.01 / (1 << k)); // the paper's, refined
  before = {};
  for (int k = 0; k < 4; ++k)
    if (report(3, 100, 0.04 / (1 << k)) != 0) // steps alone
      BOOST_TEST(
        std::abs(std::log2(before.l2 / error(3, 100, 0.02 / (1 << k)).l2) -
                 2.) < 0.05);
  for (int degree = 1; degree <= 4; ++degree)
    {
      before = {};
      for (int n = 10; n <= (degree < 3 ? 160 : 40); n *= 2)
        {
          const double order = report(degree, n, 5e-5);
          if (order != 0 && n > 20)
            BOOST_TEST(order > degree + 0.85);
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()
