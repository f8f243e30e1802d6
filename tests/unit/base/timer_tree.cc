#include "ephyra/base/timer_tree.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"

#include "temporary_folder.h"

#include <boost/test/unit_test.hpp>

#include <chrono>
#include <sstream>
#include <thread>

using namespace ephyra;

BOOST_AUTO_TEST_SUITE(timer_tree)

namespace
{
  void
  wait(const double seconds)
  {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  }

  std::vector<std::string>
  lines(const std::string &text)
  {
    std::vector<std::string> result;
    std::istringstream       stream(text);
    for (std::string line; std::getline(stream, line);)
      result.push_back(line);
    return result;
  }
} // namespace

BOOST_AUTO_TEST_CASE(phases_nest_and_are_summed)
{
  TimerTree tree;
  for (int i = 0; i < 3; ++i)
    {
      TimerTree::Scope flow(tree, "flow");
      wait(0.002);
      TimerTree::Scope poisson(tree, "poisson", 1000.);
      wait(0.004);
    }
  {
    TimerTree::Scope output(tree, "output");
  }
  BOOST_TEST(tree.seconds("flow") >= 3 * 0.006);
  BOOST_TEST(tree.seconds("flow/poisson") >= 3 * 0.004);
  BOOST_TEST(tree.seconds("flow") - tree.seconds("flow/poisson") >= 3 * 0.002);
  BOOST_TEST(tree.seconds("poisson") == 0.);

  std::ostringstream text;
  tree.print(text, MPI_COMM_WORLD);
  const std::vector<std::string> rows = lines(text.str());
  BOOST_REQUIRE(rows.size() == 7u);
  const std::vector<std::string> names{
    "phase", "flow", "  poisson", "  other", "output", "other", "total"};
  for (std::size_t i = 0; i < rows.size(); ++i)
    BOOST_TEST(rows[i].substr(0, names[i].size() + 1) == names[i] + " ");
  std::istringstream poisson(rows[2]);
  std::string        name;
  double             seconds, share, calls, nanoseconds;
  poisson >> name >> seconds >> share >> calls >> nanoseconds;
  BOOST_TEST(calls == 3);
  BOOST_TEST(nanoseconds == seconds * 1e9 / 3000,
             boost::test_tools::tolerance(0.05));
}

BOOST_AUTO_TEST_CASE(phases_of_all_ranks_are_merged)
{
  TimerTree tree;
  const int rank = mpi::rank(MPI_COMM_WORLD), size = mpi::size(MPI_COMM_WORLD);
  {
    TimerTree::Scope both(tree, "both", 10. + rank);
    TimerTree::Scope own(tree, rank == 0 ? "first" : "others");
  }
  testing::TemporaryFolder folder;
  tree.write_csv(folder.file("timing.csv"), MPI_COMM_WORLD);
  MPI_Barrier(MPI_COMM_WORLD);
  const std::vector<std::string> rows =
    lines(testing::read_whole_file(folder.file("timing.csv")));
  BOOST_REQUIRE(rows.size() == (size == 1 ? 4u : 5u));
  BOOST_TEST(rows[0] ==
             "phase,calls,seconds [s],unknowns,time per unknown [ns]");
  BOOST_TEST(rows[1].substr(0, 7) == "both,1,");
  BOOST_TEST(rows[1].find("," + std::to_string(9 + size) + ",") !=
             std::string::npos);
  BOOST_TEST(rows[2].substr(0, 13) == "both/first,1,");
  if (size > 1)
    BOOST_TEST(rows[3].substr(0, 14) == "both/others,1,");
  BOOST_TEST(rows.back().substr(0, 8) == "total,1,");
  BOOST_CHECK_THROW(
    tree.write_csv(folder.file("none/timing.csv"), MPI_COMM_WORLD), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
