#include "ephyra/base/log.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"

#include "temporary_folder.h"

#include <boost/test/unit_test.hpp>

using namespace ephyra;

BOOST_AUTO_TEST_SUITE(log_of_a_run)

BOOST_AUTO_TEST_CASE(the_first_rank_writes)
{
  testing::TemporaryFolder folder;
  const std::string        file = folder.file("log.txt");
  {
    Log log;
    log.initialize(MPI_COMM_WORLD, true);
    log.line("before");
    log.attach_file(file);
    log.line("first");
    log.warning("the grid is coarse");
    BOOST_TEST(log.n_warnings() == 1u);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  BOOST_TEST(testing::read_whole_file(file) ==
             "before\nfirst\nWarning: the grid is coarse\n");
  MPI_Barrier(MPI_COMM_WORLD);
  {
    Log log;
    log.initialize(MPI_COMM_WORLD, true);
    log.attach_file(file, true);
    log.line("resumed");
  }
  MPI_Barrier(MPI_COMM_WORLD);
  BOOST_TEST(testing::read_whole_file(file) ==
             "before\nfirst\nWarning: the grid is coarse\nresumed\n");
}

BOOST_AUTO_TEST_CASE(a_missing_folder_is_an_input_error)
{
  if (mpi::rank(MPI_COMM_WORLD) != 0)
    return;
  Log log;
  BOOST_TEST(testing::message_of<InputError>(
               [&] { log.attach_file("/nonexistent/log.txt"); }) ==
             "The log file \"/nonexistent/log.txt\" cannot be written; check "
             "the rights of its folder.");
}

BOOST_AUTO_TEST_SUITE_END()
