#include "ephyra/base/table.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/text.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <stdexcept>

namespace ephyra
{
  namespace
  {
    std::vector<std::string>
    split(const std::string &line)
    {
      std::vector<std::string> fields;
      std::size_t              start = 0;
      for (std::size_t comma; (comma = line.find(',', start)) != line.npos;
           start = comma + 1)
        fields.push_back(text::normalize(line.substr(start, comma - start)));
      fields.push_back(text::normalize(line.substr(start)));
      return fields;
    }

    /// Plain numbers, "nan" and "inf" included.
    bool
    parse(const std::string &field, double &value)
    {
      const char *begin = field.data(), *end = begin + field.size();
      if (begin != end && *begin == '+')
        ++begin;
      const auto [rest, status] = std::from_chars(begin, end, value);
      return status == std::errc() && rest == end;
    }

    /// Number of fields that are numbers.
    std::size_t
    parse_row(const std::vector<std::string> &fields,
              std::vector<double>            &values)
    {
      values.resize(fields.size());
      std::size_t n_numbers = 0;
      for (std::size_t i = 0; i < fields.size(); ++i)
        n_numbers += parse(fields[i], values[i]) ? 1 : 0;
      return n_numbers;
    }

    std::string
    header(const std::vector<std::string> &columns)
    {
      std::string line;
      for (const std::string &name : columns)
        {
          if (name.find_first_of(",\n\"#") != std::string::npos)
            throw std::logic_error("The column name " + name +
                                   " does not fit into a CSV file.");
          line += (line.empty() ? "" : ",") + name;
        }
      return line;
    }

    [[noreturn]] void
    not_writable(const std::string &file_name)
    {
      throw InputError("The file \"" + file_name +
                       "\" cannot be written; check the rights of its folder "
                       "and the free space.");
    }
  } // namespace

  // --- Table ----------------------------------------------------------------

  Table
  Table::read(const std::string &file_name)
  {
    std::error_code ignored;
    std::ifstream   in(file_name);
    EphyraThrowIf(!in || std::filesystem::is_directory(file_name, ignored),
                  InputError,
                  "The table \"" << file_name
                                 << "\" cannot be read; check its name.");
    Table table;
    table.file_name = file_name;
    std::vector<double> values;
    int                 number = 0;
    bool                first  = true;
    for (std::string line; std::getline(in, line);)
      {
        ++number;
        line = text::normalize(line);
        if (line.empty() || line[0] == '#')
          continue;
        const std::vector<std::string> fields    = split(line);
        const std::size_t              n_numbers = parse_row(fields, values);
        if (first)
          {
            first = false;
            table.columns.resize(fields.size());
            if (n_numbers == 0)
              {
                table.column_names = fields;
                continue;
              }
          }
        EphyraThrowIf(fields.size() != table.n_columns(),
                      InputError,
                      file_name << ":" << number << ": there are "
                                << fields.size() << " values instead of "
                                << table.n_columns() << ".");
        EphyraThrowIf(n_numbers != fields.size(),
                      InputError,
                      file_name << ":" << number << ": " << text::quote(line)
                                << " is not a row of numbers.");
        for (std::size_t i = 0; i < values.size(); ++i)
          table.columns[i].push_back(values[i]);
      }
    return table;
  }

  std::size_t
  Table::n_rows() const
  {
    return columns.empty() ? 0 : columns[0].size();
  }

  std::size_t
  Table::n_columns() const
  {
    return columns.size();
  }

  const std::vector<std::string> &
  Table::names() const
  {
    return column_names;
  }

  const std::vector<double> &
  Table::column(const std::size_t index) const
  {
    return columns.at(index);
  }

  const std::vector<double> &
  Table::column(const std::string &name) const
  {
    std::vector<std::string> candidates;
    for (std::size_t i = 0; i < column_names.size(); ++i)
      {
        if (name == column_names[i] || name == bare_name(column_names[i]))
          return columns[i];
        candidates.push_back(bare_name(column_names[i]));
      }
    throw InputError("The table \"" + file_name + "\" has no column " +
                     text::quote(name) + ", " +
                     text::suggestion(name, candidates, "columns"));
  }

  std::string
  Table::bare_name(const std::string &name)
  {
    return unit(name).empty()
             ? name
             : text::normalize(name.substr(0, name.rfind('[')));
  }

  std::string
  Table::unit(const std::string &name)
  {
    const std::size_t open = name.rfind('[');
    if (open == std::string::npos || name.back() != ']')
      return "";
    return name.substr(open + 1, name.size() - open - 2);
  }

  // --- TableWriter ----------------------------------------------------------

  TableWriter::TableWriter(const std::string              &file_name,
                           const std::vector<std::string> &columns)
    : file_name(file_name)
    , n_columns(columns.size())
    , out(file_name, std::ios::trunc)
  {
    out << header(columns) << std::endl;
    if (!out)
      not_writable(file_name);
  }

  TableWriter
  TableWriter::resume(const std::string              &file_name,
                      const std::vector<std::string> &columns,
                      const double                    last)
  {
    if (!std::filesystem::exists(file_name))
      return TableWriter(file_name, columns);

    std::string line;
    std::getline(std::ifstream(file_name), line);
    EphyraThrowIf(line != header(columns),
                  InputError,
                  "The file \""
                    << file_name
                    << "\" cannot be continued, it has other columns than "
                       "this run writes; resume with the same settings, or "
                       "move the file away.");
    cut(file_name, last);

    TableWriter writer;
    writer.file_name = file_name;
    writer.n_columns = columns.size();
    writer.out.open(file_name, std::ios::app);
    if (!writer.out)
      not_writable(file_name);
    return writer;
  }

  void
  TableWriter::cut(const std::string &file_name, const double last)
  {
    // A new file takes the place of the old one only when it is complete.
    const std::string new_file = file_name + ".new";
    {
      std::ifstream in(file_name);
      std::ofstream kept(new_file, std::ios::trunc);
      std::string   line;
      std::getline(in, line);
      kept << line << '\n';
      const std::size_t   n_columns = split(line).size();
      std::vector<double> values;
      const double        limit = last + 1e-9 * std::abs(last);
      while (std::getline(in, line))
        if (!in.eof() && parse_row(split(line), values) == n_columns &&
            values.size() == n_columns && values[0] <= limit)
          kept << line << '\n';
      if (!kept.flush())
        not_writable(new_file);
    }
    std::error_code failure;
    std::filesystem::rename(new_file, file_name, failure);
    if (failure)
      not_writable(file_name);
  }

  void
  TableWriter::write_row(const std::vector<double> &values)
  {
    EphyraAssert(values.size() == n_columns,
                 "a row needs one value for each column");
    std::string line;
    for (std::size_t i = 0; i < values.size(); ++i)
      line += (i == 0 ? "" : ",") + text::number(values[i]);
    out << line << std::endl;
    if (!out)
      not_writable(file_name);
  }
} // namespace ephyra
