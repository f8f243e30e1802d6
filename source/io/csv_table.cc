#include "ephyra/io/csv_table.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/io/collective.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace ephyra::io
{
  namespace
  {
    /// A name as a CSV cell: quoted where it holds a separator.
    std::string
    cell(const std::string &name)
    {
      if (name.find_first_of(",\"") == std::string::npos)
        return name;
      std::string quoted = "\"";
      for (const char c : name)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
      return quoted + "\"";
    }

    std::string
    join(const std::vector<std::string> &cells)
    {
      std::string line;
      for (const std::string &text : cells)
        line += (line.empty() ? "" : ",") + text;
      return line + "\n";
    }

    /// The shortest text that reads back to the same number.
    std::string
    number(const double x)
    {
      char       text[32];
      const auto end = std::to_chars(text, text + sizeof(text), x).ptr;
      return std::string(text, end);
    }

    std::string
    row(const std::vector<double> &values)
    {
      std::vector<std::string> cells;
      cells.reserve(values.size());
      for (const double x : values)
        cells.push_back(number(x));
      return join(cells);
    }

    std::string
    header_of(const std::vector<std::string> &columns)
    {
      std::vector<std::string> cells;
      for (const std::string &name : columns)
        cells.push_back(cell(name));
      return join(cells);
    }

    /// The lines of a file that a run resumed at @p last keeps.
    std::string
    kept_rows(const std::string &file_name,
              const std::string &header,
              const std::size_t  n_columns,
              const double       last)
    {
      std::ifstream in(file_name);
      std::string   line;
      std::getline(in, line);
      EphyraThrowIf(line + "\n" != header,
                    InputError,
                    "The table " << file_name << " has the columns '" << line
                                 << "', the resumed run writes '"
                                 << header.substr(0, header.size() - 1)
                                 << "': resume with the scene that wrote it.");
      const double limit = last + 1e-10 * std::abs(last);
      std::string  rows;
      while (std::getline(in, line) && !in.eof())
        if (std::count(line.begin(), line.end(), ',') + 1 ==
              static_cast<std::ptrdiff_t>(n_columns) &&
            std::strtod(line.c_str(), nullptr) <= limit)
          rows += line + "\n";
      return rows;
    }

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
    , header(header_of(columns))
    , n_columns(columns.size())
    , comm(comm)
  {
  }

  void
  CsvTable::start()
  {
    on_first_rank(comm, [&]() {
      create_parent_folder(file_name);
      replace_file(file_name, header);
      out.open(file_name, std::ios::app);
    });
  }

  void
  CsvTable::resume(const double last)
  {
    on_first_rank(comm, [&]() {
      create_parent_folder(file_name);
      std::string rows;
      if (std::filesystem::exists(file_name))
        rows = kept_rows(file_name, header, n_columns, last);
      replace_file(file_name, header + rows);
      out.open(file_name, std::ios::app);
    });
  }

  void
  CsvTable::add_row(const std::vector<double> &values)
  {
    on_first_rank(comm, [&]() {
      EphyraAssert(values.size() == n_columns, "a row lacks columns");
      out << row(values) << std::flush;
      EphyraThrowIf(!out,
                    InputError,
                    "A row of " << file_name
                                << " cannot be written: check the free space "
                                   "of the folder.");
    });
  }

  void
  write_result(const std::string                                 &file_name,
               const std::vector<std::pair<std::string, double>> &values,
               const MPI_Comm                                     comm)
  {
    on_first_rank(comm, [&]() {
      std::vector<std::string> names;
      std::vector<double>      numbers;
      for (const auto &[name, value] : values)
        {
          names.push_back(name);
          numbers.push_back(value);
        }
      create_parent_folder(file_name);
      replace_file(file_name, header_of(names) + row(numbers));
    });
  }
} // namespace ephyra::io
