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

  /// r-weighted root mean square of the error at t = 1 s (column 3).
  double
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
    double sum = 0, weight = 0;
    for (const std::vector<double> &row : read_reference("A1_disk_heat.csv"))
      {
        const double e = solver.potential_at(row[0] / radius) - row[3];
        sum += row[0] * e * e;
        weight += row[0];
      }
    return std::sqrt(sum / weight);
  }
} // namespace

BOOST_AUTO_TEST_SUITE(disk_heat)

BOOST_AUTO_TEST_CASE(discretisation_of_the_paper)
{
  BOOST_TEST(error(2, 600, 0.01) < 1e-5);
}

BOOST_AUTO_TEST_CASE(order_2_in_time)
{
  const double order =
    std::log2(error(3, 60, 0.05) / error(3, 60, 0.0125)) / 2.;
  BOOST_TEST(std::abs(order - 2.) < 0.05);
}

BOOST_AUTO_TEST_CASE(order_p_plus_1_in_space)
{
  // The time error is 7e-4 (dt / 0.1 s)^2, well below the errors in space.
  for (int degree = 1; degree <= 4; ++degree)
    {
      const int    n  = degree < 3 ? 20 : 10;
      const double dt = degree < 3 ? 1e-3 : 2e-4;
      const double order =
        std::log2(error(degree, n, dt) / error(degree, 2 * n, dt));
      BOOST_TEST_MESSAGE("degree " << degree << ": order " << order);
      BOOST_TEST(order > degree + 0.85);
      BOOST_TEST(order < degree + 1.7);
    }
}

BOOST_AUTO_TEST_SUITE_END()
