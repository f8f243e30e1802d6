#include "ephyra/base/table.h"

#include "ephyra/base/exceptions.h"

#include "temporary_folder.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

using namespace ephyra;
using testing::message_of;

BOOST_AUTO_TEST_SUITE(table)

namespace
{
  bool
  first_rank()
  {
    return mpi::rank(MPI_COMM_WORLD) == 0;
  }
} // namespace

BOOST_AUTO_TEST_CASE(what_is_written_is_read_exactly)
{
  const testing::TemporaryFolder folder;
  const std::string              file = folder.file("a.csv");
  const double                   nan = std::numeric_limits<double>::quiet_NaN();
  if (first_rank())
    {
      TableWriter writer(file, {"time [s]", "speed of bell [m/s]"});
      writer.write_row({0, 1. / 3.});
      writer.write_row({0.1, nan});
      writer.write_row({0.2, 5e-324});
    }
  MPI_Barrier(MPI_COMM_WORLD);
  const Table table = Table::read(file);
  BOOST_TEST(table.n_rows() == 3u);
  BOOST_TEST(table.n_columns() == 2u);
  BOOST_TEST(table.column("time")[1] == 0.1);
  BOOST_TEST(table.column("speed of bell [m/s]")[0] == 1. / 3.);
  BOOST_TEST(std::isnan(table.column(1)[1]));
  BOOST_TEST(table.column(1)[2] == 5e-324);
  BOOST_TEST(Table::unit(table.names()[1]) == "m/s");
  BOOST_TEST(Table::bare_name(table.names()[1]) == "speed of bell");
  BOOST_TEST(message_of<InputError>([&] { table.column("tme"); }) ==
             "The table \"" + file +
               "\" has no column \"tme\", did you mean \"time\"?");
}

BOOST_AUTO_TEST_CASE(bad_tables_are_refused)
{
  const testing::TemporaryFolder folder;
  const auto                     error = [&folder](const std::string &content) {
    const std::string file = folder.write("bad.csv", content);
    const std::string message =
      message_of<InputError>([&file] { Table::read(file); });
    MPI_Barrier(MPI_COMM_WORLD);
    return message;
  };
  const std::string file = folder.file("bad.csv");
  BOOST_TEST(error("# comment\na,b\n1,2\n\n3\n") ==
             file + ":5: there are 1 values instead of 2.");
  BOOST_TEST(error("1,2\n3,x\n") ==
             file + ":2: \"3,x\" is not a row of numbers.");
  BOOST_TEST(error("1,x\n") == file + ":1: \"1,x\" is not a row of numbers.");
  BOOST_TEST(message_of<InputError>([] { Table::read("/nonexistent.csv"); }) ==
             "The table \"/nonexistent.csv\" cannot be read; check its name.");
  BOOST_TEST(message_of<InputError>([&] { Table::read(folder.path); }) ==
             "The table \"" + folder.path +
               "\" cannot be read; check its name.");
}

BOOST_AUTO_TEST_CASE(a_resumed_table_forgets_later_rows)
{
  const testing::TemporaryFolder folder;
  // The last row was cut off by a crash: it has no line end.
  const std::string file = folder.write("a.csv",
                                        "time [s],x\n"
                                        "0.10,1\n"
                                        "0.2,2\n"
                                        "0.30000000000000004,3\n"
                                        "0.4,4\n"
                                        "0.1");
  if (first_rank())
    {
      auto writer = TableWriter::resume(file, {"time [s]", "x"}, 0.3);
      writer.write_row({0.5, 5});
    }
  MPI_Barrier(MPI_COMM_WORLD);
  BOOST_TEST(testing::read_whole_file(file) == "time [s],x\n"
                                               "0.10,1\n"
                                               "0.2,2\n"
                                               "0.30000000000000004,3\n"
                                               "0.5,5\n");
  MPI_Barrier(MPI_COMM_WORLD);
  if (first_rank())
    {
      BOOST_TEST(
        message_of<InputError>([&] {
          TableWriter::resume(file, {"time [s]", "y"}, 0.3);
        }) ==
        "The file \"" + file +
          "\" cannot be continued, it has other columns than this run writes; "
          "resume with the same settings, or move the file away.");
      TableWriter::resume(folder.file("new.csv"), {"time [s]"}, 1.);
      BOOST_TEST(testing::read_whole_file(folder.file("new.csv")) ==
                 "time [s]\n");
    }
}

BOOST_AUTO_TEST_CASE(a_table_that_cannot_be_written_is_an_error)
{
  BOOST_TEST(message_of<InputError>([] {
               TableWriter("/nonexistent/a.csv", {"x"});
             }) == "The file \"/nonexistent/a.csv\" cannot be written; check "
                   "the rights of its folder and the free space.");
  // A device that is always full.
  BOOST_TEST(message_of<InputError>([] { TableWriter("/dev/full", {"x"}); }) !=
             "");
}

BOOST_AUTO_TEST_SUITE_END()
