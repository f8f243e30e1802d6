// Isolated neuron, section A.1 of Nitti et al. 2023 (10.1016/j.apm.2023.08.003)
// with the parameters of Pallasdies et al. 2019 (10.7554/eLife.50084).
#include "ephyra/electrophysiology/electrophysiology_solver.h"

#include "reference_table.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra::electrophysiology;
using Parameters = ElectrophysiologySolver::Parameters;

namespace
{
  Parameters
  one_epsc(const double time_step)
  {
    Parameters prm;
    prm.stimulus.current    = 0;
    prm.stimulus.epsc_times = {0.};
    prm.time_step           = time_step;
    return prm;
  }

  struct Deviation
  {
    double potential = 0; ///< mV
    double gates     = 0;
    double currents  = 0; ///< of the largest value of each
  };

  /// The columns of currents begin at 9, where there are any.
  Deviation
  from_reference(const Parameters  &prm,
                 const std::string &file = "single_neuron_epsc_at_0.csv")
  {
    ElectrophysiologySolver neuron(prm, MPI_COMM_WORLD);
    const auto              rows = read_reference(file);
    Deviation               worst;
    std::vector<double>     largest(rows[0].size(), 0.);
    for (const auto &row : rows)
      for (std::size_t k = 0; k < row.size(); ++k)
        largest[k] = std::max(largest[k], std::abs(row[k]));
    std::vector<double> gate;
    for (std::size_t i = 1; i < rows.size(); ++i)
      {
        const double t = 1e-3 * rows[i - 1][0];
        BOOST_REQUIRE(neuron.advance(t, 1e-3 * rows[i][0] - t).success);
        worst.potential = std::max(
          worst.potential, std::abs(1e3 * neuron.potential()[0] - rows[i][1]));
        for (int k = 0; k < 7; ++k)
          {
            neuron.gate(k, gate);
            worst.gates =
              std::max(worst.gates, std::abs(gate[0] - rows[i][2 + k]));
          }
        // V/s, as pA over pF in the reference
        const std::vector<double> currents = neuron.currents(0);
        for (std::size_t k = 9; k < rows[i].size(); ++k)
          worst.currents =
            std::max(worst.currents,
                     std::abs(currents[k - 9] / prm.capacitance - rows[i][k]) /
                       largest[k]);
      }
    return worst;
  }

