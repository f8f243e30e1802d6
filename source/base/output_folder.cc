#include "ephyra/base/output_folder.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"
#include "ephyra/base/text.h"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>

namespace ephyra
{
  namespace
  {
    namespace fs = std::filesystem;

    /// Tells folders of runs from others; empty.
    const std::string mark = ".ephyra-run";

    void
    write_mark(const fs::path &folder)
    {
      std::ofstream out(folder / mark);
      EphyraThrowIf(!out,
                    InputError,
                    "The output folder "
                      << folder
                      << " cannot be written; check its rights, or name "
                         "another with --output.");
    }

    void
    make_folders(const fs::path &folder)
    {
      std::error_code failure;
      fs::create_directories(folder, failure);
      EphyraThrowIf(failure,
                    InputError,
                    "The output folder "
                      << folder << " cannot be made (" << failure.message()
                      << "); check the rights of the folder above, or name "
                         "another with --output.");
    }

    /// Largest number N of the folders SCENE-N, 0 without any.
    int
    largest_number(const fs::path &root, const std::string &prefix)
    {
      int largest = 0;
      for (const fs::directory_entry &entry : fs::directory_iterator(root))
        {
          const std::string name = entry.path().filename().string();
          if (name.compare(0, prefix.size(), prefix) != 0)
            continue;
          int         number = 0;
          const char *end    = name.data() + name.size();
          const auto [rest, status] =
            std::from_chars(name.data() + prefix.size(), end, number);
          if (status == std::errc() && rest == end)
            largest = std::max(largest, number);
        }
      return largest;
    }

    fs::path
    create_numbered(const fs::path &root, const std::string &scene)
    {
      make_folders(root);
      const std::string prefix = scene + "-";
      for (int number = largest_number(root, prefix) + 1;; ++number)
        {
          std::ostringstream name;
          name << prefix << std::setfill('0') << std::setw(4) << number;
          const fs::path  folder = root / name.str();
          std::error_code failure;
          // False where another run has just taken the number.
          if (fs::create_directory(folder, failure))
            return folder;
          if (failure && !fs::exists(folder))
            make_folders(folder); // says what is wrong
        }
    }

    /// Throws where a folder must not be used.
    void
    refuse_named(const fs::path &folder, const OutputFolder &request)
    {
      std::error_code ignored;
      EphyraThrowIf(
        fs::exists(folder, ignored) && !fs::is_directory(folder, ignored),
        InputError,
        "The output folder "
          << folder << " is a file; name another folder with --output.");
      if (!fs::exists(folder, ignored) || fs::is_empty(folder, ignored))
        return;
      EphyraThrowIf(!OutputFolder::holds_run(folder.string()),
                    InputError,
                    "The output folder "
                      << folder
                      << " holds files that are not those of a run; name "
                         "another folder with --output.");
      EphyraThrowIf(!request.overwrite,
                    InputError,
                    "The output folder "
                      << folder
                      << " already holds a run; continue that run with "
                         "--resume, name another folder with --output, or "
                         "replace it with --overwrite.");
      const fs::path input = fs::weakly_canonical(request.parameter_file);
      const fs::path whole = fs::weakly_canonical(folder);
      const auto [end, rest] =
        std::mismatch(whole.begin(), whole.end(), input.begin(), input.end());
      EphyraThrowIf(!request.parameter_file.empty() && end == whole.end(),
                    InputError,
                    "The output folder "
                      << folder << " holds the parameter file "
                      << text::quote(request.parameter_file)
                      << " of this run and is not emptied; copy the file "
                         "elsewhere first.");
    }

    void
    create_named(const fs::path &folder, const OutputFolder &request)
    {
      refuse_named(folder, request);
      make_folders(folder);
      for (const fs::directory_entry &entry : fs::directory_iterator(folder))
        {
          if (entry.path().filename() == mark)
            continue;
          std::error_code failure;
          fs::remove_all(entry.path(), failure);
          EphyraThrowIf(failure,
                        InputError,
                        "The output folder "
                          << folder << " cannot be emptied ("
                          << failure.message()
                          << "); check its rights, or name another with "
                             "--output.");
        }
    }

    fs::path
    create_on_first_rank(const OutputFolder &request)
    {
      fs::path folder = request.name;
      if (request.name.empty())
        {
          const std::string scene = fs::path(request.parameter_file).stem();
          folder = create_numbered(request.root, scene.empty() ? "run" : scene);
        }
      else
        create_named(folder, request);
      write_mark(folder);
      return folder;
    }

    /// What @p work returns on the first rank; its errors are those of all.
    std::string
    on_first_rank(const MPI_Comm comm, const std::function<std::string()> &work)
    {
      std::string folder, error;
      if (mpi::rank(comm) == 0)
        try
          {
            folder = work();
          }
        catch (const InputError &wrong)
          {
            error = wrong.what();
          }
        catch (const fs::filesystem_error &wrong)
          {
            error = "The output folder cannot be used (" +
                    wrong.code().message() + ": " + wrong.path1().string() +
                    "); name another with --output.";
          }
      mpi::broadcast(folder, comm);
      mpi::broadcast(error, comm);
      if (!error.empty())
        throw InputError(error);
      return folder;
    }
  } // namespace

  std::string
  OutputFolder::create(const MPI_Comm comm) const
  {
    return on_first_rank(
      comm, [this] { return create_on_first_rank(*this).string(); });
  }

  void
  OutputFolder::check(const MPI_Comm comm) const
  {
    on_first_rank(comm, [this] {
      if (!name.empty())
        refuse_named(name, *this);
      return std::string();
    });
  }

  bool
  OutputFolder::holds_run(const std::string &folder)
  {
    std::error_code ignored;
    return fs::exists(fs::path(folder) / mark, ignored);
  }
} // namespace ephyra
