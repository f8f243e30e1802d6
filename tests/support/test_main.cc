// Entry point of every test executable: Boost.Test inside an MPI session.
// Output of ranks other than the first is kept only where a check fails.
#define BOOST_TEST_NO_MAIN
#include <boost/test/unit_test.hpp>

#include <mpi.h>

int
main(int argc, char *argv[])
{
  MPI_Init(&argc, &argv);
  const int failed =
    boost::unit_test::unit_test_main([]() { return true; }, argc, argv);
  int any = 0;
  MPI_Allreduce(&failed, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return any;
}
