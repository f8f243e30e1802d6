#include "ephyra/simulation/tissue_model.h"

#include "ephyra/base/log.h"
#include "ephyra/base/timer_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace ephyra::simulation
{
  TissueModel::TissueModel(const Scene &scene, const MPI_Comm comm)
  {
    using electrophysiology::ElectrophysiologySolver;
    if (scene.single_cell)
      {
        solver = std::make_unique<ElectrophysiologySolver>(scene.tissue, comm);
        return;
      }
    line = geometry::create_curve(scene.tissue_line).curve;
    solver =
      std::make_unique<ElectrophysiologySolver>(scene.tissue, *line, comm);
    profile = LineProfile(*line);
    motion.emplace(scene.tissue_motion, *line, *solver);
    for (const double theta : scene.crossing_points)
      {
        crossing_probes.push_back(
          solver->add_crossing_probe(theta, scene.crossing_level));
        probe_points.push_back(theta);
      }
    probes.emplace(
      scene.tissue_sampling, *line, *motion, scene.crossing_level, *solver);
    if (motion->moves())
      {
        motion->metric(0., G11, radius);
        solver->set_deformed_metric(G11, radius);
        const std::string problem = solver->resolution_problem();
        if (!problem.empty())
          log().warning("With the first shape of the line: " + problem);
      }
  }

  StepStatus
  TissueModel::advance(const double t, const double dt)
  {
    const TimerTree::Scope scope(
      timer(), "electrophysiology", solver->n_control_points());
    if (motion && motion->moves())
      {
        motion->metric(t + 0.5 * dt, G11, radius);
        metric_updates += solver->set_deformed_metric(G11, radius) ? 1 : 0;
      }
    const StepStatus status = solver->advance(t, dt);
    time                    = t + dt;
    return status;
  }

  void
  TissueModel::serialize(Archive &archive)
  {
    archive.value("time", time);
    archive.value("metric updates", metric_updates);
    solver->serialize(archive);
  }

  void
  TissueModel::evaluate(Record &record)
  {
    const auto &v = solver->potential();
    record.add("largest potential [V]", *std::max_element(v.begin(), v.end()));
    record.add("smallest potential [V]", *std::min_element(v.begin(), v.end()));
    std::vector<double> gamma;
    solver->activation(time, gamma);
    record.add("largest activation [-]",
               *std::max_element(gamma.begin(), gamma.end()));
    record.add("substeps [-]", static_cast<double>(solver->n_substeps()));
    if (line || !solver->ionic_model())
      return;
    // The isolated neuron shows all it has.
    const auto          names = solver->ionic_model()->gate_names();
    std::vector<double> gate;
    for (int k = 0; k < solver->ionic_model()->n_gates(); ++k)
      {
        solver->gate(k, gate);
        record.add("gate " + names[k] + " [-]", gate.front());
      }
    const auto current_names = solver->ionic_model()->current_names();
    const auto currents      = solver->currents(0);
    for (std::size_t k = 0; k < currents.size(); ++k)
      record.add("current " + current_names[k] + " [A/m^3]", currents[k]);
  }

  void
  TissueModel::write_probes(const double time, RunOutput &output) const
  {
    if (probes)
      probes->write_probes(time, output);
  }

  void
  TissueModel::write_profiles(const double time, RunOutput &output) const
  {
    if (!profile)
      return;
    probes->write_lines(time, output);
    profile->write("potential", time, solver->potential(), 1, 0, output);
    std::vector<double> values;
    solver->activation(time, values);
    profile->write("activation", time, values, 1, 0, output);
    if (!solver->ionic_model())
      return;
    const auto names = solver->ionic_model()->gate_names();
    for (int k = 0; k < solver->ionic_model()->n_gates(); ++k)
      {
        solver->gate(k, values);
        profile->write("gate_" + names[k], time, values, 1, 0, output);
      }
  }

  void
  TissueModel::write_fields(const double, RunOutput &)
  {
    // Profiles hold all there is on a line.
  }

  void
  TissueModel::add_results(Record &record) const
  {
    record.add("nerve net unknowns [-]", solver->n_control_points());
    record.add("awake share of points [-]", solver->awake_share());
    record.add("factorisations [-]",
               static_cast<double>(solver->n_factorizations()));
    if (motion && motion->moves())
      record.add("metric updates [-]", static_cast<double>(metric_updates));
    constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t p = 0; p < crossing_probes.size(); ++p)
      {
        const auto        &times = solver->crossing_times(crossing_probes[p]);
        std::ostringstream place;
        place << "theta1 = " << probe_points[p];
        record.add("first crossing at " + place.str() + " [s]",
                   times.empty() ? no_number : times.front());
        record.add("crossings at " + place.str() + " [-]",
                   static_cast<double>(times.size()));
        const auto *model = solver->ionic_model();
        if (model && model->activation_gate() >= 0)
          record.add("largest " +
                       model->gate_names()[model->activation_gate()] + " at " +
                       place.str() + " [-]",
                     solver->largest_gate(crossing_probes[p]));
        if (times.empty())
          log().warning(solver->why_not_reached(crossing_probes[p], time));
      }
    if (crossing_probes.size() < 2)
      return;
    report_lost_fronts();
    // Mean speed of the front between the outermost probes.
    const auto &first    = solver->crossing_times(crossing_probes.front());
    const auto &last     = solver->crossing_times(crossing_probes.back());
    double      duration = no_number;
    if (!first.empty() && !last.empty())
      duration = std::abs(last.front() - first.front());
    double    length  = 0;
    const int n_steps = 1000;
    for (int k = 0; k < n_steps; ++k)
      {
        const double range = probe_points.back() - probe_points.front();
        const auto   at    = [&](const int i) {
          return line->point({{probe_points.front() + range * i / n_steps}});
        };
        length += std::hypot(at(k + 1).r - at(k).r, at(k + 1).y - at(k).y);
      }
    record.add("time between crossing probes [s]", duration);
    record.add("conduction velocity [m/s]", length / duration);
  }

  void
  TissueModel::report_lost_fronts() const
  {
    // The probe that the first front reached first, and the one it reached last.
    std::size_t near = 0, far = 0;
    const auto times = [&](const std::size_t p) -> const std::vector<double> & {
      return solver->crossing_times(crossing_probes[p]);
    };
    for (std::size_t p = 0; p < crossing_probes.size(); ++p)
      {
        if (times(p).empty())
          return; // told already
        if (times(p).front() < times(near).front())
          near = p;
        if (times(p).front() > times(far).front())
          far = p;
      }
    // Those that have had as much time as the first front needed, and half more.
    const double needed = 1.5 * (times(far).front() - times(near).front());
    const auto   n_old  = std::count_if(
      times(near).begin(), times(near).end(), [&](const double crossing) {
        return crossing + needed < time;
      });
    const auto n_arrived = static_cast<std::ptrdiff_t>(times(far).size());
    if (n_arrived < n_old)
      {
        std::ostringstream text;
        text << "Conduction block: of " << n_old
             << " fronts that passed theta^1 = " << probe_points[near]
             << ", only " << n_arrived
             << " came to theta^1 = " << probe_points[far] << ".";
        log().warning(text.str());
      }
    const int n_pulses =
      solver->n_pulses_before(time - 1.5 * times(near).front());
    const auto n_passed = static_cast<int>(times(near).size());
    if (n_passed < n_pulses)
      {
        std::ostringstream text;
        text << "Of " << n_pulses << " pulses of the stimulus only " << n_passed
             << " sent a front past theta^1 = " << probe_points[near]
             << ": the others met tissue that had not recovered, or were too "
                "weak.";
        log().warning(text.str());
      }
  }
} // namespace ephyra::simulation