  /// Potential in mV every 10 us.
  std::vector<double>
  trace(const Parameters &prm, const double t_end)
  {
    ElectrophysiologySolver neuron(prm, MPI_COMM_WORLD);
    std::vector<double>     v;
    for (int i = 0; i * 10e-6 < t_end; ++i)
      {
        BOOST_REQUIRE(neuron.advance(i * 10e-6, 10e-6).success);
        v.push_back(1e3 * neuron.potential()[0]);
      }
    return v;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(single_neuron)

BOOST_AUTO_TEST_CASE(trace_follows_the_reference)
{
  const Deviation deviation = from_reference(one_epsc(5e-6));
  BOOST_TEST_MESSAGE("one EPSC: potential " << deviation.potential
                                            << " mV, gates "
                                            << deviation.gates);
  BOOST_TEST(deviation.potential < 0.05);
  BOOST_TEST(deviation.gates < 1e-3);
}

BOOST_AUTO_TEST_CASE(time_steps_are_second_order)
{
  const Deviation coarse = from_reference(one_epsc(20e-6));
  const Deviation fine   = from_reference(one_epsc(5e-6));
  const double    order  = std::log2(coarse.potential / fine.potential) / 2.;
  BOOST_TEST(order > 1.8);
  BOOST_TEST(order < 2.3);
  // The paper's choice, gates with the new potential, is of first order.
  Parameters prm               = one_epsc(20e-6);
  prm.gate_potential           = ElectrophysiologySolver::GatePotential::end;
  const Deviation paper_coarse = from_reference(prm);
  prm.time_step                = 5e-6;
  const Deviation paper_fine   = from_reference(prm);
  const double    paper_order =
    std::log2(paper_coarse.potential / paper_fine.potential) / 2.;
  BOOST_TEST(paper_order < 1.2);
}

BOOST_AUTO_TEST_CASE(rest_peak_shoulder_and_undershoot)
{
  Parameters quiet;
  quiet.stimulus.current         = 0;
  const std::vector<double> rest = trace(quiet, 2e-3);
  BOOST_TEST(rest.back() == -70.762, boost::test_tools::tolerance(1e-5));

  const std::vector<double> v    = trace(one_epsc(5e-6), 60e-3);
  const auto                peak = std::max_element(v.begin(), v.end());
  const double peak_time = 0.01 * (1. + static_cast<double>(peak - v.begin()));
  BOOST_TEST(std::abs(*peak - 45.87) < 0.02);
  BOOST_TEST(std::abs(peak_time - 2.44) < 0.015);
  BOOST_TEST_MESSAGE("rest " << rest.back() << " mV, peak " << *peak << " at "
                             << peak_time << " ms");
  // shoulder: the slowest fall between the peak and 10 ms
  double slowest = 1e9, shoulder = 0, shoulder_time = 0;
  for (std::size_t i = 350; i < 1000; ++i)
    if (v[i] > -40 && v[i] - v[i + 1] < slowest)
      {
        slowest       = v[i] - v[i + 1];
        shoulder      = v[i];
        shoulder_time = 0.01 * static_cast<double>(i + 1);
      }
  BOOST_TEST(std::abs(shoulder + 6.) < 1.5);
  BOOST_TEST(std::abs(shoulder_time - 5.9) < 0.5);
  const auto under = std::min_element(v.begin(), v.end());
  BOOST_TEST_MESSAGE("shoulder "
                     << shoulder << " mV at " << shoulder_time
                     << " ms, undershoot " << *under << " at "
                     << 0.01 * static_cast<double>(under - v.begin() + 1));
  BOOST_TEST(std::abs(*under + 71.1) < 0.01);
  BOOST_TEST(std::abs(0.01 * static_cast<double>(under - v.begin()) - 45.) <
             2.);
}

BOOST_AUTO_TEST_CASE(second_epsc_follows_an_independent_integration)
{
  // At 25 ms the second EPSC causes a second reflux (28.19 ms), at 7 ms none.
  for (const double second : {7e-3, 25e-3})
    {
      Parameters prm          = one_epsc(5e-6);
      prm.stimulus.epsc_times = {0., second};
      const Deviation deviation =
        from_reference(prm,
                       "electrophysiology/single_neuron_epsc_at_0_and_" +
                         std::to_string(std::lround(1e3 * second)) + ".csv");
      BOOST_TEST_MESSAGE("EPSCs at 0 and "
                         << second << " s: potential " << deviation.potential
                         << " mV, gates " << deviation.gates << ", currents "
                         << deviation.currents);
      BOOST_TEST(deviation.potential < 0.05);
      BOOST_TEST(deviation.gates < 1e-3);
      BOOST_TEST(deviation.currents < 2e-3);
    }
}

BOOST_AUTO_TEST_CASE(external_input_always_adds)
{
  // A second EPSC during the spike and after it changes the potential at once.
  const std::vector<double> one = trace(one_epsc(5e-6), 40e-3);
  for (const double second : {7e-3, 25e-3})
    {
      Parameters prm               = one_epsc(5e-6);
      prm.stimulus.epsc_times      = {0., second};
      const std::vector<double> v  = trace(prm, 40e-3);
      const auto                at = static_cast<std::size_t>(second / 10e-6);
      BOOST_TEST(v[at - 2] == one[at - 2], boost::test_tools::tolerance(1e-12));
      BOOST_TEST(v[at + 100] > one[at + 100] + 5.);
    }
}

BOOST_AUTO_TEST_SUITE_END()
