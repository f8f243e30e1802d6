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
    declare_probe(ParameterHandler &prm)
    {
      declare_point(prm, "Point", "(r, y) of the point.");
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
        probes.push_back({name, point, point, 0});
      }
    for (const std::string &name : prm.instances("Flow line"))
      {
        const ParameterHandler::Section section(prm, "Flow line " + name);
        lines.push_back({name,
                         parse_point(prm, "Start"),
                         parse_point(prm, "End"),
                         prm.get_integer("Intervals")});
      }
  }

  FlowProbes::FlowProbes(const FlowSampling                  &sampling,
                         const immersed_boundary::Parameters &interpolation,
                         const fluid::StaggeredGrid          &grid)
  {
    const immersed_boundary::MovingLeastSquares mls(grid, interpolation);
    for (const auto &probe : sampling.probes)
      probes.push_back(series(probe, mls));
    for (const auto &line : sampling.lines)
      lines.push_back(series(line, mls));
  }

  FlowProbes::Series
  FlowProbes::series(const FlowSampling::Line                    &line,
                     const immersed_boundary::MovingLeastSquares &mls) const
  {
    using immersed_boundary::MovingLeastSquares;
    Series result;
    result.name = line.name;
    for (int k = 0; k <= line.intervals; ++k)
      {
        const double s  = line.intervals == 0 ? 0. : 1. * k / line.intervals;
        const double dr = s * (line.end[0] - line.start[0]);
        const double dy = s * (line.end[1] - line.start[1]);
        const double r = line.start[0] + dr, y = line.start[1] + dy;
        EphyraThrowIf(!mls.contains(r, y),
                      InputError,
                      "The point (r, y) = ("
                        << r << ", " << y << ") m of the flow probe or line '"
                        << line.name
                        << "' is outside of the grid; move it or widen the "
                           "grid.");
        const auto rf = mls.r_faces(r), rc = mls.r_centres(r);
        const auto yf = mls.y_faces(y), yc = mls.y_centres(y);
        result.points.push_back({MovingLeastSquares::value(rf, yc),
                                 MovingLeastSquares::value(rc, yf),
                                 MovingLeastSquares::value(rc, yc)});
        std::ostringstream distance;
        distance << std::hypot(dr, dy);
        result.distances.push_back(distance.str());
      }
    return result;
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
                           RunOutput               &output) const
  {
    for (const Series &probe : probes)
      {
        const std::vector<double> values = evaluate(probe, flow);
        Record                    record;
        for (int k = 0; k < 3; ++k)
          record.add(columns[k] + " " + units[k], values[k]);
        output.add_row("probes/" + probe.name, time, record);
      }
  }

  void
  FlowProbes::add_results(const fluid::FlowSolver &flow, Record &record) const
  {
    for (const Series &probe : probes)
      {
        const std::vector<double> values = evaluate(probe, flow);
        for (int k = 0; k < 3; ++k)
          record.add(probe.name + " " + columns[k] + " " + units[k], values[k]);
      }
  }

  void
  FlowProbes::write_lines(const double             time,
                          const fluid::FlowSolver &flow,
                          RunOutput               &output) const
  {
    for (const Series &line : lines)
      {
        const std::vector<double> values = evaluate(line, flow);
        for (std::size_t k = 0; k < 3; ++k)
          {
            std::vector<double> row;
            for (std::size_t i = k; i < values.size(); i += 3)
              row.push_back(values[i]);
            output.add_profile(
              line.name + "_" + files[k], time, line.distances, row);
          }
      }
  }
} // namespace ephyra::simulation
