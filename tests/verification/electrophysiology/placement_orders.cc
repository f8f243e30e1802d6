// Orders of the three placements of gates and currents on the travelling action
// potential: times of arrival on a cable of 10 mm against a fine mesh.
#include "ephyra/electrophysiology/electrophysiology_solver.h"

#include "straight_line.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra::electrophysiology;

namespace
{
  /// From 2 to 8 mm, s. Without synapses the wave is slow and smooth.
  double
  travel_time(const Placement placement,
              const int       degree,
              const int       n_elements,
              const bool      synapses  = true,
              const double    time_step = 2.5e-6)
  {
    ElectrophysiologySolver::Parameters prm;
    prm.time_step         = time_step;
    prm.synapses.release  = synapses;
    prm.synapses.reflux   = synapses;
    prm.placement         = placement;
    prm.stimulus.interval = {{0., 0.04}};
    prm.stimulus.current  = 1.;
    ElectrophysiologySolver solver(
      prm,
      straight_line({15e-3, 0}, {15e-3, 10e-3}, degree, n_elements),
      MPI_COMM_WORLD);
    const int first = solver.add_crossing_probe(0.2, 20e-3);
    const int last  = solver.add_crossing_probe(0.8, 20e-3);
    for (int i = 0; i < 200 && solver.crossing_times(last).empty(); ++i)
      BOOST_REQUIRE(solver.advance(i * 0.5e-3, 0.5e-3).success);
    return solver.crossing_times(last).at(0) -
           solver.crossing_times(first).at(0);
  }
} // namespace

BOOST_AUTO_TEST_SUITE(placement_orders)

BOOST_AUTO_TEST_CASE(long_orders_of_the_arrival_time)
{
  // Steps are the same everywhere, so that their error cancels.
  const double exact = travel_time(Placement::greville_points, 3, 4800);
  for (const int degree : {2, 3})
    for (const Placement placement : {Placement::control_coefficients,
                                      Placement::greville_points,
                                      Placement::quadrature_points})
      {
        std::vector<double> errors;
        for (const int n : {75, 150, 300, 600, 1200})
          errors.push_back(travel_time(placement, degree, n) / exact - 1.);
        std::ostringstream row;
        row << "| " << degree << " | " << static_cast<int>(placement);
        for (const double error : errors)
          row << " | " << 100 * error;
        for (int k = 0; k < 4; ++k)
          row << " | " << std::log2(std::abs(errors[k] / errors[k + 1]));
        BOOST_TEST_MESSAGE(row.str() << " |");
        // All converge, to one and the same.
        BOOST_TEST(std::abs(errors[4]) < 5e-4);
        BOOST_TEST(std::log2(std::abs(errors[0] / errors[4])) / 4. > 1.6);
      }
}

BOOST_AUTO_TEST_CASE(long_orders_without_synapses)
{
  const double exact =
    travel_time(Placement::greville_points, 3, 3200, false, 5e-6);
  BOOST_TEST_MESSAGE("speed " << 6e-3 / exact << " m/s");
  for (const int degree : {2, 3})
    for (const Placement placement : {Placement::control_coefficients,
                                      Placement::greville_points,
                                      Placement::quadrature_points})
      {
        std::vector<double> errors;
        for (const int n : {200, 400, 800})
          errors.push_back(
            travel_time(placement, degree, n, false, 5e-6) / exact - 1.);
        std::ostringstream row;
        row << "| " << degree << " | " << static_cast<int>(placement);
        for (const double error : errors)
          row << " | " << 100 * error;
        for (int k = 0; k < 2; ++k)
          row << " | " << std::log2(std::abs(errors[k] / errors[k + 1]));
        BOOST_TEST_MESSAGE(row.str() << " |");
        // The paper's placement is of order 2 for every degree, others are not.
        const double order = std::log2(std::abs(errors[0] / errors[2])) / 2.;
        if (placement == Placement::control_coefficients)
          BOOST_TEST(std::abs(order - 2.2) < 0.3);
        else
          BOOST_TEST(order > degree + 0.85);
      }
}

BOOST_AUTO_TEST_SUITE_END()
