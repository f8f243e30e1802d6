#include "ephyra/electrophysiology/stimulus.h"

#include "ephyra/base/exceptions.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using ephyra::electrophysiology::Stimulus;

BOOST_AUTO_TEST_SUITE(stimulus)

BOOST_AUTO_TEST_CASE(the_charge_of_pulses_does_not_depend_on_the_steps)
{
  Stimulus::Parameters prm;
  prm.start     = 0.37e-3;
  prm.frequency = 200;
  prm.n_pulses  = 3;
  const Stimulus stimulus(prm);
  for (const double dt : {7e-6, 0.05e-3, 0.3e-3, 4e-3})
    {
      const int n      = static_cast<int>(std::ceil(20e-3 / dt));
      double    charge = 0;
      for (int i = 0; i < n; ++i)
        charge += dt * stimulus.mean_current(i * dt, dt);
      BOOST_TEST(charge == 3 * 0.1 * 0.1e-3,
                 boost::test_tools::tolerance(1e-9));
    }
}

BOOST_AUTO_TEST_CASE(events_are_edges_and_epscs_in_order)
{
  Stimulus::Parameters prm;
  prm.frequency  = 0.5;
  prm.epsc_times = {2.5, 1.};
  const Stimulus stimulus(prm);
  double         t = -1;
  for (const double expected : {0., 1e-4, 1., 2., 2.0001, 2.5, 4.})
    {
      t = stimulus.next_event(t);
      BOOST_TEST(t == expected, boost::test_tools::tolerance(1e-12));
    }
  const auto epscs = stimulus.epscs(1., 2.5);
  BOOST_TEST(std::distance(epscs[0], epscs[1]) == 1);
  BOOST_TEST((*epscs[0] == 1.));
}

BOOST_AUTO_TEST_CASE(a_single_pulse_ends_the_events)
{
  const Stimulus stimulus((Stimulus::Parameters()));
  BOOST_TEST(std::isinf(stimulus.next_event(1.)));
  BOOST_TEST(stimulus.mean_current(1., 1.) == 0.);
}

BOOST_AUTO_TEST_CASE(overlapping_pulses_are_refused)
{
  Stimulus::Parameters prm;
  prm.frequency = 100;
  prm.duration  = 20e-3;
  BOOST_CHECK_THROW(Stimulus{prm}, ephyra::InputError);
}

BOOST_AUTO_TEST_SUITE_END()
