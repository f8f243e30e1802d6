#include "ephyra/electrophysiology/mnn_neuron.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/parameter_handler.h"
#include "ephyra/electrophysiology/spike_conductance.h"
#include "ephyra/electrophysiology/vector_math.h"

#include <algorithm>
#include <cmath>

namespace ephyra::electrophysiology
{
  namespace
  {
    constexpr double mV_per_V = 1e3;
    constexpr double ms_per_s = 1e3;
    /// Range of the table of gates, mV; beyond it gates are computed.
    constexpr double table_v_min = -150, table_v_max = 150;
    /// Above this dt/tau the exact solution replaces Runge-Kutta 4, which is
    /// then 1e-5 off.
    constexpr double largest_runge_kutta_step = 0.25;

    struct Entry
    {
      const char *name;
      double MnnNeuron::Parameters::*member;
      const char                    *unit;       ///< SI
      const char                    *inner_unit; ///< of the member
      double                         inner_per_si;
      const char                    *text;
    };
    const Entry entries[] = {
      {"Capacitance",
       &MnnNeuron::Parameters::capacitance,
       "F",
       "pF",
       1e12,
       "Capacitance of the cell membrane, to which the conductances belong."},
      {"Conductance I",
       &MnnNeuron::Parameters::g_I,
       "S",
       "nS",
       1e9,
       "Peak conductance of the transient inward current."},
      {"Conductance FT",
       &MnnNeuron::Parameters::g_FT,
       "S",
       "nS",
       1e9,
       "Peak conductance of the fast transient outward current."},
      {"Conductance ST",
       &MnnNeuron::Parameters::g_ST,
       "S",
       "nS",
       1e9,
       "Peak conductance of the slow transient outward current."},
      {"Conductance SS",
       &MnnNeuron::Parameters::g_SS,
       "S",
       "nS",
       1e9,
       "Peak conductance of the steady-state outward current."},
      {"Conductance L",
       &MnnNeuron::Parameters::g_L,
       "S",
       "nS",
       1e9,
       "Conductance of the leakage."},
      {"Reversal potential I",
       &MnnNeuron::Parameters::E_I,
       "V",
       "mV",
       1e3,
       "Reversal potential of the inward current."},
      {"Reversal potential O",
       &MnnNeuron::Parameters::E_O,
       "V",
       "mV",
       1e3,
       "Reversal potential of the outward currents."},
      {"Reversal potential L",
       &MnnNeuron::Parameters::E_L,
       "V",
       "mV",
       1e3,
       "Reversal potential of the leakage."},
      {"Reversal potential synapse",
       &MnnNeuron::Parameters::E_syn,
       "V",
       "mV",
       1e3,
       "Above this potential the synaptic current vanishes."}};
  } // namespace

  void
  MnnNeuron::Parameters::declare(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Jellyfish neuron");
    const Parameters                defaults;
    for (const Entry &entry : entries)
      {
        std::ostringstream value;
        value << defaults.*entry.member << ' ' << entry.inner_unit;
        const bool is_potential = std::string(entry.unit) == "V";
        prm.declare_entry(entry.name,
                          value.str(),
                          is_potential ? patterns::Double(entry.unit)
                                       : patterns::Positive(entry.unit),
                          entry.text);
      }
    prm.declare_entry("Table interval",
                      "0.25 mV",
                      patterns::Double("V", 0., 5e-3),
                      "Interval of the potential at which steady values and "
                      "rates of the gates are tabulated (cubic between); 0: "
                      "computed by exponentials at every point and step.");
  }

  void
  MnnNeuron::Parameters::parse(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Jellyfish neuron");
    for (const Entry &entry : entries)
      this->*entry.member = prm.get_double(entry.name) * entry.inner_per_si;
    table_interval = prm.get_double("Table interval");
  }

  MnnNeuron::MnnNeuron(const Parameters &parameters)
    : prm(parameters)
    , v_rest(0)
  {
    const double no_synapse = 0;
    const auto   f          = [&](const double v) {
      double gates[n_all_gates], rate_of_v;
      steady_gates(v, gates);
      rate(1, &v, gates, 1, &no_synapse, &rate_of_v);
      return rate_of_v;
    };
    // The lowest zero of f, by bisection of the first bracket.
    double       low  = -0.12;
    const double step = 0.0005;
    while (low < 0 && !(f(low) > 0 && f(low + step) <= 0))
      low += step;
    EphyraThrowIf(low >= 0,
                  InputError,
                  "The jellyfish neuron has no resting potential between -120 "
                  "and 0 mV with these conductances and reversal potentials; "
                  "restore their default values.");
    double high = low + step;
    for (int i = 0; i < 60; ++i)
      {
        const double middle          = 0.5 * (low + high);
        (f(middle) > 0 ? low : high) = middle;
      }
    v_rest = 0.5 * (low + high);
    for (const Gate &gate : prm.gates)
      fastest_gate = std::max(fastest_gate, 1. / gate.base_time);
    if (prm.table_interval > 0)
      table = GateTable(&rates_of_gates,
                        this,
                        table_v_min,
                        table_v_max,
                        mV_per_V * prm.table_interval);
  }

