#include "ephyra/diagnostics/cycles.h"

#include "ephyra/base/memory_archive.h"
#include "record_value.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <sstream>

using namespace ephyra;
using diagnostics::Cycles;
using test::value;

namespace
{
  constexpr double period = 2., start = 0.3, mass = 3.;

  /// Swims with a speed of two peaks on a mean that grows with time.
  Cycles::Instant
  swimmer(const double t)
  {
    const double phase = 2. * M_PI * (t - start) / period;
    // Speed 1 + t / 10 + sin(phase) + sin(2 phase)
    Cycles::Instant now;
    now.time  = t;
    now.speed = 1. + 0.1 * t + std::sin(phase) + std::sin(2. * phase);
    now.position =
      t + 0.05 * t * t -
      (std::cos(phase) + 0.5 * std::cos(2. * phase)) * period / (2. * M_PI);
    now.margin       = 0.8 + 0.1 * std::cos(phase);
    now.inner_margin = now.margin - 0.1;
    now.widest       = 0.9 + 0.05 * std::cos(phase);
    now.muscle_work  = t + std::sin(phase);
    now.fluid_work   = 0.4 * t;
    return now;
  }

  Cycles
  make()
  {
    return Cycles({period, start, "0.5*U^2"}, {1., 0.9, mass, true});
  }
} // namespace

BOOST_AUTO_TEST_CASE(measures_of_a_known_swimmer)
{
  // The steps do not meet the ends of the cycles.
  const double                           dt     = 1.03e-3;
  Cycles                                 cycles = make();
  std::vector<std::pair<double, Record>> rows;
  for (int n = 0; n * dt < start + 2.5 * period; ++n)
    for (const auto &row : cycles.add(swimmer(n * dt)))
      rows.push_back(row);
  BOOST_REQUIRE_EQUAL(rows.size(), 2);

  double mean_before = 0.;
  for (int k = 0; k < 2; ++k)
    {
      const Record &row  = rows[k].second;
      const double  from = start + k * period, to = from + period;
      const double  mean =
        (swimmer(to).position - swimmer(from).position) / period;
      BOOST_TEST(rows[k].first == to, boost::test_tools::tolerance(1e-12));
      BOOST_TEST(value(row, "cycle [-]") == k + 1);
      const auto is = [&](const std::string &name,
                          const double       expected,
                          const double       tolerance) {
        BOOST_TEST(value(row, name) == expected,
                   boost::test_tools::tolerance(tolerance));
      };
      is("mean speed [m/s]", mean, 1e-6);
      is("change of mean speed [-]", (mean - mean_before) / mean, 1e-5);
      mean_before = mean;
      is("distance [m]", mean * period, 1e-6);
      // Peaks of sin x + sin 2x + 0.1 t, by Newton's method on its slope.
      const auto peak = [&](double t) {
        for (int i = 0; i < 50; ++i)
          {
            const double w = 2. * M_PI / period, x = w * (t - start);
            t -= (0.1 + w * (std::cos(x) + 2. * std::cos(2. * x))) /
                 (-w * w * (std::sin(x) + 4. * std::sin(2. * x)));
          }
        return t;
      };
      const double first = peak(from + 0.15 * period);
      const double other = peak(from + 0.63 * period);
      is("peak speed [m/s]", swimmer(first).speed, 1e-5);
      BOOST_TEST(
        std::abs(value(row, "time of peak speed [s]") - (first - from)) < dt);
      is("second peak speed [m/s]", swimmer(other).speed, 1e-5);
      BOOST_TEST(std::abs(value(row, "time of second peak speed [s]") -
                          (other - from)) < dt);
      is("drop of margin diameter [-]", 0.3, 1e-5);
      is("drop of inner margin diameter [-]", 1. - 0.6 / 0.9, 1e-5);
      is("drop of widest diameter [-]", 0.15, 1e-5);
      is("Strouhal number [-]", 0.3 / (period * mean), 1e-5);
      is("Strouhal number of excursion [-]", 0.4 / (period * mean), 1e-5);
      is("muscle work [J]", period, 1e-5);
      // d/dt (t + sin phase) is negative where cos(phase) < -1 / pi.
      const double positive =
        2. * std::acos(-1. / M_PI) / (2. * M_PI) * period +
        2. * std::sin(std::acos(-1. / M_PI));
      is("positive muscle work [J]", positive, 1e-5);
      is("cost of transport [J/(kg m)]",
         positive / (mass * mean * period),
         1e-5);
      is("net cost of transport [J/(kg m)]", 1. / (mass * mean), 1e-5);
      is("work on fluid [J]", 0.4 * period, 1e-5);
      const double useful = 0.5 * mean * mean * mean * period;
      is("efficiency [-]", useful / positive, 1e-5);
      is("net efficiency [-]", useful / period, 1e-5);
    }
  Record result;
  cycles.add_results(result);
  BOOST_TEST(value(result, "mean speed of last cycle [m/s]") == mean_before,
             boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(a_swimmer_without_a_second_peak)
{
  Cycles cycles({period, 0., "0"}, {1., 0., mass, false});
  std::vector<std::pair<double, Record>> rows;
  for (int n = 0; n <= 200; ++n)
    {
      Cycles::Instant now;
      now.time  = n * period / 200.;
      now.speed = std::sin(M_PI * now.time / period);
      for (const auto &row : cycles.add(now))
        rows.push_back(row);
    }
  BOOST_REQUIRE_EQUAL(rows.size(), 1);
  BOOST_TEST(std::isnan(value(rows[0].second, "second peak speed [m/s]")));
  BOOST_TEST(value(rows[0].second, "mean speed [m/s]") == 0.);
  for (const auto &column : rows[0].second.all())
    BOOST_TEST(column.first.find("work") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_restart_inside_of_a_cycle_changes_nothing)
{
  const double  dt    = 7e-3;
  Cycles        whole = make(), part = make(), restarted = make();
  MemoryArchive archive;
  std::string   wholes, parts;
  const auto    text = [](const std::vector<std::pair<double, Record>> &rows) {
    std::ostringstream out;
    out.precision(17);
    for (const auto &[time, record] : rows)
      for (const auto &[name, x] : record.all())
        out << time << name << x;
    return out.str();
  };
  for (int n = 0; n * dt < start + 3.5 * period; ++n)
    {
      const Cycles::Instant now = swimmer(n * dt);
      wholes += text(whole.add(now));
      parts += text((n <= 500 ? part : restarted).add(now));
      if (n == 500)
        {
          archive.begin_writing();
          part.serialize(archive);
          archive.begin_reading();
          restarted.serialize(archive);
        }
    }
  BOOST_TEST(!wholes.empty());
  BOOST_TEST(wholes == parts);
}
