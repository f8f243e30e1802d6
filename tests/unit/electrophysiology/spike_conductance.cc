#include "ephyra/electrophysiology/spike_conductance.h"

#include "ephyra/electrophysiology/mnn_neuron.h"

#include <boost/test/unit_test.hpp>

using namespace ephyra::electrophysiology;

BOOST_AUTO_TEST_SUITE(conductance_of_a_spike)

BOOST_AUTO_TEST_CASE(of_the_jellyfish_neuron)
{
  // An independent program (exponential Euler, 2 us): 10.15/ms, 0.1 ms after
  // the peak.
  BOOST_TEST(spike_conductance(MnnNeuron({}), 1e-12) == 10.15e3,
             boost::test_tools::tolerance(0.01));
}

BOOST_AUTO_TEST_CASE(it_goes_with_the_conductances)
{
  MnnNeuron::Parameters prm;
  prm.g_FT *= 1.5;
  prm.g_ST *= 1.5;
  const double more = MnnNeuron(prm).fastest_rate();
  BOOST_TEST(more > 1.05 * MnnNeuron({}).fastest_rate());
}

BOOST_AUTO_TEST_SUITE_END()
