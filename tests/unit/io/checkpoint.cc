#include "ephyra/io/checkpoint.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"
#include "ephyra/io/hdf5_archive.h"
#include "temporary_folder.h"

#include <boost/test/unit_test.hpp>

using namespace ephyra;

namespace
{
  /// A state with one of each kind; a field of 7 x 4 values with padded rows.
  struct State
  {
    double              time = 0;
    std::int64_t        step = 0;
    std::vector<double> control_values, nothing;
    std::vector<double> field;
    RowLayout           layout;

    explicit State(const MPI_Comm comm)
    {
      const mpi::Share share = mpi::share(7, mpi::rank(comm), mpi::size(comm));
      layout                 = {7, share.first, share.count, 4, 6};
      field.assign(share.count * 6, -1.);
    }

    void
    fill()
    {
      time           = 0.1;
      step           = std::int64_t(1) << 40;
      control_values = {1. / 3., -0., 1e300};
      for (std::int64_t i = 0; i < layout.n_rows; ++i)
        for (int j = 0; j < 4; ++j)
          field[i * 6 + j] = 100. * (layout.first_row + i) + j + 1. / 3.;
    }

    void
    serialize(Archive &archive)
    {
      archive.value("time", time);
      archive.value("step", step);
      const Archive::Group group(archive, "body/bell");
      archive.values("control values", control_values);
      archive.values("nothing", nothing);
      archive.rows("field", field.data(), layout);
    }

    bool
    operator==(const State &other) const
    {
      return time == other.time && step == other.step &&
             control_values == other.control_values &&
             nothing == other.nothing && field == other.field;
    }
  };

  /// Writes checkpoints of steps 1 ... n into the folder.
  void
  write_checkpoints(const std::string &folder, const int n, const MPI_Comm comm)
  {
    io::Checkpoints checkpoints(folder, "set A = 1\nset B = 2\n", comm);
    State           state(comm);
    state.fill();
    for (int step = 1; step <= n; ++step)
      checkpoints.write(
        step, 0.5 * step, [&](Archive &archive) { state.serialize(archive); });
  }

  void
  overwrite(const std::string &file_name, const std::string &bytes)
  {
    if (mpi::rank(MPI_COMM_WORLD) == 0)
      std::ofstream(file_name, std::ios::binary) << bytes;
    MPI_Barrier(MPI_COMM_WORLD);
  }

  /// Whether reading throws an InputError with these words on this rank.
  void
  expect_error(io::Checkpoints   &checkpoints,
               const std::string &file,
               const std::string &words)
  {
    State state(MPI_COMM_WORLD);
    BOOST_CHECK_EXCEPTION(
      checkpoints.read(file, [&](Archive &a) { state.serialize(a); }),
      InputError,
      [&](const InputError &error) {
        const std::string text = error.what();
        BOOST_TEST_MESSAGE(text);
        return text.find(words) != std::string::npos &&
               text.find(file) != std::string::npos;
      });
  }
} // namespace

BOOST_AUTO_TEST_SUITE(checkpoint)

BOOST_AUTO_TEST_CASE(written_and_read_on_the_same_ranks)
{
  const MPI_Comm                 comm = MPI_COMM_WORLD;
  const testing::TemporaryFolder folder;
  write_checkpoints(folder.path, 1, comm);

  State expected(comm), state(comm);
  expected.fill();
  state.nothing = {1., 2.};
  io::Checkpoints checkpoints(folder.path, "set A = 1\nset B = 2\n", comm);
  const auto      found = checkpoints.read_latest(
    [&](Archive &archive) { state.serialize(archive); });
  BOOST_TEST((state == expected));
  BOOST_TEST(found.step == 1);
  BOOST_TEST(found.time == 0.5);
}

BOOST_AUTO_TEST_CASE(written_on_all_ranks_and_read_on_one)
{
  const MPI_Comm                 comm = MPI_COMM_WORLD;
  const testing::TemporaryFolder folder;
  write_checkpoints(folder.path, 1, comm);

  State expected(MPI_COMM_SELF), state(MPI_COMM_SELF);
  expected.fill();
  io::Checkpoints checkpoints(
    folder.path, "set A = 1\nset B = 2\n", MPI_COMM_SELF);
  checkpoints.read_latest([&](Archive &archive) { state.serialize(archive); });
  BOOST_TEST((state == expected));
}

BOOST_AUTO_TEST_CASE(written_on_one_rank_and_read_on_all)
{
  const MPI_Comm                 comm = MPI_COMM_WORLD;
  const testing::TemporaryFolder folder;
  if (mpi::rank(comm) == 0)
    write_checkpoints(folder.path, 1, MPI_COMM_SELF);
  MPI_Barrier(comm);

  State expected(comm), state(comm);
  expected.fill();
  io::Checkpoints checkpoints(folder.path, "set A = 1\nset B = 2\n", comm);
  checkpoints.read_latest([&](Archive &archive) { state.serialize(archive); });
  BOOST_TEST((state == expected));
}

