// The format is tested with TableWriter; here, what happens on all ranks.
#include "ephyra/io/csv_table.h"

#include "ephyra/base/exceptions.h"
#include "temporary_folder.h"

#include <boost/test/unit_test.hpp>

using namespace ephyra;
using testing::read_whole_file;
using testing::TemporaryFolder;

namespace
{
  const std::vector<std::string> columns = {"time [s]", "x [m]"};

  std::string
  content(const std::string &file_name)
  {
    MPI_Barrier(MPI_COMM_WORLD);
    const std::string text = read_whole_file(file_name);
    MPI_Barrier(MPI_COMM_WORLD);
    return text;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(csv_table)

BOOST_AUTO_TEST_CASE(written_once_whatever_the_number_of_ranks)
{
  const TemporaryFolder folder;
  const std::string     file = folder.file("probes/a.csv");
  {
    io::CsvTable table(file, columns, MPI_COMM_WORLD);
    table.start();
    table.add_row({0.1, 1. / 3.});
    table.add_row({0.2, -2.});
  }
  BOOST_TEST(content(file) ==
             "time [s],x [m]\n0.1,0.3333333333333333\n0.2,-2\n");
  io::CsvTable table(file, columns, MPI_COMM_WORLD);
  table.resume(0.1);
  table.add_row({0.15, 4.});
  BOOST_TEST(content(file) ==
             "time [s],x [m]\n0.1,0.3333333333333333\n0.15,4\n");
}

BOOST_AUTO_TEST_CASE(errors_reach_all_ranks)
{
  const TemporaryFolder folder;
  const std::string     file = folder.write("a.csv", "time [s],c [K]\n0,1\n");
  io::CsvTable          table(file, columns, MPI_COMM_WORLD);
  BOOST_CHECK_THROW(table.resume(1.), InputError);
  BOOST_TEST(content(file) == "time [s],c [K]\n0,1\n");
  io::CsvTable nowhere("/proc/ephyra/a.csv", columns, MPI_COMM_WORLD);
  BOOST_CHECK_THROW(nowhere.start(), InputError);
}

BOOST_AUTO_TEST_CASE(result_is_a_table_of_one_row)
{
  const TemporaryFolder folder;
  const std::string     file = folder.file("result.csv");
  io::write_result(file, {{"Cd [1]", 1.09}, {"U [m/s]", 0.5}}, MPI_COMM_WORLD);
  BOOST_TEST(content(file) == "Cd [1],U [m/s]\n1.09,0.5\n");
}

BOOST_AUTO_TEST_SUITE_END()
