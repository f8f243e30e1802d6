#pragma once

#include "ephyra/base/expression.h"
#include "ephyra/base/time_function.h"

#include <string>
#include <vector>

namespace ephyra
{
  class ParameterHandler;
}

namespace ephyra::electrophysiology
{
  /// Muscle activation that is given instead of computed,
  ///
  ///   gamma(s, t) = profile(s, t) course(t),   s = theta^1.
  class PrescribedActivation
  {
  public:
    struct Parameters
    {
      std::string profile = "1";
      /// Formula in t (s) or table, see TimeFunction.
      std::string course = "0.5*(1 - cos(2*pi*t))";

      static void
      declare(ParameterHandler &prm);
      void
      parse(ParameterHandler &prm);
    };

    /// Throws InputError for a formula or table that is none.
    explicit PrescribedActivation(const Parameters &parameters);

    double
    value(double s, double t) const;
    /// gamma at many places of the line at one time.
    void
    evaluate(const std::vector<double> &s,
             double                     t,
             std::vector<double>       &gamma) const;

  private:
    Expression   profile;
    TimeFunction course;
  };
} // namespace ephyra::electrophysiology
