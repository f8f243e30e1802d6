#include "ephyra/base/log.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"

#include <iostream>

namespace ephyra
{
  void
  Log::initialize(const MPI_Comm comm, const bool quiet)
  {
    writes    = mpi::rank(comm) == 0;
    to_screen = writes && !quiet;
  }

  void
  Log::attach_file(const std::string &file_name, const bool append)
  {
    if (!writes)
      return;
    file.close();
    file.clear();
    file.open(file_name, append ? std::ios::app : std::ios::trunc);
    EphyraThrowIf(!file,
                  InputError,
                  "The log file \""
                    << file_name
                    << "\" cannot be written; check the rights of its folder.");
    file << waiting << std::flush;
    waiting.clear();
  }

  void
  Log::line(const std::string &text)
  {
    if (to_screen)
      std::cout << text << std::endl;
    if (file.is_open())
      file << text << std::endl;
    else if (writes)
      waiting += text + "\n";
  }

  void
  Log::warning(const std::string &text)
  {
    ++warnings;
    line("Warning: " + text);
  }

  unsigned int
  Log::n_warnings() const
  {
    return warnings;
  }

  Log &
  log()
  {
    static Log instance;
    return instance;
  }
} // namespace ephyra
