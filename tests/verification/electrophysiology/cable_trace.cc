// The wave on a cable over its whole length in time, beside an independent
// program with the same discretisation (cable_trace.csv).
#include "ephyra/electrophysiology/electrophysiology_solver.h"

#include "reference_table.h"
#include "straight_line.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra::electrophysiology;

BOOST_AUTO_TEST_SUITE(cable_trace)

BOOST_AUTO_TEST_CASE(long_trace_follows_the_reference)
{
  ElectrophysiologySolver::Parameters prm;
  prm.time_step         = 2.5e-6;
  prm.resting_time_step = 0;
  prm.placement         = Placement::control_coefficients;
  prm.gate_potential    = ElectrophysiologySolver::GatePotential::end;
  prm.stimulus.interval = {{0., 0.04}};
  ElectrophysiologySolver solver(
    prm, straight_line({15e-3, 0}, {15e-3, 20e-3}, 2, 2400), MPI_COMM_WORLD);
  constexpr int       point = 1201;
  std::vector<double> gate;
  double              t = 0, v_10 = 0, v_4 = 0, gate_10 = 0, peak = 0;
  for (const auto &row : read_reference("electrophysiology/cable_trace.csv"))
    {
      // Times are kept to six digits, steps are of 2.5 us.
      const double end = 2.5e-6 * std::round(1e-3 * row[0] / 2.5e-6);
      BOOST_REQUIRE(solver.advance(t, end - t).success);
      t = end;
      solver.gate(0, gate);
      v_10 = std::max(v_10, std::abs(1e3 * solver.potential()[point] - row[1]));
      gate_10 = std::max(gate_10, std::abs(gate[point] - row[2]));
      v_4  = std::max(v_4, std::abs(1e3 * solver.potential_at(0.2) - row[3]));
      peak = std::max(peak, gate[point]);
    }
  BOOST_TEST_MESSAGE("largest differences: potential at 10 mm "
                     << v_10 << " mV, at 4 mm " << v_4 << " mV, G_a at 10 mm "
                     << gate_10 << "; peak of G_a " << peak);
  BOOST_TEST(v_10 < 0.05);
  BOOST_TEST(v_4 < 0.05);
  BOOST_TEST(gate_10 < 1e-3);
  BOOST_TEST(std::abs(peak - 0.902) < 2e-3);
}

BOOST_AUTO_TEST_SUITE_END()
