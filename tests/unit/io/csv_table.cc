#include "ephyra/io/csv_table.h"

#include "files.h"

#include <boost/test/unit_test.hpp>

using namespace ephyra;

namespace
{
  const std::vector<std::string> columns = {"time [s]", "a, b [m]"};

  void
  append(const std::string &file_name, const std::string &text)
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (mpi::rank(MPI_COMM_WORLD) == 0)
      std::ofstream(file_name, std::ios::app) << text;
    MPI_Barrier(MPI_COMM_WORLD);
  }

  std::string
  content(const std::string &file_name)
  {
    MPI_Barrier(MPI_COMM_WORLD);
    const std::string text = test::read_file(file_name);
    MPI_Barrier(MPI_COMM_WORLD);
    return text;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(csv_table)

BOOST_AUTO_TEST_CASE(numbers_read_back_to_the_last_bit)
{
  test::Folder      folder(MPI_COMM_WORLD);
  const std::string file = folder.name + "/probes/a.csv";
  io::CsvTable      table(file, columns, MPI_COMM_WORLD);
  table.start();
  table.add_row({0.1, 1. / 3.});
  table.add_row({1e-300, -2.5e7});
  BOOST_TEST(
    content(file) ==
    "time [s],\"a, b [m]\"\n0.1,0.3333333333333333\n1e-300,-2.5e+07\n");
}

BOOST_AUTO_TEST_CASE(resume_drops_later_and_broken_rows)
{
  test::Folder      folder(MPI_COMM_WORLD);
  const std::string file = folder.name + "/a.csv";
  {
    io::CsvTable table(file, columns, MPI_COMM_WORLD);
    table.start();
    for (const double t : {0., 0.1, 0.2, 0.1 + 0.2, 0.4})
      table.add_row({t, 1.});
  }
  append(file, "0.25");
  io::CsvTable table(file, columns, MPI_COMM_WORLD);
  table.resume(0.3);
  table.add_row({0.5, 2.});
  BOOST_TEST(content(file) == "time [s],\"a, b [m]\"\n0,1\n0.1,1\n0.2,1\n"
                              "0.30000000000000004,1\n0.5,2\n");
}

BOOST_AUTO_TEST_CASE(resume_without_a_file_starts_one)
{
  test::Folder      folder(MPI_COMM_WORLD);
  const std::string file = folder.name + "/a.csv";
  io::CsvTable      table(file, columns, MPI_COMM_WORLD);
  table.resume(1.);
  BOOST_TEST(content(file) == "time [s],\"a, b [m]\"\n");
}

BOOST_AUTO_TEST_CASE(other_columns_are_refused_on_all_ranks)
{
  test::Folder      folder(MPI_COMM_WORLD);
  const std::string file = folder.name + "/a.csv";
  append(file, "time [s],c [K]\n0,1\n");
  io::CsvTable table(file, columns, MPI_COMM_WORLD);
  BOOST_CHECK_EXCEPTION(
    table.resume(1.), InputError, [&](const InputError &error) {
      return std::string(error.what())
               .find("has the columns 'time [s],c [K]'") != std::string::npos;
    });
  BOOST_TEST(content(file) == "time [s],c [K]\n0,1\n");
}

BOOST_AUTO_TEST_CASE(result_is_a_table_of_one_row)
{
  test::Folder      folder(MPI_COMM_WORLD);
  const std::string file = folder.name + "/result.csv";
  io::write_result(file, {{"Cd [1]", 1.09}, {"U [m/s]", 0.5}}, MPI_COMM_WORLD);
  BOOST_TEST(content(file) == "Cd [1],U [m/s]\n1.09,0.5\n");
}

BOOST_AUTO_TEST_SUITE_END()
