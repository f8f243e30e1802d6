#pragma once

#include <mpi.h>

#include <functional>
#include <string>

namespace ephyra::io
{
  /// Runs @p work on every rank. An exception on one rank or several becomes
  /// the Error of the lowest of them on all ranks, so that nobody waits for a
  /// rank that has given up. @p work itself must not communicate. Collective.
  void
  on_every_rank(MPI_Comm comm, const std::function<void()> &work);

  /// Runs @p work on the first rank alone; an exception becomes the same Error
  /// on all ranks. Collective.
  void
  on_first_rank(MPI_Comm comm, const std::function<void()> &work);

  /// Creates a folder and those above it; throws InputError where that fails.
  void
  create_folder(const std::string &folder);

  /// Replaces a file as a whole, through a temporary file beside it: a reader,
  /// or a crash, sees the old text or the new one. Throws InputError.
  void
  replace_file(const std::string &file_name, const std::string &content);
} // namespace ephyra::io