BOOST_AUTO_TEST_CASE(two_newest_are_kept)
{
  const MPI_Comm                 comm = MPI_COMM_WORLD;
  const testing::TemporaryFolder folder;
  write_checkpoints(folder.path, 4, comm);
  const std::string base = folder.path + "/checkpoints/checkpoint_00000000";
  BOOST_TEST(!std::filesystem::exists(base + "2.h5"));
  BOOST_TEST(std::filesystem::exists(base + "3.h5"));
  BOOST_TEST(std::filesystem::exists(base + "4.h5"));
  BOOST_TEST(!std::filesystem::exists(base + "4.h5.tmp"));
}

BOOST_AUTO_TEST_CASE(damaged_newest_is_passed_over)
{
  const MPI_Comm                 comm = MPI_COMM_WORLD;
  const testing::TemporaryFolder folder;
  write_checkpoints(folder.path, 2, comm);
  const std::string newest =
    folder.path + "/checkpoints/checkpoint_000000002.h5";
  const std::string bytes = testing::read_whole_file(newest);
  MPI_Barrier(comm);
  overwrite(newest, bytes.substr(0, bytes.size() / 2));
  State           state(comm);
  io::Checkpoints checkpoints(folder.path, "set A = 1\nset B = 2\n", comm);
  const auto      found = checkpoints.read_latest(
    [&](Archive &archive) { state.serialize(archive); });
  BOOST_TEST(found.step == 1);
  BOOST_TEST(found.warning.find(newest + ": it is truncated") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(errors_are_one_sentence_on_all_ranks)
{
  const MPI_Comm                 comm = MPI_COMM_WORLD;
  const testing::TemporaryFolder folder;
  write_checkpoints(folder.path, 1, comm);
  const std::string file = folder.path + "/checkpoints/checkpoint_000000001.h5";
  const std::string bytes = testing::read_whole_file(file);
  MPI_Barrier(comm);

  io::Checkpoints same(folder.path, "set A = 1\nset B = 2\n", comm);
  io::Checkpoints other(folder.path, "set A = 1\nset B = 3\n", comm);
  expect_error(other,
               file,
               "another scene, it has 'set B = 2' where the scene has "
               "'set B = 3'; resume with the scene that wrote it.");
  expect_error(same, folder.path + "/missing.h5", "it does not exist");

  overwrite(file, bytes.substr(0, bytes.size() - 100));
  expect_error(same, file, "it is truncated or not an HDF5 file");
  overwrite(file, "");
  expect_error(same, file, "it is truncated or not an HDF5 file");
  overwrite(file, std::string(bytes.size(), 'x'));
  expect_error(same, file, "it is truncated or not an HDF5 file");

  // One wrong bit in the values of a field.
  std::string  damaged = bytes;
  const double value   = 302. + 1. / 3.;
  const auto   at =
    damaged.find(std::string(reinterpret_cast<const char *>(&value), 8));
  BOOST_REQUIRE(at != std::string::npos);
  damaged[at] ^= 1;
  overwrite(file, damaged);
  expect_error(same, file, "state/body/bell/field is damaged");
}

BOOST_AUTO_TEST_CASE(incomplete_and_unfit_files_are_refused)
{
  const MPI_Comm                 comm = MPI_COMM_WORLD;
  const testing::TemporaryFolder folder;
  const std::string              file    = folder.path + "/a.h5";
  std::string                    scene   = "set A = 1\n";
  std::int64_t                   version = 1;
  {
    io::Hdf5Archive archive(file, io::Hdf5Archive::Mode::write, comm);
    archive.value("format version", version);
    archive.text("scene", scene);
    archive.close();
  }
  io::Checkpoints checkpoints(folder.path, scene, comm);
  expect_error(checkpoints, file, "it is incomplete");
  {
    io::Hdf5Archive archive(file, io::Hdf5Archive::Mode::write, comm);
    archive.value("format version", ++version);
    archive.close();
  }
  expect_error(checkpoints, file, "its format version is 2");

  // Another size of the grid, and a value that is not there.
  State state(comm);
  state.fill();
  {
    io::Hdf5Archive archive(file, io::Hdf5Archive::Mode::write, comm);
    state.serialize(archive);
    archive.close();
  }
  io::Hdf5Archive archive(file, io::Hdf5Archive::Mode::read, comm);
  state.layout.n_columns = 5;
  BOOST_CHECK_EXCEPTION(
    state.serialize(archive), InputError, [](const InputError &error) {
      return std::string(error.what())
               .find("body/bell/field has 7 x 4 values, "
                     "the scene has 7 x 5") != std::string::npos;
    });
  BOOST_CHECK_EXCEPTION(
    archive.value("gamma", state.time),
    InputError,
    [](const InputError &error) {
      return std::string(error.what()).find("it does not hold gamma") !=
             std::string::npos;
    });
}

BOOST_AUTO_TEST_CASE(missing_and_unwritable_folders)
{
  const MPI_Comm                 comm = MPI_COMM_WORLD;
  const testing::TemporaryFolder folder;
  const auto                     nothing = [](Archive &) {};
  io::Checkpoints                empty(folder.path, "", comm);
  BOOST_CHECK_EXCEPTION(
    empty.read_latest(nothing), InputError, [](const InputError &error) {
      return std::string(error.what()).find("There is no checkpoint in") == 0;
    });
  io::Checkpoints unwritable("/proc/ephyra", "", comm);
  BOOST_CHECK_THROW(unwritable.write(1, 0., nothing), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
