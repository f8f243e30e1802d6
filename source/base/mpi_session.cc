#include "ephyra/base/mpi_session.h"

#include "ephyra/base/mpi.h"

#include <chrono>
#include <new>
#include <ostream>
#include <string>
#include <thread>

/// Of OpenBLAS; null with another BLAS.
extern "C" void
openblas_set_num_threads(int) __attribute__((weak));

namespace ephyra
{
  MpiSession::MpiSession(int &argc, char **&argv)
  {
    int provided;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_SINGLE, &provided);
    // All parallelism is MPI: threads of the small dense products would fight
    // with other ranks and runs for the cores.
    if (openblas_set_num_threads)
      openblas_set_num_threads(1);
  }

  MpiSession::~MpiSession()
  {
    MPI_Finalize();
  }

  int
  run_program(const std::function<ExitCode()> &program,
              const MPI_Comm                   comm,
              std::ostream                    &errors,
              const double                     patience,
              const std::function<void(int)>  &abort)
  {
    // The ranks that failed meet the others here, apart from all messages that
    // the program may have left unanswered.
    MPI_Comm meeting;
    MPI_Comm_dup(comm, &meeting);
    const int rank = mpi::rank(comm);

    std::string message;
    ExitCode    code = ExitCode::internal_error;
    try
      {
        code = program();
      }
    catch (const Error &error)
      {
        message = error.what();
        code    = error.code;
      }
    catch (const std::bad_alloc &)
      {
        message = "The memory is used up; use a coarser grid, fewer bodies or "
                  "more machines.";
      }
    catch (const std::exception &error)
      {
        message = std::string("Internal error: ") + error.what();
      }
    catch (...)
      {
        message = "Internal error: an unknown exception.";
      }

    // Largest code, and lowest rank that failed (its negative, to maximize).
    const bool  failed  = !message.empty();
    const int   nobody  = -mpi::size(comm);
    int         mine[2] = {static_cast<int>(code), failed ? -rank : nobody};
    int         all[2];
    MPI_Request request;
    MPI_Iallreduce(mine, all, 2, MPI_INT, MPI_MAX, meeting, &request);
    // Lower ranks lose patience first, so that one of them speaks.
    const double deadline = MPI_Wtime() + patience * (1. + 0.1 * rank);
    bool         told     = false;
    for (int done = 0; !done;)
      {
        MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        if (!done && failed && !told && MPI_Wtime() > deadline)
          {
            told = true;
            errors << message << std::endl;
            if (abort)
              abort(static_cast<int>(code));
            else
              MPI_Abort(comm, static_cast<int>(code));
          }
        if (!done)
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    MPI_Comm_free(&meeting);
    if (!told && all[1] == -rank && failed)
      errors << message << std::endl;
    return all[0];
  }
} // namespace ephyra
