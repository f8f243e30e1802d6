#include "ephyra/simulation/run_output.h"

#include "ephyra/base/table.h"
#include "ephyra/io/collective.h"

#include <algorithm>
#include <filesystem>

namespace ephyra::simulation
{
  namespace
  {
    void
    declare_interval(ParameterHandler  &prm,
                     const std::string &section,
                     const std::string &time_interval,
                     const int          step_interval)
    {
      const ParameterHandler::Section in(prm, section);
      Interval::declare(prm, time_interval, step_interval);
    }

    Interval
    parse_interval(ParameterHandler &prm, const std::string &section)
    {
      const ParameterHandler::Section in(prm, section);
      Interval                        interval;
      interval.parse(prm);
      return interval;
    }

    /// The tables over time in the folder of a run.
    std::vector<std::string>
    tables_of_run(const std::string &folder)
    {
      namespace fs = std::filesystem;
      std::vector<std::string> result;
      for (const char *name : {"statistics", "iterations", "cycles"})
        if (const fs::path file =
              fs::path(folder) / (name + std::string(".csv"));
            fs::exists(file))
          result.push_back(file.string());
      for (const char *name : {"profiles", "probes"})
        if (const fs::path sub = fs::path(folder) / name; fs::is_directory(sub))
          for (const auto &entry : fs::directory_iterator(sub))
            if (entry.path().extension() == ".csv")
              result.push_back(entry.path().string());
      return result;
    }
  } // namespace

  void
  OutputParameters::declare(ParameterHandler &prm)
  {
    declare_interval(prm, "Statistics", "0", 1);
    declare_interval(prm, "Profiles", "0", 0);
    declare_interval(prm, "Fields", "0", 0);
    declare_interval(prm, "Checkpoints", "0", 0);
    prm.declare_entry("Start of averages",
                      "0",
                      patterns::Double("s", 0.),
                      "Time from which result.csv takes means and extrema.");
  }

  void
  OutputParameters::parse(ParameterHandler &prm)
  {
    statistics   = parse_interval(prm, "Statistics");
    profiles     = parse_interval(prm, "Profiles");
    fields       = parse_interval(prm, "Fields");
    checkpoints  = parse_interval(prm, "Checkpoints");
    result_start = prm.get_double("Start of averages");
  }

  RunOutput::RunOutput(const OutputParameters &parameters,
                       const std::string      &folder,
                       const MPI_Comm          comm)
    : prm(parameters)
    , the_folder(folder)
    , comm(comm)
  {
  }

  void
  RunOutput::resume(const double time, const Record &statistics)
  {
    resumed_at = time;
    name_columns(statistics);
    // Some tables get their next row late, or never.
    io::on_first_rank(comm, [&]() {
      for (const std::string &file : tables_of_run(the_folder))
        TableWriter::cut(file, time);
    });
  }

  void
  RunOutput::name_columns(const Record &statistics)
  {
    summary_names.clear();
    for (const auto &entry : statistics.all())
      summary_names.push_back(entry.first);
    summaries.resize(summary_names.size());
  }

  io::CsvTable &
  RunOutput::table(const std::string              &name,
                   const std::vector<std::string> &columns)
  {
    auto &entry = tables[name];
    if (!entry)
      {
        entry = std::make_unique<io::CsvTable>(
          the_folder + "/" + name + ".csv", columns, comm);
        if (resumed_at)
          entry->resume(*resumed_at);
        else
          entry->start();
      }
    return *entry;
  }

  io::PvdCollection &
  RunOutput::series(const std::string &name)
  {
    auto &entry = collections[name];
    if (!entry)
      {
        entry = std::make_unique<io::PvdCollection>(the_folder, name, comm);
        if (resumed_at)
          entry->resume(*resumed_at);
      }
    return *entry;
  }

  void
  RunOutput::add_row(const std::string &name,
                     const double       time,
                     const Record      &record)
  {
    std::vector<std::string> columns{"time [s]"};
    std::vector<double>      values{time};
    for (const auto &[column, value] : record.all())
      {
        columns.push_back(column);
        values.push_back(value);
      }
    table(name, columns).add_row(values);
  }

  void
  RunOutput::add_profile(const std::string              &name,
                         const double                    time,
                         const std::vector<std::string> &points,
                         const std::vector<double>      &values)
  {
    std::vector<std::string> columns{"time [s]"};
    columns.insert(columns.end(), points.begin(), points.end());
    std::vector<double> row{time};
    row.insert(row.end(), values.begin(), values.end());
    table("profiles/" + name, columns).add_row(row);
  }

  void
  RunOutput::add_fields(const std::string &name,
                        const double       time,
                        const GridOutput  &output)
  {
    series(name).write(time, output);
  }

  void
  RunOutput::add_fields(const std::string  &name,
                        const double        time,
                        const BezierOutput &output)
  {
    series(name).write(time, output);
  }

  void
  RunOutput::add_fields(const std::string &name,
                        const double       time,
                        const PointOutput &output)
  {
    series(name).write(time, output);
  }

  void
  RunOutput::collect(const double time, const Record &record)
  {
    if (summary_names.empty())
      name_columns(record);
    const bool   counts   = time >= prm.result_start;
    const double duration = counts && covered_any ? time - summary_time : 0.;
    for (std::size_t k = 0; k < summaries.size(); ++k)
      {
        Summary     &s     = summaries[k];
        const double value = record.all()[k].second;
        if (counts)
          {
            s.integral += 0.5 * duration * (s.last + value);
            s.smallest = covered_any ? std::min(s.smallest, value) : value;
            s.largest  = covered_any ? std::max(s.largest, value) : value;
          }
        s.last = value;
      }
    if (counts)
      {
        covered += duration;
        summary_time = time;
        covered_any  = true;
      }
  }

  void
  RunOutput::write_result(const Record &more) const
  {
    Record result = more;
    for (std::size_t k = 0; k < summary_names.size(); ++k)
      {
        const std::string &name    = summary_names[k];
        const Summary     &summary = summaries[k];
        result.add(name, summary.last);
        if (!covered_any)
          continue;
        result.add("smallest " + name, summary.smallest);
        result.add("largest " + name, summary.largest);
        if (covered > 0)
          result.add("mean " + name, summary.integral / covered);
      }
    io::write_result(the_folder + "/result.csv", result.all(), comm);
  }

  void
  RunOutput::serialize(Archive &archive)
  {
    std::vector<double> numbers{summary_time, covered, covered_any ? 1. : 0.};
    for (const Summary &s : summaries)
      numbers.insert(numbers.end(),
                     {s.last, s.smallest, s.largest, s.integral});
    archive.values("summaries", numbers);
    if (!archive.reading())
      return;
    summary_time = numbers.at(0);
    covered      = numbers.at(1);
    covered_any  = numbers.at(2) != 0.;
    summaries.clear();
    for (std::size_t k = 3; k + 3 < numbers.size(); k += 4)
      summaries.push_back(
        {numbers[k], numbers[k + 1], numbers[k + 2], numbers[k + 3]});
  }
} // namespace ephyra::simulation
