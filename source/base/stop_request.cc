#include "ephyra/base/stop_request.h"

#include "ephyra/base/mpi.h"

#include <algorithm>
#include <csignal>
#include <filesystem>

namespace ephyra
{
  namespace
  {
    volatile std::sig_atomic_t received = 0;

    constexpr int    signals[] = {SIGTERM, SIGINT, SIGUSR1};
    struct sigaction handlers_before[3];

    extern "C" void
    remember_signal(const int signal)
    {
      received = signal;
    }
  } // namespace

  StopRequest::StopRequest(const std::string &output_folder,
                           const double       wall_time_limit,
                           const MPI_Comm     comm)
    : stop_file((std::filesystem::path(output_folder) / "stop").string())
    , limit(wall_time_limit)
    , comm(comm)
    , start(MPI_Wtime())
    , last_call(start)
  {
    received = 0;
    for (int i = 0; i < 3; ++i)
      {
        struct sigaction action = {};
        action.sa_handler       = remember_signal;
        // The second SIGINT or SIGTERM meets the default action.
        action.sa_flags = SA_RESTART;
        if (signals[i] != SIGUSR1)
          action.sa_flags |= static_cast<int>(SA_RESETHAND);
        sigemptyset(&action.sa_mask);
        sigaction(signals[i], &action, &handlers_before[i]);
      }
  }

  StopRequest::~StopRequest()
  {
    for (int i = 0; i < 3; ++i)
      sigaction(signals[i], &handlers_before[i], nullptr);
  }

  std::string
  StopRequest::reason()
  {
    // Signals may reach any rank; clock and folder are those of the first.
    enum Cause
    {
      none,
      file,
      clock,
      user_signal,
      interrupt_signal,
      terminate_signal
    };
    int       cause  = none;
    const int signal = received;
    if (signal != 0)
      cause = signal == SIGTERM  ? terminate_signal
              : signal == SIGINT ? interrupt_signal
                                 : user_signal;
    else if (mpi::rank(comm) == 0)
      {
        const double now = MPI_Wtime();
        longest_step     = std::max(longest_step, now - last_call);
        last_call        = now;
        std::error_code ignored;
        if (limit > 0 && now - start + longest_step > limit)
          cause = clock;
        else if (now >= next_look)
          {
            next_look = now + 1;
            if (std::filesystem::remove(stop_file, ignored))
              cause = file;
          }
      }
    int decision;
    MPI_Allreduce(&cause, &decision, 1, MPI_INT, MPI_MAX, comm);
    switch (decision)
      {
      case file:
        return "the file \"" + stop_file + "\" was found";
      case clock:
        return "the limit of wall time is near";
      case user_signal:
        return "signal SIGUSR1 was received";
      case interrupt_signal:
        return "signal SIGINT was received";
      case terminate_signal:
        return "signal SIGTERM was received";
      default:
        return "";
      }
  }
} // namespace ephyra
