#include "ephyra/io/csv_table.h"

#include "ephyra/io/collective.h"

#include <filesystem>

namespace ephyra::io
{
  namespace
  {
    void
    create_parent_folder(const std::string &file_name)
    {
      const auto parent = std::filesystem::path(file_name).parent_path();
      if (!parent.empty())
        create_folder(parent.string());
    }
  } // namespace

  CsvTable::CsvTable(const std::string              &file_name,
                     const std::vector<std::string> &columns,
                     const MPI_Comm                  comm)
    : file_name(file_name)
    , columns(columns)
    , comm(comm)
  {
  }

  void
  CsvTable::start()
  {
    on_first_rank(comm, [&]() {
      create_parent_folder(file_name);
      writer = std::make_unique<TableWriter>(file_name, columns);
    });
  }

  void
  CsvTable::resume(const double last)
  {
    on_first_rank(comm, [&]() {
      create_parent_folder(file_name);
      writer = std::make_unique<TableWriter>(
        TableWriter::resume(file_name, columns, last));
    });
  }

  void
  CsvTable::add_row(const std::vector<double> &values)
  {
    on_first_rank(comm, [&]() { writer->write_row(values); });
  }

  void
  write_result(const std::string                                 &file_name,
               const std::vector<std::pair<std::string, double>> &values,
               const MPI_Comm                                     comm)
  {
    std::vector<std::string> names;
    std::vector<double>      numbers;
    for (const auto &[name, value] : values)
      {
        names.push_back(name);
        numbers.push_back(value);
      }
    CsvTable table(file_name, names, comm);
    table.start();
    table.add_row(numbers);
  }
} // namespace ephyra::io
