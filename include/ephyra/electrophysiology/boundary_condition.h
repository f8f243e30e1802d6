#pragma once

#include "ephyra/base/time_function.h"

#include <limits>
#include <string>

namespace ephyra
{
  class ParameterHandler;
}

namespace ephyra::electrophysiology
{
  /// Condition at one end of the line: no flux, or the potential held for a
  /// while.
  struct BoundaryCondition
  {
    struct Parameters
    {
      bool        holds_potential = false;
      std::string potential       = "-69 mV"; ///< see TimeFunction
      double      start           = 0;        ///< s
      double      end = std::numeric_limits<double>::infinity(); ///< s

      /// @p section is the name of the subsection.
      static void
      declare(ParameterHandler &prm, const std::string &section);
      void
      parse(ParameterHandler &prm, const std::string &section);
    };

    explicit BoundaryCondition(const Parameters &parameters);

    /// Whether a step from t to t + dt lies within the time of holding.
    bool
    holds(double t, double dt) const;
    double
    held_potential(double t) const; ///< V
    /// First start or end of holding later than t, s; infinite without one.
    double
    next_event(double t) const;

  private:
    Parameters   prm;
    TimeFunction potential;
  };
} // namespace ephyra::electrophysiology