  std::vector<std::string>
  MnnNeuron::gate_names() const
  {
    return {"G_a", "G_b", "G_c", "G_d", "G_e", "G_f", "G_g"};
  }

  int
  MnnNeuron::n_gates() const
  {
    return n_all_gates;
  }

  double
  MnnNeuron::rest_potential() const
  {
    return v_rest;
  }

  void
  MnnNeuron::steady_gates(const double v, double *gates) const
  {
    for (int k = 0; k < n_all_gates; ++k)
      gates[k] = 1. / (1. + std::exp((prm.gates[k].v_half - mV_per_V * v) /
                                     prm.gates[k].rho));
  }

  void
  MnnNeuron::rate(const int n_points,
                  const double *__restrict__ v,
                  const double *__restrict__ gates,
                  const int stride,
                  const double *__restrict__ synapse,
                  double *__restrict__ f) const
  {
    const double *__restrict__ G_a = gates;
    const double *__restrict__ G_b = gates + stride;
    const double *__restrict__ G_c = gates + 2 * stride;
    const double *__restrict__ G_d = gates + 3 * stride;
    const double *__restrict__ G_e = gates + 4 * stride;
    const double *__restrict__ G_f = gates + 5 * stride;
    const double *__restrict__ G_g = gates + 6 * stride;

    const auto  &gate = prm.gates;
    const double n_a = gate[0].exponent, n_b = gate[1].exponent,
                 n_c = gate[2].exponent, n_d = gate[3].exponent,
                 n_e = gate[4].exponent, n_f = gate[5].exponent;
    const double per_C = 1. / prm.capacitance; // nS/pF = 1/ms
    const double I = prm.g_I * per_C, FT = prm.g_FT * per_C,
                 ST = prm.g_ST * per_C, SS = prm.g_SS * per_C,
                 L   = prm.g_L * per_C;
    const double E_I = prm.E_I, E_O = prm.E_O, E_L = prm.E_L, E_syn = prm.E_syn;

    for (int i = 0; i < n_points; ++i)
      {
        const double u = mV_per_V * v[i];
        const double inward =
          I * vector_math::power_product(G_a[i], n_a, G_b[i], n_b);
        const double outward =
          FT * vector_math::power_product(G_c[i], n_c, G_d[i], n_d) +
          ST * vector_math::power_product(G_e[i], n_e, G_f[i], n_f) +
          SS * G_g[i];
        const double drive = E_syn - u > 0. ? E_syn - u : 0.;
        // mV/ms = V/s; the synapse comes in 1/s.
        f[i] = synapse[i] * drive * (1. / ms_per_s) - inward * (u - E_I) -
               outward * (u - E_O) - L * (u - E_L);
      }
  }

  void
  MnnNeuron::rates_of_gates(const void  *model,
                            const double v,
                            double      *steady,
                            double      *rate)
  {
    const auto &gates = static_cast<const MnnNeuron *>(model)->prm.gates;
    for (int k = 0; k < GateTable::n_lanes; ++k)
      {
        // What the row has no gate for stands still.
        steady[k] = rate[k] = 0;
        if (k >= n_all_gates)
          continue;
        const Gate  &gate = gates[k];
        const double y    = (gate.v_max - v) / gate.sigma;
        steady[k]         = 1. / (1. + std::exp((gate.v_half - v) / gate.rho));
        rate[k] = 1. / (gate.base_time + gate.amplitude * std::exp(-y * y));
      }
  }

