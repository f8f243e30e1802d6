#include "ephyra/electrophysiology/front_tracker.h"

#include "ephyra/base/memory_archive.h"

#include <boost/test/unit_test.hpp>

using ephyra::electrophysiology::FrontTracker;

namespace
{
  /// A front that runs from theta = 1 to @p stop at one tenth in a millisecond.
  FrontTracker
  tracked(const double stop, const double t_end)
  {
    std::vector<double> theta;
    for (int i = 0; i <= 100; ++i)
      theta.push_back(i / 100.);
    FrontTracker        tracker(theta, 0.);
    std::vector<double> v(theta.size());
    for (int k = 1; k * 1e-5 <= t_end + 1e-9; ++k)
      {
        const double front = std::max(stop, 1. - 100. * k * 1e-5);
        for (std::size_t i = 0; i < v.size(); ++i)
          v[i] = theta[i] >= front ? 0.04 : -0.07;
        tracker.record(k * 1e-5, v);
      }
    return tracker;
  }

  bool
  contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(front_tracker)

BOOST_AUTO_TEST_CASE(a_blocked_front_is_told_with_its_place)
{
  const std::string reason = tracked(0.395, 20e-3).why_not_reached(0.2, 20e-3);
  BOOST_TEST(contains(reason, "blocked"));
  BOOST_TEST(contains(reason, "stopped at theta^1 = 0.4 at 0.006"));
}

BOOST_AUTO_TEST_CASE(a_front_on_its_way_is_no_block)
{
  const std::string reason = tracked(0., 5e-3).why_not_reached(0.2, 5e-3);
  BOOST_TEST(!contains(reason, "blocked"));
  BOOST_TEST(contains(reason, "extend \"Time/End time\""));
}

BOOST_AUTO_TEST_CASE(a_front_that_never_began_is_told)
{
  const std::string reason = tracked(2., 5e-3).why_not_reached(0.2, 5e-3);
  BOOST_TEST(contains(reason, "no point of the line"));
}

BOOST_AUTO_TEST_CASE(arrivals_survive_an_archive)
{
  FrontTracker          first = tracked(0.395, 20e-3), second({0., 1.}, 0.);
  ephyra::MemoryArchive archive;
  archive.begin_writing();
  first.serialize(archive);
  second = tracked(2., 1e-3);
  archive.begin_reading();
  second.serialize(archive);
  BOOST_TEST(first.why_not_reached(0.1, 1.) == second.why_not_reached(0.1, 1.));
}

BOOST_AUTO_TEST_SUITE_END()
