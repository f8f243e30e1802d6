#include "ephyra/simulation/flow_probes.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"

#include <cmath>
#include <sstream>

namespace ephyra::simulation
{
  namespace
  {
    const std::array<std::string, 3> units{{"[m/s]", "[m/s]", "[Pa]"}};
    const std::array<std::string, 3> columns{
      {"radial velocity", "axial velocity", "pressure"}};
    const std::array<std::string, 3> files{
      {"radial_velocity", "axial_velocity", "pressure"}};

    void
    declare_point(ParameterHandler  &prm,
                  const std::string &name,
                  const std::string &text)
    {
      prm.declare_entry(
        name, "0, 0", patterns::List(patterns::Double("m"), 2, 2), text);
    }

    void
    declare_frame(ParameterHandler &prm)
    {
      prm.declare_entry("Frame",
                        "fixed",
                        patterns::Selection("fixed|window"),
                        "window: moves with the moving window of the flow, "
                        "the given place is that at the start.");
    }

    void
    declare_probe(ParameterHandler &prm)
    {
      declare_point(prm, "Point", "(r, y) of the point.");
      declare_frame(prm);
    }

    void
    declare_line(ParameterHandler &prm)
    {
      declare_point(prm, "Start", "(r, y) of the first point.");
      declare_point(prm, "End", "(r, y) of the last point.");
      prm.declare_entry("Intervals",
                        "100",
                        patterns::Integer(1),
                        "Number of intervals between the points.");
      declare_frame(prm);
    }

    std::array<double, 2>
    parse_point(const ParameterHandler &prm, const std::string &name)
    {
      const std::vector<double> x = prm.get_double_list(name);
      if (x.size() != 2) // has been reported
        return {{0., 0.}};
      return {{x[0], x[1]}};
    }
  } // namespace

  void
  FlowSampling::declare(ParameterHandler &prm)
  {
    prm.declare_repeated_subsection(
      "Flow probe",
      declare_probe,
      "A point whose velocity and pressure are written to probes/NAME.csv, as "
      "often as the statistics.");
    prm.declare_repeated_subsection(
      "Flow line",
      declare_line,
      "A straight line along which velocity and pressure are written to "
      "profiles/NAME_QUANTITY.csv.");
  }

  void
  FlowSampling::parse(ParameterHandler &prm)
  {
    for (const std::string &name : prm.instances("Flow probe"))
      {
        const ParameterHandler::Section section(prm, "Flow probe " + name);
        const auto                      point = parse_point(prm, "Point");
        probes.push_back({name, point, point, 0, prm.get("Frame") == "window"});
      }
    for (const std::string &name : prm.instances("Flow line"))
      {
        const ParameterHandler::Section section(prm, "Flow line " + name);
        lines.push_back({name,
                         parse_point(prm, "Start"),
                         parse_point(prm, "End"),
                         prm.get_integer("Intervals"),
                         prm.get("Frame") == "window"});
      }
  }

  FlowProbes::FlowProbes(const FlowSampling                  &sampling,
                         const immersed_boundary::Parameters &interpolation,
                         const fluid::StaggeredGrid          &grid,
                         const bool                           window)
    : grid(grid)
    , mls(grid, interpolation)
  {
    const auto add = [&](const FlowSampling::Line &line) {
      Series series{line, {}, {}};
      for (int k = 0; k <= line.intervals; ++k)
        {
          const auto x = line.point(k);
          // Along y a window comes to any point at some time.
          EphyraThrowIf(
            !mls.contains(x[0],
                          window && !line.moves ? grid.y.centre[0] : x[1]),
            InputError,
            "The point (r, y) = ("
              << x[0] << ", " << x[1] << ") m of the flow probe or line '"
              << line.name
              << "' is outside of the grid; move it or widen the grid.");
          std::ostringstream distance;
          distance << std::hypot(x[0] - line.start[0], x[1] - line.start[1]);
          series.distances.push_back(distance.str());
        }
      place(series);
      return series;
    };
    for (const auto &probe : sampling.probes)
      probes.push_back(add(probe));
    for (const auto &line : sampling.lines)
      lines.push_back(add(line));
  }

