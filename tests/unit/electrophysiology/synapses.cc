#include "ephyra/electrophysiology/synapses.h"

#include "ephyra/base/memory_archive.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using ephyra::electrophysiology::Synapses;

namespace
{
  /// Eq. (44) without the driving force, 1/s for 75 nS and 1 pF.
  double
  epsc(const double t)
  {
    return t <= 0
             ? 0.
             : 75e3 * (1 - std::exp(-t / 20e-3)) *
                 (0.957 * std::exp(-t / 3e-3) + 0.043 * std::exp(-t / 6e-3));
  }

  /// Lets v run linearly from one value to another in one step.
  void
  step(Synapses    &synapses,
       const double t,
       const double dt,
       const double from,
       const double to)
  {
    synapses.advance(t, dt, &from, &to);
  }
} // namespace

BOOST_AUTO_TEST_SUITE(synapses)

BOOST_AUTO_TEST_CASE(external_epscs_add_without_lock_out)
{
  Synapses synapses(Synapses::Parameters(), 1e-12, 1);
  synapses.add_epsc(0, 0., 0.);
  double t = 0;
  for (int i = 0; i < 400; ++i, t += 25e-6)
    {
      if (i == 280)
        synapses.add_epsc(0, 7e-3, t);
      BOOST_TEST(synapses.conductance()[0] == epsc(t) + epsc(t - 7e-3),
                 boost::test_tools::tolerance(1e-9));
      step(synapses, t, 25e-6, -0.08, -0.08);
    }
}

BOOST_AUTO_TEST_CASE(release_is_locked_out_and_reflux_is_not)
{
  Synapses     synapses(Synapses::Parameters(), 1e-12, 1);
  const double dt = 1e-3;
  // crosses -70 mV at a quarter of the step
  step(synapses, 0., dt, -71e-3, -67e-3);
  BOOST_TEST(synapses.last_release()[0] == 0.25e-3,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(synapses.conductance()[0] == epsc(0.75e-3),
             boost::test_tools::tolerance(1e-9));
  // both thresholds in one step, 10 ms later: reflux alone
  step(synapses, 10e-3, dt, -80e-3, 40e-3);
  BOOST_TEST(synapses.last_release()[0] == 0.25e-3,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(synapses.last_reflux()[0] == 10e-3 + dt * 100. / 120.,
             boost::test_tools::tolerance(1e-12));
  // after 30 ms the release is back; downward crossings count for nothing
  step(synapses, 11e-3, dt, 40e-3, -80e-3);
  step(synapses, 30.3e-3, dt, -80e-3, -60e-3);
  BOOST_TEST(synapses.last_release()[0] > 30e-3);
}

BOOST_AUTO_TEST_CASE(rounded_triggers_start_at_the_end_of_the_step)
{
  Synapses::Parameters prm;
  prm.trigger_time = Synapses::TriggerTime::rounded;
  Synapses synapses(prm, 1e-12, 1);
  step(synapses, 0., 1e-3, -71e-3, -67e-3);
  BOOST_TEST(synapses.last_release()[0] == 1e-3);
  BOOST_TEST(std::abs(synapses.conductance()[0]) < 1e-9);
}

BOOST_AUTO_TEST_CASE(state_survives_an_archive)
{
  Synapses              first(Synapses::Parameters(), 1e-12, 1);
  ephyra::MemoryArchive archive;
  step(first, 0., 1e-3, -71e-3, 30e-3);
  archive.begin_writing();
  first.serialize(archive);
  Synapses second(Synapses::Parameters(), 1e-12, 1);
  archive.begin_reading();
  second.serialize(archive);
  step(first, 1e-3, 1e-3, 30e-3, 20e-3);
  step(second, 1e-3, 1e-3, 30e-3, 20e-3);
  BOOST_TEST(first.conductance()[0] == second.conductance()[0]);
  BOOST_TEST(first.last_reflux()[0] == second.last_reflux()[0]);
}

BOOST_AUTO_TEST_SUITE_END()
