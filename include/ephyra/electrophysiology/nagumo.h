#pragma once

#include "ephyra/electrophysiology/ionic_model.h"

namespace ephyra
{
  class ParameterHandler;
}

namespace ephyra::electrophysiology
{
  /// Nagumo's bistable reaction f = k u (1 - u)(u - a), without gates. On a
  /// line it has the exact wave u = (1 - tanh(sqrt(k/(8 kappa)) (x - c t)))/2
  /// of speed c = sqrt(kappa k/2)(1 - 2a). u is dimensionless and stands where
  /// the potential does.
  class Nagumo : public IonicModel
  {
  public:
    struct Parameters
    {
      double rate      = 10;  ///< k, 1/s
      double threshold = 0.1; ///< a

      static void
      declare(ParameterHandler &prm);
      void
      parse(ParameterHandler &prm);
    };

    explicit Nagumo(const Parameters &parameters);

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
    Parameters prm;
  };
} // namespace ephyra::electrophysiology
