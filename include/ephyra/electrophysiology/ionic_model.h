#pragma once

#include <memory>
#include <string>
#include <vector>

namespace ephyra::electrophysiology
{
  /// The local part of the monodomain equation, eqs. (31), (36), (42)-(45) of
  /// Nitti et al. 2023 (10.1016/j.apm.2023.08.003), per capacitance:
  ///
  ///   dv/dt = kappa lap v + f(v, G, s),   dG_k/dt = (G_k_inf(v) - G_k)/tau_k(v)
  ///
  /// f = (-i_ion + i_syn)/C_m in V/s. Everything is SI here; a model converts
  /// inside. Points are structures of arrays: gate k of point i stands at
  /// gates[k * stride + i].
  class IonicModel
  {
  public:
    virtual ~IonicModel() = default;

    virtual std::vector<std::string>
    gate_names() const = 0;
    virtual int
    n_gates() const = 0;
    /// Potential at which all currents balance, V.
    virtual double
    rest_potential() const = 0;
    /// G_k_inf(v) of all gates.
    virtual void
    steady_gates(double v, double *gates) const = 0;

    /// f of n points. @p synapse is the synaptic conductance over C_m, 1/s.
    virtual void
    rate(int           n_points,
         const double *v,
         const double *gates,
         int           stride,
         const double *synapse,
         double       *f) const = 0;

    /// The gates a step further by the classical fourth-order Runge-Kutta
    /// method with v frozen, so that G_inf and tau are evaluated once.
    virtual void
    advance_gates(int           n_points,
                  const double *v,
                  double        dt,
                  double       *gates,
                  int           stride) const = 0;

    /// Names of the currents that make up f, for output (Fig. 4b).
    virtual std::vector<std::string>
    current_names() const = 0;
    /// The currents of one point per capacitance, A/F = V/s, outward positive.
    virtual void
    currents(double        v,
             const double *gates,
             double        synapse,
             double       *values) const = 0;

    /// Index of the gate that drives the muscle (G_a in eq. 46); -1: none.
    virtual int
    activation_gate() const = 0;
    /// Whether synaptic triggers and currents exist.
    virtual bool
    has_synapses() const = 0;
    /// Estimated speed and width of a plane front, m/s and m, in a medium of
    /// diffusivity kappa (m^2/s): what a mesh has to resolve.
    virtual double
    front_speed(double kappa) const = 0;
    virtual double
    front_width(double kappa) const = 0;
    /// Largest -df/dv during a spike, 1/s: the second-order Adams-Bashforth
    /// method is stable for steps up to about its inverse. Computed anew at
    /// each call.
    virtual double
    fastest_rate() const = 0;
  };
} // namespace ephyra::electrophysiology
