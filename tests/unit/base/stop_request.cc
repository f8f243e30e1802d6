#include "ephyra/base/stop_request.h"

#include "temporary_folder.h"

#include <boost/test/unit_test.hpp>

#include <csignal>

using namespace ephyra;

BOOST_AUTO_TEST_SUITE(stop_request)

BOOST_AUTO_TEST_CASE(a_signal_to_one_rank_stops_all)
{
  const int last = mpi::size(MPI_COMM_WORLD) - 1;
  for (const auto &[signal, name] : {std::pair(SIGTERM, "SIGTERM"),
                                     std::pair(SIGINT, "SIGINT"),
                                     std::pair(SIGUSR1, "SIGUSR1")})
    {
      StopRequest stop(".", 0., MPI_COMM_WORLD);
      BOOST_TEST(stop.reason() == "");
      if (mpi::rank(MPI_COMM_WORLD) == last)
        std::raise(signal);
      BOOST_TEST(stop.reason() ==
                 "signal " + std::string(name) + " was received");
    }
}

BOOST_AUTO_TEST_CASE(a_file_stops_once)
{
  const testing::TemporaryFolder folder;
  const std::string              file = folder.write("stop", "");
  {
    StopRequest stop(folder.path, 0., MPI_COMM_WORLD);
    BOOST_TEST(stop.reason() == "the file \"" + file + "\" was found");
  }
  MPI_Barrier(MPI_COMM_WORLD);
  BOOST_TEST(!std::filesystem::exists(file));
  StopRequest stop(folder.path, 0., MPI_COMM_WORLD);
  BOOST_TEST(stop.reason() == "");
}

BOOST_AUTO_TEST_CASE(the_wall_clock_stops_before_its_limit)
{
  StopRequest  stop(".", 0.3, MPI_COMM_WORLD);
  const double start = MPI_Wtime();
  int          calls = 0;
  std::string  reason;
  while ((reason = stop.reason()).empty() && ++calls < 100)
    for (const double until = MPI_Wtime() + 0.1; MPI_Wtime() < until;)
      {
      }
  BOOST_TEST(reason == "the limit of wall time is near");
  BOOST_TEST(calls >= 1);
  BOOST_TEST(MPI_Wtime() - start < 0.6); // 0.3 on an idle machine
  BOOST_TEST(StopRequest(".", 1e-9, MPI_COMM_WORLD).reason() != "");
}

BOOST_AUTO_TEST_SUITE_END()
