#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/base/parameter_handler.h"

#include <memory>
#include <string>
#include <vector>

namespace ephyra::coupling
{
  /// Convergence acceleration of the interface fixed point x = H(x), where H
  /// is "body moves under the load x, flow answers with a new load".
  ///
  /// One step: start_step(); then, until the residual is small,
  /// x = next(x, H(x)); then finish_step(converged). Vectors are replicated,
  /// so every rank takes the same decisions.
  class Acceleration
  {
  public:
    struct Parameters
    {
      std::string type = "quasi-Newton"; ///< relaxation | Aitken | quasi-Newton
      double      initial_relaxation = 0.3;
      double      largest_relaxation = 1.0;
      int         reused_steps       = 8;    ///< quasi-Newton: steps kept
      double      filter             = 1e-2; ///< quasi-Newton: QR threshold

      static void
      declare(ParameterHandler &prm);
      void
      parse(ParameterHandler &prm);
    };

    virtual ~Acceleration() = default;
    virtual void
    start_step() = 0;
    /// The next iterate from the current one and the answer to it.
    virtual std::vector<double>
    next(const std::vector<double> &x, const std::vector<double> &answer) = 0;
    /// Keeps what was learnt for later steps where the step was accepted.
    virtual void
    finish_step(bool accepted) = 0;
    /// Relaxation of the last iterate, for iterations.csv (1 where it has no
    /// meaning).
    virtual double
    relaxation() const = 0;
    virtual void
    serialize(Archive &archive) = 0;
  };

  std::unique_ptr<Acceleration>
  make_acceleration(const Acceleration::Parameters &parameters);
} // namespace ephyra::coupling
