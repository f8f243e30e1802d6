// What the electrophysiology solver shows of gates, synapses and currents.
#include "ephyra/electrophysiology/electrophysiology_solver.h"

namespace ephyra::electrophysiology
{
  void
  ElectrophysiologySolver::gate(const int            k,
                                std::vector<double> &coefficients) const
  {
    coefficients.resize(n_control_points());
    reaction->to_coefficients(&gates[static_cast<std::size_t>(k) * n_points()],
                              coefficients.data());
  }

  void
  ElectrophysiologySolver::synapse(std::vector<double> &coefficients) const
  {
    coefficients.assign(n_control_points(), 0.);
    if (synapses)
      reaction->to_coefficients(synapses->conductance(), coefficients.data());
  }

  std::vector<double>
  ElectrophysiologySolver::currents(const double               potential,
                                    const std::vector<double> &point_gates,
                                    const double               synapse) const
  {
    std::vector<double> values(model->current_names().size());
    model->currents(potential, point_gates.data(), synapse, values.data());
    for (double &value : values)
      value *= prm.capacitance;
    return values;
  }

  std::vector<double>
  ElectrophysiologySolver::currents(const int point) const
  {
    std::vector<double> own_gates(model->n_gates());
    for (int k = 0; k < model->n_gates(); ++k)
      own_gates[k] = gates[static_cast<std::size_t>(k) * n_points() + point];
    return currents(points_v[point],
                    own_gates,
                    synapses ? synapses->conductance()[point] : 0.);
  }
} // namespace ephyra::electrophysiology
