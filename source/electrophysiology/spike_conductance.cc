#include "ephyra/electrophysiology/spike_conductance.h"

#include "ephyra/electrophysiology/synapses.h"

#include <algorithm>
#include <vector>

namespace ephyra::electrophysiology
{
  double
  spike_conductance(const IonicModel &model, const double cell_capacitance)
  {
    constexpr double dt = 5e-6, duration = 8e-3;
    constexpr double dv = 1e-6; // V, of the difference quotient

    Synapses::Parameters parameters;
    parameters.release = false;
    Synapses            synapse(parameters, cell_capacitance, 1);
    double              v = model.rest_potential();
    std::vector<double> gates(model.n_gates());
    model.steady_gates(v, gates.data());
    synapse.add_epsc(0, 0., 0.);
    double largest = 0;
    for (int i = 0; i * dt < duration; ++i)
      {
        const double s    = synapse.conductance()[0];
        const auto   rate = [&](const double potential) {
          double f;
          model.rate(1, &potential, gates.data(), 1, &s, &f);
          return f;
        };
        const double old_v = v, f = rate(v);
        largest               = std::max(largest, (f - rate(v + dv)) / dv);
        const double middle_v = v + 0.5 * dt * f;
        v += dt * f;
        model.advance_gates(1, &middle_v, dt, gates.data(), 1);
        synapse.advance(i * dt, dt, &old_v, &v);
      }
    return largest;
  }
} // namespace ephyra::electrophysiology
