#include "ephyra/electrophysiology/mnn_neuron.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using ephyra::electrophysiology::MnnNeuron;

namespace
{
  /// Largest difference of any gate after one step from 0.3 between a neuron
  /// with a table and one that computes, over potentials from -100 to 100 mV.
  double
  difference(const double interval, const double dt)
  {
    MnnNeuron::Parameters prm;
    prm.table_interval = interval;
    const MnnNeuron with(prm);
    prm.table_interval = 0;
    const MnnNeuron     without(prm);
    const int           n = 2001;
    std::vector<double> v(n), G(7 * n, 0.3), H(7 * n, 0.3);
    for (int i = 0; i < n; ++i)
      v[i] = -0.1 + 1e-4 * i + 0.37e-4;
    with.advance_gates(n, v.data(), dt, G.data(), n);
    without.advance_gates(n, v.data(), dt, H.data(), n);
    double worst = 0;
    for (int i = 0; i < 7 * n; ++i)
      worst = std::max(worst, std::abs(G[i] - H[i]));
    return worst;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(gate_table)

BOOST_AUTO_TEST_CASE(error_falls_with_the_fourth_power_of_the_interval)
{
  const double coarse = difference(0.25e-3, 5e-6),
               fine   = difference(0.0625e-3, 5e-6);
  BOOST_TEST(coarse < 1e-6);
  BOOST_TEST(std::log2(coarse / fine) / 2 > 3.5);
}

BOOST_AUTO_TEST_CASE(long_steps_are_exact_and_stable)
{
  // 5 ms are 30 time constants of the fastest gate.
  const double dt = 5e-3;
  BOOST_TEST(difference(0.25e-3, dt) < 1e-3);
  const MnnNeuron     neuron{MnnNeuron::Parameters()};
  const double        v = -0.07;
  std::vector<double> G(7, 0.3), steady(7);
  neuron.steady_gates(v, steady.data());
  neuron.advance_gates(1, &v, dt, G.data(), 1);
  // Gate c: tau = 0.165 + 7.51 exp(-((-35.22 + 70)/23.12)^2) ms.
  const double tau = 0.165e-3 + 7.51e-3 * std::exp(-std::pow(34.78 / 23.12, 2));
  BOOST_TEST(G[2] == steady[2] + (0.3 - steady[2]) * std::exp(-dt / tau),
             boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(beyond_the_table_gates_are_computed)
{
  MnnNeuron::Parameters prm;
  const MnnNeuron       with(prm);
  prm.table_interval = 0;
  const MnnNeuron without(prm);
  for (const double v : {-0.3, 0.1501, 2., std::nan("")})
    {
      std::vector<double> G(7, 0.3), H(7, 0.3);
      with.advance_gates(1, &v, 5e-6, G.data(), 1);
      without.advance_gates(1, &v, 5e-6, H.data(), 1);
      for (int k = 0; k < 7; ++k)
        BOOST_TEST((G[k] == H[k] || (std::isnan(G[k]) && std::isnan(H[k]))));
    }
}

BOOST_AUTO_TEST_SUITE_END()