  std::array<double, 2>
  FlowSampling::Line::point(const int k) const
  {
    const double s = intervals == 0 ? 0. : 1. * k / intervals;
    return {
      {start[0] + s * (end[0] - start[0]), start[1] + s * (end[1] - start[1])}};
  }

  void
  FlowProbes::place(Series &series) const
  {
    using immersed_boundary::MovingLeastSquares;
    const FlowSampling::Line &line = series.line;
    const double              move = line.moves ? grid.shift_distance() : 0.;
    series.points.clear();
    for (int k = 0; k <= line.intervals; ++k)
      {
        const double r = line.point(k)[0], y = line.point(k)[1] + move;
        if (!mls.contains(r, y))
          {
            series.points.clear();
            return;
          }
        const auto rf = mls.r_faces(r), rc = mls.r_centres(r);
        const auto yf = mls.y_faces(y), yc = mls.y_centres(y);
        series.points.push_back({MovingLeastSquares::value(rf, yc),
                                 MovingLeastSquares::value(rc, yf),
                                 MovingLeastSquares::value(rc, yc)});
      }
  }

  void
  FlowProbes::follow_grid()
  {
    if (grid.shift() == placed_at)
      return;
    for (auto *list : {&probes, &lines})
      for (Series &series : *list)
        place(series);
    placed_at = grid.shift();
  }

  std::vector<double>
  FlowProbes::evaluate(const Series            &series,
                       const fluid::FlowSolver &flow) const
  {
    const fluid::StaggeredGrid &grid  = flow.grid();
    const int                   begin = grid.first_row, end = grid.end_row();
    const int end_of_faces = end + (grid.is_last_rank() ? 1 : 0);

    std::vector<double> values;
    for (const Point &point : series.points)
      {
        values.push_back(
          point.v_r.apply(flow.velocity().r, begin, end_of_faces));
        values.push_back(point.v_y.apply(flow.velocity().y, begin, end));
        values.push_back(point.p.apply(flow.pressure(), begin, end));
      }
    mpi::sum_in_place(values, grid.communicator());
    return values;
  }

  void
  FlowProbes::write_probes(const double             time,
                           const fluid::FlowSolver &flow,
                           RunOutput               &output)
  {
    follow_grid();
    for (const Series &probe : probes)
      {
        if (probe.points.empty())
          continue;
        const std::vector<double> values = evaluate(probe, flow);
        Record                    record;
        for (int k = 0; k < 3; ++k)
          record.add(columns[k] + " " + units[k], values[k]);
        output.add_row("probes/" + probe.line.name, time, record);
      }
  }

  void
  FlowProbes::add_results(const fluid::FlowSolver &flow, Record &record)
  {
    follow_grid();
    for (const Series &probe : probes)
      {
        if (probe.points.empty())
          continue;
        const std::vector<double> values = evaluate(probe, flow);
        for (int k = 0; k < 3; ++k)
          record.add(probe.line.name + " " + columns[k] + " " + units[k],
                     values[k]);
      }
  }

  void
  FlowProbes::write_lines(const double             time,
                          const fluid::FlowSolver &flow,
                          RunOutput               &output)
  {
    follow_grid();
    for (const Series &line : lines)
      {
        if (line.points.empty())
          continue;
        const std::vector<double> values = evaluate(line, flow);
        for (std::size_t k = 0; k < 3; ++k)
          {
            std::vector<double> row;
            for (std::size_t i = k; i < values.size(); i += 3)
              row.push_back(values[i]);
            output.add_profile(
              line.line.name + "_" + files[k], time, line.distances, row);
          }
      }
  }
} // namespace ephyra::simulation
