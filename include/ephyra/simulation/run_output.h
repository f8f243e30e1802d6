#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/base/output.h"
#include "ephyra/base/parameter_handler.h"
#include "ephyra/base/record.h"
#include "ephyra/base/time_control.h"
#include "ephyra/io/csv_table.h"
#include "ephyra/io/pvd_collection.h"

#include <mpi.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ephyra::simulation
{
  /// Section "Output": what is written how often.
  struct OutputParameters
  {
    Interval statistics;
    Interval profiles;
    Interval fields;
    Interval checkpoints;
    double   result_start = 0; ///< s: means and extrema of result.csv from here

    static void
    declare(ParameterHandler &prm);
    void
    parse(ParameterHandler &prm);
  };

  /// The tables and field files of one run, in its output folder. A table is
  /// opened by its first row. All functions are collective.
  class RunOutput
  {
  public:
    RunOutput(const OutputParameters &parameters,
              const std::string      &folder,
              MPI_Comm                comm);

    /// What exists in the folder is kept up to @p time (s), and continued.
    /// @p statistics has the names of the columns.
    void
    resume(double time, const Record &statistics);

    /// A row of `NAME.csv`, time (s) in the first column.
    void
    add_row(const std::string &name, double time, const Record &record);
    /// A row of `profiles/NAME.csv`: @p values at the points that the column
    /// names @p points state.
    void
    add_profile(const std::string              &name,
                double                          time,
                const std::vector<std::string> &points,
                const std::vector<double>      &values);
    void
    add_fields(const std::string &name, double time, const GridOutput &output);
    void
    add_fields(const std::string  &name,
               double              time,
               const BezierOutput &output);
    void
    add_fields(const std::string &name, double time, const PointOutput &output);

    /// Takes statistics into account for result.csv.
    void
    collect(double time, const Record &record);
    /// result.csv: last value, and smallest, largest and mean since
    /// `result_start`, of every column of the statistics; @p more before them.
    void
    write_result(const Record &more) const;

    /// What result.csv needs to know of the time before a restart.
    void
    serialize(Archive &archive);

    const OutputParameters &
    parameters() const
    {
      return prm;
    }
    const std::string &
    folder() const
    {
      return the_folder;
    }

  private:
    void
    name_columns(const Record &statistics);
    io::CsvTable &
    table(const std::string &name, const std::vector<std::string> &columns);
    io::PvdCollection &
    series(const std::string &name);

    struct Summary
    {
      double last = 0, smallest = 0, largest = 0, integral = 0;
    };

    const OutputParameters                                    prm;
    const std::string                                         the_folder;
    const MPI_Comm                                            comm;
    std::optional<double>                                     resumed_at;
    std::map<std::string, std::unique_ptr<io::CsvTable>>      tables;
    std::map<std::string, std::unique_ptr<io::PvdCollection>> collections;
    std::vector<std::string>                                  summary_names;
    std::vector<Summary>                                      summaries;
    double                                                    summary_time = 0;
    double                                                    covered      = 0;
    bool covered_any = false;
  };
} // namespace ephyra::simulation
