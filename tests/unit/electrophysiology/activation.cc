#include "ephyra/electrophysiology/activation.h"

#include "ephyra/base/memory_archive.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using ephyra::electrophysiology::Activation;

namespace
{
  /// A spike of G_a of the shape sin^2, 12 ms long.
  double
  spike(const double t)
  {
    const double s = std::sin(M_PI * t / 12e-3);
    return t > 0 && t < 12e-3 ? 0.902 * s * s : 0.;
  }

  /// Time at which the spike exceeds a level.
  double
  time_of(const double level)
  {
    return 12e-3 / M_PI * std::asin(std::sqrt(level / 0.902));
  }

  double
  gate(const double t, const double second_spike)
  {
    return spike(t) + spike(t - second_spike);
  }

  /// One point that saw spikes at 0 and at another time.
  Activation
  recorded(const Activation::Parameters &prm,
           const double                  second_spike,
           const double                  t_end,
           const double                  dt = 5e-6)
  {
    Activation   activation(prm, 1, 0.);
    const double rest = 0;
    activation.initialize(&rest);
    for (int i = 0; i * dt < t_end; ++i)
      {
        const double g = gate((i + 1) * dt, second_spike);
        activation.record(i * dt, dt, &g);
      }
    return activation;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(activation)

BOOST_AUTO_TEST_CASE(continuous_replay_is_the_slow_gate_above_its_threshold)
{
  const Activation activation = recorded({}, 1e9, 20e-3);
  const double     start      = time_of(0.005);
  BOOST_TEST(activation.last_start(0) == start,
             boost::test_tools::tolerance(1e-4));
  BOOST_TEST(activation.value(0, start) < 1e-5);
  double worst = 0;
  for (double t = start; t < 2; t += 1e-3)
    worst = std::max(
      worst,
      std::abs(
        activation.value(0, t) -
        std::max(0., (spike(start + (t - start) / 140) - 0.005) / 0.897)));
  BOOST_TEST(worst < 2e-5);
  BOOST_TEST(activation.n_samples() < 250u);
}

BOOST_AUTO_TEST_CASE(literal_form_jumps_by_0_0055)
{
  Activation::Parameters prm;
  prm.start                   = Activation::Start::literal;
  const Activation activation = recorded(prm, 1e9, 20e-3);
  const double     start      = activation.last_start(0);
  BOOST_TEST(activation.value(0, start - 1e-6) == 0.);
  BOOST_TEST(activation.value(0, start) == 0.005 / 0.902,
             boost::test_tools::tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(a_second_spike_does_not_drop_the_activation)
{
  const double           second  = 0.5; // 2 Hz
  const Activation       largest = recorded({}, second, 0.52);
  Activation::Parameters prm;
  prm.replays             = Activation::Replays::newest;
  const Activation newest = recorded(prm, second, 0.52);

  const double restart = newest.last_start(0);
  BOOST_TEST(restart > 0.5);
  const double before = largest.value(0, restart - 1e-6);
  BOOST_TEST(before > 0.3);
  BOOST_TEST(largest.value(0, restart + 1e-6) == before,
             boost::test_tools::tolerance(1e-4));
  BOOST_TEST(newest.value(0, restart + 1e-6) < 1e-3);
}

BOOST_AUTO_TEST_CASE(a_clipped_activation_stays_at_one)
{
  Activation::Parameters prm;
  prm.peak                 = 0.8; // the spike has 0.902
  const Activation free    = recorded(prm, 1e9, 20e-3);
  prm.clip                 = true;
  const Activation clipped = recorded(prm, 1e9, 20e-3);
  const double     top     = free.last_start(0) + 140 * 5.7e-3;
  BOOST_TEST(free.value(0, top) > 1.1);
  BOOST_TEST(clipped.value(0, top) == 1.);
  BOOST_TEST(clipped.value(0, 0.3) == free.value(0, 0.3));
}

BOOST_AUTO_TEST_CASE(fitted_replays_end_when_the_next_begins)
{
  Activation::Parameters prm;
  prm.fit_to_pacing = true;
  BOOST_TEST(Activation(prm, 1, 0.5).eta() == 1. / 140,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(Activation(prm, 1, 2.).eta() == 2 * 10.1e-3,
             boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(memory_of_ended_replays_is_used_again)
{
  Activation   activation({}, 1, 0.);
  const double rest = 0;
  activation.initialize(&rest);
  const double dt = 1e-4;
  for (int i = 0; i * dt < 20; ++i)
    {
      const double g = spike(std::fmod((i + 1) * dt, 2.));
      activation.record(i * dt, dt, &g);
    }
  BOOST_TEST(activation.n_samples() < 250u);
}

BOOST_AUTO_TEST_CASE(state_survives_an_archive_in_the_middle_of_a_spike)
{
  Activation            first = recorded({}, 1e9, 5e-3);
  Activation            second({}, 1, 0.);
  ephyra::MemoryArchive archive;
  archive.begin_writing();
  first.serialize(archive);
  archive.begin_reading();
  second.serialize(archive);
  for (int i = 1000; i < 3000; ++i)
    {
      const double g = spike((i + 1) * 5e-6);
      first.record(i * 5e-6, 5e-6, &g);
      second.record(i * 5e-6, 5e-6, &g);
    }
  for (const double t : {0.1, 0.5, 1.2})
    BOOST_TEST(first.value(0, t) == second.value(0, t));
  BOOST_TEST(first.value(0, 0.5) > 0.5);
}

BOOST_AUTO_TEST_SUITE_END()
