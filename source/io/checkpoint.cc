#include "ephyra/io/checkpoint.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"
#include "ephyra/io/collective.h"
#include "ephyra/io/hdf5_archive.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <vector>

namespace ephyra::io
{
  namespace
  {
    /// Raised where the meaning of the files changes.
    constexpr std::int64_t format_version = 1;

    /// A file that no older one can stand in for.
    class OtherScene : public InputError
    {
      using InputError::InputError;
    };

    /// Counts what an HDF5 file needs for the values written to it.
    class SizeArchive : public Archive
    {
    public:
      std::int64_t
      n_bytes() const
      {
        return size;
      }
      bool
      reading() const override
      {
        return false;
      }
      void
      value(const std::string &, double &) override
      {
        add(1);
      }
      void
      value(const std::string &, std::int64_t &) override
      {
        add(1);
      }
      void
      values(const std::string &, std::vector<double> &x) override
      {
        add(static_cast<std::int64_t>(x.size()));
      }
      void
      rows(const std::string &, double *, const RowLayout &layout) override
      {
        add(layout.n_global_rows * layout.n_columns);
      }
      void
      enter(const std::string &) override
      {
      }
      void
      leave() override
      {
      }

    private:
      /// With what describes a dataset: its header, checksum and link.
      void
      add(const std::int64_t n_values)
      {
        size += 1024 + n_values * static_cast<std::int64_t>(sizeof(double));
      }
      std::int64_t size = 0;
    };

    /// Makes sure that a file of so many bytes has room, by making one. HDF5
    /// cannot be left in order once a write has failed.
    void
    reserve(const std::string &file_name, const std::int64_t n_bytes)
    {
      const int file =
        open(file_name.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
      int error = file < 0 ? errno : posix_fallocate(file, 0, n_bytes);
      if (file >= 0)
        close(file);
      if (error == 0)
        return;
      unlink(file_name.c_str());
      throw InputError(
        "Checkpoint " + file_name + " needs " + std::to_string(n_bytes) +
        " bytes that cannot be had (" + std::strerror(error) +
        "): free space or check the permissions of the folder, "
        "and continue with --resume from the checkpoint before.");
    }

    /// The first lines in which two scenes differ, for the error message.
    std::string
    first_difference(const std::string &stored, const std::string &current)
    {
      std::istringstream a(stored), b(current);
      std::string        line_a, line_b;
      while (true)
        {
          const bool more_a = bool(std::getline(a, line_a));
          const bool more_b = bool(std::getline(b, line_b));
          if (line_a != line_b || more_a != more_b || !more_a)
            return "it has '" + (more_a ? line_a : "nothing") +
                   "' where the scene has '" + (more_b ? line_b : "nothing") +
                   "'";
        }
    }
  } // namespace

  Checkpoints::Checkpoints(const std::string &folder,
                           const std::string &scene,
                           const MPI_Comm     comm,
                           const unsigned int n_kept)
    : folder(folder + "/checkpoints")
    , scene(scene)
    , comm(comm)
    , n_kept(n_kept)
  {
  }

  void
  Checkpoints::write(std::int64_t step, double time, const Serialize &serialize)
  {
    char name[40];
    std::snprintf(
      name, sizeof(name), "checkpoint_%09lld.h5", static_cast<long long>(step));
    const std::string file_name = folder + "/" + name;
    const std::string temporary = file_name + ".tmp";
    SizeArchive       size;
    serialize(size);
    on_first_rank(comm, [&]() {
      create_folder(folder);
      reserve(temporary,
              size.n_bytes() + static_cast<std::int64_t>(scene.size()));
    });
    {
      Hdf5Archive  archive(temporary, Hdf5Archive::Mode::write, comm);
      std::int64_t version = format_version, complete = 1;
      std::string  scene_text = scene;
      archive.value("format version", version);
      archive.text("scene", scene_text);
      archive.value("step", step);
      archive.value("time", time);
      {
        const Archive::Group group(archive, "state");
        serialize(archive);
      }
      archive.value("complete", complete);
      archive.close();
    }
    on_first_rank(comm, [&]() {
      std::error_code error;
      std::filesystem::rename(temporary, file_name, error);
      EphyraThrowIf(error,
                    InputError,
                    "Checkpoint "
                      << temporary << " cannot be renamed (" << error.message()
                      << "): check the permissions of " << folder << ".");
    });

    const std::vector<std::string> all = files();
    on_first_rank(comm, [&]() {
      for (std::size_t i = n_kept; i < all.size(); ++i)
        std::filesystem::remove(all[i]);
    });
  }

  std::vector<std::string>
  Checkpoints::files() const
  {
    std::string list;
    on_first_rank(comm, [&]() {
      std::vector<std::string> names;
      if (std::filesystem::is_directory(folder))
        for (const auto &entry : std::filesystem::directory_iterator(folder))
          {
            const std::string name = entry.path().filename().string();
            if (name.rfind("checkpoint_", 0) == 0 &&
                entry.path().extension() == ".h5")
              names.push_back(name);
          }
      std::sort(names.rbegin(), names.rend());
      for (const std::string &name : names)
        list += folder + "/" + name + "\n";
    });
    mpi::broadcast(list, comm);

    std::vector<std::string> result;
    std::istringstream       lines(list);
    for (std::string line; std::getline(lines, line);)
      result.push_back(line);
    return result;
  }

  Checkpoints::State
  Checkpoints::read(const std::string &file_name, const Serialize &serialize)
  {
    State        state;
    Hdf5Archive  archive(file_name, Hdf5Archive::Mode::read, comm);
    std::int64_t version = 0;
    archive.value("format version", version);
    if (version != format_version)
      throw OtherScene("Checkpoint " + file_name + ": its format version is " +
                       std::to_string(version) + ", this program reads " +
                       std::to_string(format_version) +
                       "; use the version that wrote it.");
    std::string stored_scene;
    archive.text("scene", stored_scene);
    if (stored_scene != scene)
      throw OtherScene("Checkpoint " + file_name +
                       ": it belongs to another scene, " +
                       first_difference(stored_scene, scene) +
                       "; resume with the scene that wrote it.");
    EphyraThrowIf(!archive.contains("complete"),
                  InputError,
                  "Checkpoint " << file_name
                                << ": it is incomplete; use another one.");
    state.file = file_name;
    archive.value("step", state.step);
    archive.value("time", state.time);
    {
      const Archive::Group group(archive, "state");
      serialize(archive);
    }
    archive.close();
    return state;
  }

  Checkpoints::State
  Checkpoints::read_latest(const Serialize &serialize)
  {
    const std::vector<std::string> all = files();
    EphyraThrowIf(all.empty(),
                  InputError,
                  "There is no checkpoint in "
                    << folder
                    << ": name the folder of a run that has written one, or "
                       "start again without --resume.");
    std::string warning;
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
      try
        {
          State state   = read(all[i], serialize);
          state.warning = warning;
          return state;
        }
      catch (const OtherScene &)
        {
          throw;
        }
      catch (const InputError &error)
        {
          warning += std::string(error.what()) + " ";
        }
    State state   = read(all.back(), serialize);
    state.warning = warning;
    return state;
  }
} // namespace ephyra::io
