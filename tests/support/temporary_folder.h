#pragma once

#include "ephyra/base/mpi.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace ephyra::testing
{
  /// An empty folder that all ranks see, removed at the end of its scope.
  /// Construction and destruction are collective.
  class TemporaryFolder
  {
  public:
    TemporaryFolder()
    {
      if (mpi::rank(MPI_COMM_WORLD) == 0)
        {
          std::string pattern =
            (std::filesystem::temp_directory_path() / "ephyra-XXXXXX").string();
          path = mkdtemp(pattern.data());
        }
      mpi::broadcast(path, MPI_COMM_WORLD);
    }

    ~TemporaryFolder()
    {
      MPI_Barrier(MPI_COMM_WORLD);
      std::error_code ignored;
      if (mpi::rank(MPI_COMM_WORLD) == 0)
        std::filesystem::remove_all(path, ignored);
    }

    TemporaryFolder(const TemporaryFolder &) = delete;
    TemporaryFolder &
    operator=(const TemporaryFolder &) = delete;

    std::string
    file(const std::string &name) const
    {
      return path + "/" + name;
    }

    /// Collective; returns the name of the file.
    std::string
    write(const std::string &name, const std::string &content) const
    {
      if (mpi::rank(MPI_COMM_WORLD) == 0)
        {
          std::filesystem::create_directories(
            std::filesystem::path(file(name)).parent_path());
          std::ofstream(file(name), std::ios::binary) << content;
        }
      MPI_Barrier(MPI_COMM_WORLD);
      return file(name);
    }

    std::string path;
  };

  inline std::string
  read_whole_file(const std::string &name)
  {
    std::ostringstream content;
    content << std::ifstream(name, std::ios::binary).rdbuf();
    return content.str();
  }

  /// What an InputError (or another Error) says, "" where none is thrown.
  template <typename Exception, typename Function>
  std::string
  message_of(const Function &function)
  {
    try
      {
        function();
      }
    catch (const Exception &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace ephyra::testing
