#pragma once

#include "ephyra/base/table.h"

#include <mpi.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ephyra::io
{
  /// A TableWriter for all ranks: the first one writes, errors reach all of
  /// them, and the folder is created where needed. Used for statistics, probes
  /// and profiles; the first column (time or step) increases. All functions
  /// are collective and throw InputError.
  class CsvTable
  {
  public:
    /// Nothing is written before start() or resume().
    CsvTable(const std::string              &file_name,
             const std::vector<std::string> &columns,
             MPI_Comm                        comm);

    /// Starts an empty file, in a folder that is created where needed.
    void
    start();

    /// Continues the file, without the rows whose first column is larger than
    /// @p last, nor one that was cut off; starts a new one where there is none.
    /// The columns must be those of the file.
    void
    resume(double last);

    /// Adds a row, flushed. Only the values of the first rank count.
    void
    add_row(const std::vector<double> &values);

  private:
    const std::string              file_name;
    const std::vector<std::string> columns;
    const MPI_Comm                 comm;
    std::unique_ptr<TableWriter>   writer; ///< on the first rank
  };

  /// Writes a table of one row, such as result.csv: pairs of a name, with unit,
  /// and a value. Collective; throws InputError.
  void
  write_result(const std::string                                 &file_name,
               const std::vector<std::pair<std::string, double>> &values,
               MPI_Comm                                           comm);
} // namespace ephyra::io
