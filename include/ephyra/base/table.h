#pragma once

#include <fstream>
#include <string>
#include <vector>

namespace ephyra
{
  /// Numbers in columns, read from a CSV file: a header with names and units
  /// ("time [s],speed [m/s]"), then one row for each line. Lines that begin
  /// with '#' are comments.
  class Table
  {
  public:
    /// Throws InputError with file and line where the file is missing or a row
    /// is not made of as many numbers as there are columns. A file without a
    /// header (all numbers) has columns without names.
    static Table
    read(const std::string &file_name);

    std::size_t
    n_rows() const;
    std::size_t
    n_columns() const;
    /// Names with units; empty where the file has no header.
    const std::vector<std::string> &
    names() const;

    const std::vector<double> &
    column(std::size_t index) const;
    /// By name, with or without its unit: "speed" finds "speed [m/s]". Throws
    /// InputError that names the nearest column.
    const std::vector<double> &
    column(const std::string &name) const;

    /// "speed [m/s]" without the unit: "speed".
    static std::string
    bare_name(const std::string &name);
    /// What stands in brackets at the end: "m/s", "" without one.
    static std::string
    unit(const std::string &name);

  private:
    std::string                      file_name;
    std::vector<std::string>         column_names;
    std::vector<std::vector<double>> columns;
  };

  /// Writes a CSV file row by row, flushed after each, with every digit that is
  /// needed to read the same number back. For use on one rank.
  class TableWriter
  {
  public:
    /// Creates the file, or replaces it. Throws InputError where it cannot be
    /// written; so do the other functions.
    TableWriter(const std::string              &file_name,
                const std::vector<std::string> &columns);

    /// Continues the file of an interrupted run: rows whose first column lies
    /// behind @p last (the time, or step, of the checkpoint), and a row that
    /// was cut off, are removed; the others stay as they are. The file is
    /// created where it is missing. Throws InputError where it has other
    /// columns.
    static TableWriter
    resume(const std::string              &file_name,
           const std::vector<std::string> &columns,
           double                          last);

    /// Removes these rows of a file that exists, whatever its columns.
    static void
    cut(const std::string &file_name, double last);

    void
    write_row(const std::vector<double> &values);

  private:
    TableWriter() = default;

    std::string   file_name;
    std::size_t   n_columns = 0;
    std::ofstream out;
  };
} // namespace ephyra
