#include "ephyra/simulation/body_probes.h"

#include <sstream>

namespace ephyra::simulation
{
  namespace
  {
    void
    declare_point(ParameterHandler  &prm,
                  const std::string &name,
                  const std::string &default_value,
                  const std::string &text)
    {
      prm.declare_entry(name,
                        default_value,
                        patterns::List(patterns::Double("", 0., 1.), 2, 2),
                        text);
    }

    void
    declare_probe(ParameterHandler &prm)
    {
      declare_point(prm,
                    "Point",
                    "0, 0",
                    "theta^1, theta^2 of a material point that is followed.");
      declare_quantities(prm, "position, displacement, velocity");
    }

    void
    declare_line(ParameterHandler &prm)
    {
      declare_point(
        prm, "Start", "0, 0", "theta^1, theta^2 of the first point.");
      declare_point(prm, "End", "1, 0", "theta^1, theta^2 of the last point.");
      prm.declare_entry("Intervals",
                        "100",
                        patterns::Integer(1),
                        "Number of intervals between the points, of equal "
                        "parametric length.");
      declare_quantities(prm, "displacement");
    }

    std::array<double, 2>
    parse_point(const ParameterHandler &prm, const std::string &name)
    {
      const std::vector<double> theta = prm.get_double_list(name);
      if (theta.size() != 2) // has been reported
        return {{0., 0.}};
      return {{theta[0], theta[1]}};
    }
  } // namespace

  void
  BodySampling::declare(ParameterHandler &prm)
  {
    prm.declare_repeated_subsection(
      "Body probe",
      declare_probe,
      "A material point of the deformable body, by any name; written to "
      "probes/NAME.csv, as often as the statistics.");
    prm.declare_repeated_subsection(
      "Body line",
      declare_line,
      "A material line of the deformable body that is straight in theta^1, "
      "theta^2, such as a side; written to profiles/NAME_QUANTITY.csv.");
  }

  void
  BodySampling::parse(ParameterHandler &prm)
  {
    for (const std::string &name : prm.instances("Body probe"))
      {
        const ParameterHandler::Section section(prm, "Body probe " + name);
        const auto                      point = parse_point(prm, "Point");
        probes.push_back({name, point, point, 0, parse_quantities(prm)});
      }
    for (const std::string &name : prm.instances("Body line"))
      {
        const ParameterHandler::Section section(prm, "Body line " + name);
        lines.push_back({name,
                         parse_point(prm, "Start"),
                         parse_point(prm, "End"),
                         prm.get_integer("Intervals"),
                         parse_quantities(prm)});
        if (lines.back().start == lines.back().end)
          prm.add_error("End",
                        "it is the start of the line, too; name another point "
                        "or use a Body probe.");
      }
  }

  std::array<double, 2>
  BodySampling::Line::point(const int k) const
  {
    const double s = intervals == 0 ? 0. : 1. * k / intervals;
    return {
      {(1. - s) * start[0] + s * end[0], (1. - s) * start[1] + s * end[1]}};
  }

  BodyProbes::BodyProbes(const BodySampling           &sampling,
                         const splines::NurbsPatch<2> &patch)
  {
    const auto make = [&patch](const BodySampling::Line &line) {
      Series series{line.name, body_quantities(line.quantities), {}, {}};
      for (int k = 0; k <= line.intervals; ++k)
        {
          Point point{line.point(k), {}, {}};
          point.rest = patch.point(point.theta);
          patch.evaluate_basis(point.theta, point.basis);
          series.points.push_back(point);
          std::ostringstream name;
          name << (line.intervals == 0 ? 0. : 1. * k / line.intervals);
          series.columns.push_back(name.str());
        }
      return series;
    };
    for (const auto &probe : sampling.probes)
      probes.push_back(make(probe));
    for (const auto &line : sampling.lines)
      lines.push_back(make(line));
  }

  std::vector<double>
  BodyProbes::evaluate(const Point &point, const BodyState &state)
  {
    splines::Point v;
    for (std::size_t a = 0; a < point.basis.index.size(); ++a)
      {
        v.r += point.basis.value[a] * state.velocity[2 * point.basis.index[a]];
        v.y +=
          point.basis.value[a] * state.velocity[2 * point.basis.index[a] + 1];
      }
    return evaluate_quantities(
      point.rest, v, state.fields(point.theta[0], point.theta[1]));
  }

  void
  BodyProbes::write_probes(const double     time,
                           const BodyState &state,
                           RunOutput       &output) const
  {
    for (const Series &probe : probes)
      {
        const auto values = evaluate(probe.points.front(), state);
        Record     record;
        for (const BodyQuantity &quantity : probe.quantities)
          record.add(quantity.name, values[quantity.index]);
        output.add_row("probes/" + probe.name, time, record);
      }
  }

  void
  BodyProbes::write_lines(const double     time,
                          const BodyState &state,
                          RunOutput       &output) const
  {
    for (const Series &line : lines)
      {
        std::vector<std::vector<double>> values;
        for (const Point &point : line.points)
          values.push_back(evaluate(point, state));
        for (const BodyQuantity &quantity : line.quantities)
          {
            std::vector<double> row;
            for (const auto &at_point : values)
              row.push_back(at_point[quantity.index]);
            output.add_profile(
              line.name + "_" + quantity.file, time, line.columns, row);
          }
      }
  }
} // namespace ephyra::simulation