  template <bool exact>
  void
  MnnNeuron::compute_gates(const int n_points,
                           const double *__restrict__ v,
                           const double dt_ms,
                           double *__restrict__ gates,
                           const int stride) const
  {
    for (int k = 0; k < n_all_gates; ++k)
      {
        double *__restrict__ G = gates + k * stride;
        const double v_half    = prm.gates[k].v_half;
        const double per_rho   = 1. / prm.gates[k].rho;
        const double base_time = prm.gates[k].base_time;
        const double amplitude = prm.gates[k].amplitude;
        const double v_max     = prm.gates[k].v_max;
        const double per_sigma = 1. / prm.gates[k].sigma;
        for (int i = 0; i < n_points; ++i)
          {
            const double u = mV_per_V * v[i];
            double       x = (v_half - u) * per_rho;
            x              = x > 300. ? 300. : x; // keeps the product finite
            const double y = (v_max - u) * per_sigma;
            const double denominator = 1. + vector_math::exp(x);
            const double tau = base_time + amplitude * vector_math::exp(-y * y);
            // one division for both quotients
            const double inverse = 1. / (denominator * tau);
            const double G_inf   = inverse * tau;
            const double z       = dt_ms * inverse * denominator;
            // Runge-Kutta 4 of dG/dt = (G_inf - G)/tau
            const double growth =
              exact ? 1. - vector_math::exp(-z)
                    : z * (1. - z * (1. / 2.) *
                                  (1. - z * (1. / 3.) * (1. - z * 0.25)));
            G[i] += growth * (G_inf - G[i]);
          }
      }
  }

  void
  MnnNeuron::advance_gates(const int     n_points,
                           const double *v,
                           const double  dt,
                           double       *gates,
                           const int     stride) const
  {
    const double  dt_ms   = ms_per_s * dt;
    const bool    exact   = dt_ms * fastest_gate > largest_runge_kutta_step;
    constexpr int n_block = 64;
    double        keep[n_block * GateTable::n_lanes],
      add[n_block * GateTable::n_lanes];
    for (int begin = 0; begin < n_points; begin += n_block)
      {
        const int     n   = std::min(n_block, n_points - begin);
        const double *v_b = v + begin;
        double       *G_b = gates + begin;
        if (!table.contains(n, v_b, mV_per_V))
          {
            if (exact)
              compute_gates<true>(n, v_b, dt_ms, G_b, stride);
            else
              compute_gates<false>(n, v_b, dt_ms, G_b, stride);
            continue;
          }
        table.coefficients(n, v_b, mV_per_V, dt_ms, exact, keep, add);
        for (int k = 0; k < n_all_gates; ++k)
          {
            double *__restrict__ G = G_b + static_cast<std::size_t>(k) * stride;
            for (int i = 0; i < n; ++i)
              G[i] = add[i * GateTable::n_lanes + k] +
                     keep[i * GateTable::n_lanes + k] * G[i];
          }
      }
  }

  std::vector<std::string>
  MnnNeuron::current_names() const
  {
    return {"i_I", "i_FT", "i_ST", "i_SS", "i_L", "i_syn"};
  }

  void
  MnnNeuron::currents(const double  v,
                      const double *G,
                      const double  synapse,
                      double       *values) const
  {
    const double u = mV_per_V * v;
    const auto   p = [&](const int k) {
      return std::pow(G[k], prm.gates[k].exponent);
    };
    const double per_C = 1. / prm.capacitance;
    values[0]          = prm.g_I * per_C * p(0) * p(1) * (u - prm.E_I);
    values[1]          = prm.g_FT * per_C * p(2) * p(3) * (u - prm.E_O);
    values[2]          = prm.g_ST * per_C * p(4) * p(5) * (u - prm.E_O);
    values[3]          = prm.g_SS * per_C * p(6) * (u - prm.E_O);
    values[4]          = prm.g_L * per_C * (u - prm.E_L);
    values[5]          = -synapse / ms_per_s * std::max(prm.E_syn - u, 0.);
  }

  int
  MnnNeuron::activation_gate() const
  {
    return 0;
  }

  bool
  MnnNeuron::has_synapses() const
  {
    return true;
  }

  double
  MnnNeuron::front_speed(const double kappa) const
  {
    // 47.5 cm/s at kappa = 1.3745e-5 m^2/s with the default parameters; speeds
    // go with the root of the diffusivity.
    return 0.475 * std::sqrt(kappa / 1.3745e-5);
  }

  double
  MnnNeuron::front_width(const double kappa) const
  {
    return kappa / front_speed(kappa);
  }

  double
  MnnNeuron::fastest_rate() const
  {
    // Runs diverge between 0.8 and 1.1 of the limit by the conductance alone.
    constexpr double margin = 1.25;
    return margin * spike_conductance(*this, 1e-12 * prm.capacitance);
  }
} // namespace ephyra::electrophysiology
