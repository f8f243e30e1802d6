#include "ephyra/electrophysiology/nagumo.h"

#include "ephyra/base/parameter_handler.h"

#include <algorithm>
#include <cmath>

namespace ephyra::electrophysiology
{
  void
  Nagumo::Parameters::declare(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Nagumo");
    prm.declare_entry("Rate",
                      "10 1/s",
                      patterns::Positive("1/s"),
                      "k of the reaction k u (1 - u)(u - a).");
    prm.declare_entry(
      "Threshold",
      "0.1",
      patterns::Double("", 0., 1., patterns::Double::Bounds::open),
      "a of the reaction k u (1 - u)(u - a).");
  }

  void
  Nagumo::Parameters::parse(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Nagumo");
    rate      = prm.get_double("Rate");
    threshold = prm.get_double("Threshold");
  }

  Nagumo::Nagumo(const Parameters &parameters)
    : prm(parameters)
  {
  }

  std::vector<std::string>
  Nagumo::gate_names() const
  {
    return {};
  }

  int
  Nagumo::n_gates() const
  {
    return 0;
  }

  double
  Nagumo::rest_potential() const
  {
    return 0;
  }

  void
  Nagumo::steady_gates(double, double *) const
  {
  }

  void
  Nagumo::rate(const int n_points,
               const double *__restrict__ v,
               const double *,
               int,
               const double *,
               double *__restrict__ f) const
  {
    const double k = prm.rate, a = prm.threshold;
    for (int i = 0; i < n_points; ++i)
      f[i] = k * v[i] * (1. - v[i]) * (v[i] - a);
  }

  void
  Nagumo::advance_gates(int, const double *, double, double *, int) const
  {
  }

  std::vector<std::string>
  Nagumo::current_names() const
  {
    return {"i_ion"};
  }

  void
  Nagumo::currents(const double v, const double *, double, double *values) const
  {
    rate(1, &v, nullptr, 0, nullptr, values);
    values[0] = -values[0];
  }

  int
  Nagumo::activation_gate() const
  {
    return -1;
  }

  bool
  Nagumo::has_synapses() const
  {
    return false;
  }

  double
  Nagumo::front_speed(const double kappa) const
  {
    return std::sqrt(kappa * prm.rate / 2.) * (1. - 2. * prm.threshold);
  }

  double
  Nagumo::front_width(const double kappa) const
  {
    return std::sqrt(8. * kappa / prm.rate);
  }

  double
  Nagumo::fastest_rate() const
  {
    return prm.rate * std::max(prm.threshold, 1. - prm.threshold);
  }
} // namespace ephyra::electrophysiology
