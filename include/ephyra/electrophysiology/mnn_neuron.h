#pragma once

#include "ephyra/electrophysiology/gate_table.h"
#include "ephyra/electrophysiology/ionic_model.h"

#include <array>

namespace ephyra
{
  class ParameterHandler;
}

namespace ephyra::electrophysiology
{
  /// Neuron of the motor nerve net of scyphozoan jellyfish with seven gates:
  /// Pallasdies et al. 2019 (10.7554/eLife.50084, tables 1 and 2, CC BY 4.0);
  /// eqs. (36)-(45) of Nitti et al. 2023 in the corrected form
  ///
  ///   C_m dv/dt = - i_I - i_FT - i_ST - i_SS - i_L + i_syn,
  ///   i_I  = g_I  G_a^1.77 G_b^4.82 (v - E_I),
  ///   i_FT = g_FT G_c^8.64 G_d^2.51 (v - E_O),
  ///   i_ST = g_ST G_e^3.85 G_f^1.15 (v - E_O),
  ///   i_SS = g_SS G_g (v - E_O),   i_L = g_L (v - E_L),
  ///   i_syn = g_syn s max(E_syn - v, 0)
  ///
  ///   G_inf = 1/(1 + exp((v_half - v)/rho)),
  ///   tau   = C_base + C_amp exp(-((v_max - v)/sigma)^2).
  ///
  /// Inside: mV, ms, pF, nS. Tissue and isolated neuron differ in scale only:
  /// conductance over capacitance is what counts.
  class MnnNeuron : public IonicModel
  {
  public:
    struct Gate
    {
      double exponent;
      double v_half;    ///< mV
      double rho;       ///< mV
      double base_time; ///< ms
      double amplitude; ///< ms
      double v_max;     ///< mV
      double sigma;     ///< mV
    };
    static constexpr int n_all_gates = 7;

    struct Parameters
    {
      double capacitance = 1;                                  ///< pF
      double g_I = 345, g_FT = 39.8, g_ST = 27.2;              ///< nS
      double g_SS = 10.8, g_L = 0.953;                         ///< nS
      double E_I = 76.7, E_O = -84.6, E_L = -70, E_syn = 4.32; ///< mV
      /// Gates a to g.
      std::array<Gate, n_all_gates> gates{
        {{1.77, -2.02, 3.99, 0.52, 0.466, -0.587, 1.},
         {4.82, -10.94, -13.03, 1.3, 0.242, 0.268, 6.62},
         {8.64, 2.4, 22.55, 0.165, 7.51, -35.22, 23.12},
         {2.51, 0.0221, -8.97, 2.73, 10., -29.96, 15.13},
         {3.85, 10.65, 26.43, 1.13, 16.64, -12.71, 43.6},
         {1.15, -10.01, -4.57, 7.66, 2., -34., 20.},
         {1., 48.58, 22.41, 10.43, 4.96, -39.93, 29.88}}};
      /// Interval of the table of steady values and rates, V; 0: no table.
      double table_interval = 0.25e-3;

      static void
      declare(ParameterHandler &prm);
      void
      parse(ParameterHandler &prm);
    };

    /// Finds the resting potential; throws InputError where none exists
    /// between -120 and 0 mV.
    explicit MnnNeuron(const Parameters &parameters);

    std::vector<std::string>
    gate_names() const override;
    int
    n_gates() const override;
    double
    rest_potential() const override;
    void
    steady_gates(double v, double *gates) const override;
    void
    rate(int           n_points,
         const double *v,
         const double *gates,
         int           stride,
         const double *synapse,
         double       *f) const override;
    void
    advance_gates(int           n_points,
                  const double *v,
                  double        dt,
                  double       *gates,
                  int           stride) const override;
    std::vector<std::string>
    current_names() const override;
    void
    currents(double        v,
             const double *gates,
             double        synapse,
             double       *values) const override;
    int
    activation_gate() const override;
    bool
    has_synapses() const override;
    double
    front_speed(double kappa) const override;
    double
    front_width(double kappa) const override;
    double
    fastest_rate() const override;

  private:
    static void
    rates_of_gates(const void *model, double v, double *steady, double *rate);
    /// A step of the gates without the table.
    template <bool exact>
    void
    compute_gates(int           n_points,
                  const double *v,
                  double        dt_ms,
                  double       *gates,
                  int           stride) const;

    Parameters prm;
    double     v_rest;           ///< V
    double     fastest_gate = 0; ///< 1/ms
    GateTable  table;
  };
} // namespace ephyra::electrophysiology
