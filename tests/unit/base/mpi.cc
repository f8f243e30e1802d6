#include "ephyra/base/mpi.h"

#include <boost/test/unit_test.hpp>

#include <ctime>

using namespace ephyra;

BOOST_AUTO_TEST_SUITE(mpi_functions)

namespace
{
  double
  process_clock()
  {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  }
} // namespace

BOOST_AUTO_TEST_CASE(cpu_time_is_that_of_all_ranks)
{
  const double    before = mpi::cpu_time(MPI_COMM_WORLD);
  const double    start  = process_clock();
  volatile double x      = 1;
  while (process_clock() - start < 0.2)
    x = 0.5 * x + 0.5;
  const double clock = mpi::sum(process_clock() - start, MPI_COMM_WORLD);
  // Waiting for the other ranks costs a little more of it.
  const double passed = mpi::cpu_time(MPI_COMM_WORLD) - before;
  BOOST_TEST(passed > 0.95 * clock);
  BOOST_TEST(passed < 2 * clock);
}

BOOST_AUTO_TEST_SUITE_END()
