#pragma once

#include "ephyra/base/expression.h"

#include <string>
#include <vector>

namespace ephyra
{
  class ParameterHandler;
}

namespace ephyra::electrophysiology
{
  /// Muscle activation gamma(s, t) given by a formula or a table in time
  /// instead of being computed; s = theta^1.
  class PrescribedActivation
  {
  public:
    struct Parameters
    {
      /// In s and t (s); used unless there is a table.
      std::string formula = "0.5*(1 - cos(2*pi*t))";
      /// Table of gamma(t), linear in between, constant beyond its ends.
      std::vector<double> times; ///< s, increasing
      std::vector<double> values;
      /// Repeats formula or table with this period, s; 0: not at all.
      double period = 0;

      static void
      declare(ParameterHandler &prm);
      void
      parse(ParameterHandler &prm);
    };

    /// Throws InputError for a table that is not one.
    explicit PrescribedActivation(const Parameters &parameters);

    double
    value(double s, double t) const;
    /// gamma at many places of the line at one time.
    void
    evaluate(const std::vector<double> &s,
             double                     t,
             std::vector<double>       &gamma) const;

  private:
    double
    table_value(double t) const;

    Parameters prm;
    Expression expression;
  };
} // namespace ephyra::electrophysiology
