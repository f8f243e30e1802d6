#include "ephyra/simulation/tissue_probes.h"

#include "ephyra/splines/control_vector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

namespace ephyra::simulation
{
  namespace
  {
    void
    declare_quantities(ParameterHandler  &prm,
                       const std::string &choices,
                       const std::string &text)
    {
      prm.declare_entry("Quantities",
                        "potential",
                        patterns::List(patterns::Selection(choices), 1),
                        text);
    }

    const std::string state =
      "potential|activation|gates|currents|position|stretch";

    void
    declare_probe(ParameterHandler &prm)
    {
      prm.declare_entry("Point",
                        "0",
                        patterns::Double("", 0., 1.),
                        "theta^1 of a material point.");
      declare_quantities(prm,
                         state,
                         "What is written: currents are all ionic currents and "
                         "the synaptic one, outward positive; stretch is that "
                         "along theta^1 and the hoop.");
    }

    void
    declare_line(ParameterHandler &prm)
    {
      prm.declare_entry("Start",
                        "0",
                        patterns::Double("", 0., 1.),
                        "theta^1 of the first point.");
      prm.declare_entry(
        "End", "1", patterns::Double("", 0., 1.), "theta^1 of the last point.");
      prm.declare_entry("Intervals",
                        "100",
                        patterns::Integer(1),
                        "Number of intervals between the points, of equal "
                        "parametric length.");
      declare_quantities(prm,
                         state + "|arrival",
                         "What is written: as of a Tissue probe; arrival is "
                         "the time of the last upward crossing of "
                         "Tissue/Crossing level.");
    }

    std::vector<std::string>
    parse_quantities(ParameterHandler &prm)
    {
      const std::vector<std::string> names = prm.get_list("Quantities");
      if (std::set<std::string>(names.begin(), names.end()).size() !=
          names.size())
        prm.add_error("Quantities",
                      "one of them is named twice; name it once.");
      return names;
    }
  } // namespace

  // --- parameters ------------------------------------------------------------

  void
  TissueSampling::declare(ParameterHandler &prm)
  {
    prm.declare_repeated_subsection(
      "Tissue probe",
      declare_probe,
      "A material point of a tissue without a body, by any name; written to "
      "probes/NAME.csv, as often as the statistics.");
    prm.declare_repeated_subsection(
      "Tissue line",
      declare_line,
      "A part of the line of a tissue without a body, by any name; written to "
      "profiles/NAME_QUANTITY.csv.");
  }

  void
  TissueSampling::parse(ParameterHandler &prm)
  {
    for (const std::string &name : prm.instances("Tissue probe"))
      {
        const ParameterHandler::Section section(prm, "Tissue probe " + name);
        const double                    theta = prm.get_double("Point");
        probes.push_back({name, theta, theta, 0, parse_quantities(prm)});
      }
    for (const std::string &name : prm.instances("Tissue line"))
      {
        const ParameterHandler::Section section(prm, "Tissue line " + name);
        lines.push_back({name,
                         prm.get_double("Start"),
                         prm.get_double("End"),
                         prm.get_integer("Intervals"),
                         parse_quantities(prm)});
        if (lines.back().start == lines.back().end)
          prm.add_error("End",
                        "it is the start of the line, too; name another point "
                        "or use a Tissue probe.");
      }
  }

  std::vector<double>
  TissueSampling::Line::points() const
  {
    std::vector<double> result{start};
    for (int k = 1; k <= intervals; ++k)
      {
        const double share = 1. * k / intervals;
        result.push_back((1. - share) * start + share * end);
      }
    return result;
  }

  bool
  TissueSampling::Line::has(const std::string &quantity) const
  {
    return std::find(quantities.begin(), quantities.end(), quantity) !=
           quantities.end();
  }

  // --- evaluation ------------------------------------------------------------

  TissueProbes::TissueProbes(const TissueSampling         &sampling,
                             const splines::NurbsPatch<1> &line,
                             const TissueMotion           &motion,
                             const double                  level,
                             electrophysiology::ElectrophysiologySolver &solver)
    : line(line)
    , motion(motion)
    , solver(solver)
  {
    const auto make = [&](const TissueSampling::Line &sampled) {
      Series                             series{sampled, {}, {}, {}};
      std::vector<std::array<double, 1>> points;
      for (const double theta : sampled.points())
        {
          points.push_back({{theta}});
          std::ostringstream name;
          name << theta;
          series.names.push_back(name.str());
          if (sampled.has("arrival"))
            series.crossing_probes.push_back(
              solver.add_crossing_probe(theta, level));
        }
      series.evaluation = splines::EvaluationMatrix(line, points);
      return series;
    };
    for (const auto &probe : sampling.probes)
      probes.push_back(make(probe));
    for (const auto &sampled : sampling.lines)
      lines.push_back(make(sampled));
  }

