#include "ephyra/base/mpi_session.h"

#include "ephyra/base/mpi.h"

#include <boost/test/unit_test.hpp>

#include <new>
#include <sstream>
#include <stdexcept>
#include <string>

using namespace ephyra;

BOOST_AUTO_TEST_SUITE(mpi_session)

namespace
{
  struct Result
  {
    int         code;
    std::string message;
  };

  Result
  run(const std::function<ExitCode()> &program)
  {
    std::ostringstream errors;
    const int          code = run_program(program, MPI_COMM_WORLD, errors);
    return {code, errors.str()};
  }
} // namespace

BOOST_AUTO_TEST_CASE(codes_are_returned)
{
  BOOST_TEST(run([] { return ExitCode::success; }).code == 0);
  const Result result = run([] { return ExitCode::interrupted; });
  BOOST_TEST(result.code == 3);
  BOOST_TEST(result.message == "");
}

BOOST_AUTO_TEST_CASE(one_rank_speaks_where_all_fail)
{
  const bool   first  = mpi::rank(MPI_COMM_WORLD) == 0;
  const Result result = run([]() -> ExitCode {
    throw InputError("The bell has no diameter; set one.");
  });
  BOOST_TEST(result.code == 1);
  BOOST_TEST(result.message ==
             (first ? "The bell has no diameter; set one.\n" : ""));
}

BOOST_AUTO_TEST_CASE(kinds_of_exceptions)
{
  const bool first = mpi::rank(MPI_COMM_WORLD) == 0;
  BOOST_TEST(run([]() -> ExitCode { throw DivergedError("NaN."); }).code == 2);
  const Result logic =
    run([]() -> ExitCode { throw std::logic_error("broken"); });
  BOOST_TEST(logic.code == 4);
  BOOST_TEST(logic.message == (first ? "Internal error: broken\n" : ""));
  BOOST_TEST(run([]() -> ExitCode { throw std::bad_alloc(); }).code == 4);
  BOOST_TEST(run([]() -> ExitCode { throw 1; }).code == 4);
}

BOOST_AUTO_TEST_CASE(a_failure_of_the_last_rank_reaches_all)
{
  const int    rank   = mpi::rank(MPI_COMM_WORLD);
  const bool   last   = rank == mpi::size(MPI_COMM_WORLD) - 1;
  const Result result = run([last]() -> ExitCode {
    if (last)
      throw DivergedError("Here it diverged.");
    return ExitCode::success;
  });
  BOOST_TEST(result.code == 2);
  BOOST_TEST(result.message == (last ? "Here it diverged.\n" : ""));
}

BOOST_AUTO_TEST_CASE(a_rank_that_waits_in_vain_is_ended)
{
  // The first rank waits in a barrier that the last one, which fails, reaches
  // only in place of the abort.
  if (mpi::size(MPI_COMM_WORLD) != 2)
    return;
  const bool         last       = mpi::rank(MPI_COMM_WORLD) == 1;
  int                abort_code = 0;
  std::ostringstream errors;
  MPI_Comm           other;
  MPI_Comm_dup(MPI_COMM_WORLD, &other);
  run_program(
    [&]() -> ExitCode {
      if (last)
        throw DivergedError("Here it diverged.");
      MPI_Barrier(other);
      return ExitCode::success;
    },
    MPI_COMM_WORLD,
    errors,
    0.05,
    [&](const int code) {
      abort_code = code;
      MPI_Barrier(other);
    });
  MPI_Comm_free(&other);
  BOOST_TEST(abort_code == (last ? 2 : 0));
  BOOST_TEST(errors.str() == (last ? "Here it diverged.\n" : ""));
}

BOOST_AUTO_TEST_SUITE_END()
