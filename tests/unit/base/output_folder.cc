#include "ephyra/base/output_folder.h"

#include "ephyra/base/exceptions.h"

#include "temporary_folder.h"

#include <boost/test/unit_test.hpp>

using namespace ephyra;
namespace fs = std::filesystem;

BOOST_AUTO_TEST_SUITE(output_folder)

namespace
{
  std::string
  error(const OutputFolder &request)
  {
    const std::string message = testing::message_of<InputError>(
      [&request] { request.create(MPI_COMM_WORLD); });
    MPI_Barrier(MPI_COMM_WORLD);
    return message;
  }
} // namespace

BOOST_AUTO_TEST_CASE(runs_are_numbered)
{
  const testing::TemporaryFolder folder;
  OutputFolder                   request;
  request.root           = folder.file("output");
  request.parameter_file = "parameters/quick.prm";
  BOOST_TEST(request.create(MPI_COMM_WORLD) ==
             folder.file("output/quick-0001"));
  BOOST_TEST(request.create(MPI_COMM_WORLD) ==
             folder.file("output/quick-0002"));
  // Gaps are not filled, other scenes do not count.
  folder.write("output/quick-0041/x", "");
  folder.write("output/quick-0050-old/x", "");
  folder.write("output/quicker-0060/x", "");
  BOOST_TEST(request.create(MPI_COMM_WORLD) ==
             folder.file("output/quick-0042"));
  BOOST_TEST(fs::is_directory(folder.file("output/quick-0042")));
  BOOST_TEST(OutputFolder::holds_run(folder.file("output/quick-0042")));
  BOOST_TEST(!OutputFolder::holds_run(folder.file("output/quick-0041")));
}

BOOST_AUTO_TEST_CASE(a_run_is_not_overwritten_by_accident)
{
  const testing::TemporaryFolder folder;
  OutputFolder                   request;
  request.name = folder.file("mine/case");
  BOOST_TEST(request.create(MPI_COMM_WORLD) == request.name);
  folder.write("mine/case/statistics.csv", "precious");
  folder.write("mine/case/flow/0001.vtr", "precious");
  BOOST_TEST(error(request) ==
             "The output folder \"" + request.name +
               "\" already holds a run; continue that run with --resume, name "
               "another folder with --output, or replace it with --overwrite.");
  BOOST_TEST(testing::read_whole_file(
               folder.file("mine/case/statistics.csv")) == "precious");
  MPI_Barrier(MPI_COMM_WORLD);

  request.overwrite      = true;
  request.parameter_file = folder.write("mine/case/a.prm", "");
  BOOST_TEST(error(request) ==
             "The output folder \"" + request.name +
               "\" holds the parameter file \"" + request.parameter_file +
               "\" of this run and is not emptied; copy the file elsewhere "
               "first.");
  BOOST_TEST(fs::exists(folder.file("mine/case/statistics.csv")));
  MPI_Barrier(MPI_COMM_WORLD);

  request.parameter_file = folder.write("mine/case.prm", "");
  BOOST_TEST(error(request) == "");
  BOOST_TEST(!fs::exists(folder.file("mine/case/statistics.csv")));
  BOOST_TEST(!fs::exists(folder.file("mine/case/flow")));
  BOOST_TEST(OutputFolder::holds_run(request.name));
}

BOOST_AUTO_TEST_CASE(a_check_changes_nothing)
{
  const testing::TemporaryFolder folder;
  OutputFolder                   request;
  request.name = folder.file("case");
  request.check(MPI_COMM_WORLD);
  BOOST_TEST(!fs::exists(request.name));
  MPI_Barrier(MPI_COMM_WORLD);
  request.create(MPI_COMM_WORLD);
  folder.write("case/statistics.csv", "precious");
  BOOST_TEST(testing::message_of<InputError>([&request] {
               request.check(MPI_COMM_WORLD);
             }).find("already holds a run") != std::string::npos);
  MPI_Barrier(MPI_COMM_WORLD);
  request.overwrite = true;
  request.check(MPI_COMM_WORLD);
  BOOST_TEST(fs::exists(folder.file("case/statistics.csv")));
}

BOOST_AUTO_TEST_CASE(other_folders_are_left_alone)
{
  const testing::TemporaryFolder folder;
  OutputFolder                   request;
  request.name      = folder.file("documents");
  request.overwrite = true;
  folder.write("documents/thesis.tex", "precious");
  BOOST_TEST(error(request) ==
             "The output folder \"" + request.name +
               "\" holds files that are not those of a run; name another "
               "folder with --output.");
  BOOST_TEST(fs::exists(folder.file("documents/thesis.tex")));
  MPI_Barrier(MPI_COMM_WORLD);

  request.name = folder.file("documents/thesis.tex");
  BOOST_TEST(error(request) ==
             "The output folder \"" + request.name +
               "\" is a file; name another folder with --output.");
}

BOOST_AUTO_TEST_CASE(folders_that_cannot_be_made)
{
  OutputFolder request;
  request.name = "/proc/ephyra";
  BOOST_TEST(error(request).find(
               "The output folder \"/proc/ephyra\" cannot be made (") == 0u);
  request.name = "";
  request.root = "/dev/null/output";
  BOOST_TEST(error(request).find(
               "The output folder \"/dev/null/output\" cannot be made (") ==
             0u);
}

BOOST_AUTO_TEST_SUITE_END()
