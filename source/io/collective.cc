#include "ephyra/io/collective.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace ephyra::io
{
  void
  on_every_rank(const MPI_Comm comm, const std::function<void()> &work)
  {
    const int   rank = mpi::rank(comm), n_ranks = mpi::size(comm);
    int         culprit = n_ranks;
    int         code    = static_cast<int>(ExitCode::input_error);
    std::string message;
    try
      {
        work();
      }
    catch (const Error &error)
      {
        culprit = rank;
        code    = static_cast<int>(error.code);
        message = error.what();
      }
    catch (const std::exception &error)
      {
        culprit = rank;
        message = error.what();
      }

    MPI_Allreduce(MPI_IN_PLACE, &culprit, 1, MPI_INT, MPI_MIN, comm);
    if (culprit == n_ranks)
      return;
    MPI_Bcast(&code, 1, MPI_INT, culprit, comm);
    mpi::broadcast(message, comm, culprit);
    if (code == static_cast<int>(ExitCode::input_error))
      throw InputError(message);
    throw Error(static_cast<ExitCode>(code), message);
  }

  void
  on_first_rank(const MPI_Comm comm, const std::function<void()> &work)
  {
    const bool first = mpi::rank(comm) == 0;
    on_every_rank(comm, [&]() {
      if (first)
        work();
    });
  }

  void
  create_folder(const std::string &folder)
  {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    EphyraThrowIf(error || !std::filesystem::is_directory(folder),
                  InputError,
                  "The folder " << folder << " cannot be created ("
                                << error.message()
                                << "): choose another one with --output.");
  }

  void
  replace_file(const std::string &file_name, const std::string &content)
  {
    const std::string temporary = file_name + ".tmp";
    std::ofstream     out(temporary, std::ios::binary);
    out << content;
    out.close();
    bool failed = !out;
    if (!failed)
      failed = std::rename(temporary.c_str(), file_name.c_str()) != 0;
    EphyraThrowIf(
      failed,
      InputError,
      "The file " << file_name << " cannot be written (" << std::strerror(errno)
                  << "): free space, or choose another --output folder.");
  }
} // namespace ephyra::io