  void
  TissueProbes::add_gates_or_currents(const Series        &series,
                                      const bool           currents,
                                      std::vector<Column> &columns) const
  {
    const electrophysiology::IonicModel *model = solver.ionic_model();
    if (!model)
      return;
    const std::size_t                n_points = series.names.size();
    std::vector<double>              coefficients;
    std::vector<std::vector<double>> gates(model->n_gates());
    for (int k = 0; k < model->n_gates(); ++k)
      {
        solver.gate(k, coefficients);
        series.evaluation.apply(coefficients, gates[k], 1);
        if (!currents)
          columns.push_back({"gate " + model->gate_names()[k] + " [-]",
                             "gate_" + model->gate_names()[k],
                             gates[k]});
      }
    if (!currents)
      return;
    std::vector<double> v, synapse, point_gates(model->n_gates());
    series.evaluation.apply(solver.potential(), v, 1);
    solver.synapse(coefficients);
    series.evaluation.apply(coefficients, synapse, 1);
    const std::size_t first = columns.size();
    for (const std::string &name : model->current_names())
      columns.push_back({"current " + name + " [A/m^3]",
                         "current_" + name,
                         std::vector<double>(n_points)});
    for (std::size_t i = 0; i < n_points; ++i)
      {
        // Interpolation may leave the range of what is raised to powers.
        for (int k = 0; k < model->n_gates(); ++k)
          point_gates[k] = std::max(gates[k][i], 0.);
        const auto values =
          solver.currents(v[i], point_gates, std::max(synapse[i], 0.));
        for (std::size_t c = 0; c < values.size(); ++c)
          columns[first + c].values[i] = values[c];
      }
  }

  void
  TissueProbes::add_place(const Series        &series,
                          const double         time,
                          const bool           stretch,
                          std::vector<Column> &columns) const
  {
    const std::vector<double> rest     = splines::control_vector(line);
    std::vector<double>       position = motion.displacement(time);
    for (std::size_t i = 0; i < position.size(); ++i)
      position[i] += rest[i];
    std::vector<double> x, x_rest;
    series.evaluation.apply(position, x, 2);
    const std::size_t n = x.size() / 2;
    const std::size_t k = columns.size();
    if (!stretch)
      {
        columns.push_back({"r [m]", "r", std::vector<double>(n)});
        columns.push_back({"y [m]", "y", std::vector<double>(n)});
        for (std::size_t i = 0; i < x.size(); ++i)
          columns[k + i % 2].values[i / 2] = x[i];
        return;
      }
    std::vector<double> g, g_rest;
    series.evaluation.apply(rest, x_rest, 2);
    series.evaluation.apply_derivative(0, position, g, 2);
    series.evaluation.apply_derivative(0, rest, g_rest, 2);
    columns.push_back(
      {"stretch along theta1 [-]", "stretch_theta1", std::vector<double>(n)});
    columns.push_back(
      {"hoop stretch [-]", "stretch_hoop", std::vector<double>(n)});
    for (std::size_t i = 0; i < n; ++i)
      {
        columns[k].values[i] = std::hypot(g[2 * i], g[2 * i + 1]) /
                               std::hypot(g_rest[2 * i], g_rest[2 * i + 1]);
        // On the axis the hoop is stretched as r is along the line.
        columns[k + 1].values[i] = x_rest[2 * i] > 0 ? x[2 * i] / x_rest[2 * i]
                                                     : g[2 * i] / g_rest[2 * i];
      }
  }

  std::vector<TissueProbes::Column>
  TissueProbes::evaluate(const Series &series, const double time) const
  {
    std::vector<Column> columns;
    for (const std::string &quantity : series.line.quantities)
      {
        if (quantity == "gates" || quantity == "currents")
          add_gates_or_currents(series, quantity == "currents", columns);
        else if (quantity == "position" || quantity == "stretch")
          add_place(series, time, quantity == "stretch", columns);
        else if (quantity == "potential")
          {
            columns.push_back({"potential [V]", "potential", {}});
            series.evaluation.apply(
              solver.potential(), columns.back().values, 1);
          }
        else if (quantity == "activation")
          {
            std::vector<double> gamma;
            solver.activation(time, gamma);
            columns.push_back({"activation [-]", "activation", {}});
            series.evaluation.apply(gamma, columns.back().values, 1);
          }
        else
          {
            columns.push_back({"last arrival [s]", "arrival", {}});
            for (const int probe : series.crossing_probes)
              columns.back().values.push_back(
                solver.crossing_times(probe).empty()
                  ? std::numeric_limits<double>::quiet_NaN()
                  : solver.crossing_times(probe).back());
          }
      }
    return columns;
  }

  void
  TissueProbes::write_probes(const double time, RunOutput &output) const
  {
    for (const Series &probe : probes)
      {
        Record record;
        for (const Column &column : evaluate(probe, time))
          record.add(column.name, column.values.front());
        output.add_row("probes/" + probe.line.name, time, record);
      }
  }

  void
  TissueProbes::write_lines(const double time, RunOutput &output) const
  {
    for (const Series &series : lines)
      for (const Column &column : evaluate(series, time))
        output.add_profile(series.line.name + "_" + column.file,
                           time,
                           series.names,
                           column.values);
  }
} // namespace ephyra::simulation
