#include "ephyra/electrophysiology/prescribed_activation.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/parameter_handler.h"

#include <algorithm>
#include <cmath>

namespace ephyra::electrophysiology
{
  void
  PrescribedActivation::Parameters::declare(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Prescribed activation");
    prm.declare_entry("Formula",
                      Parameters().formula,
                      patterns::Expression({"s", "t"}),
                      "Activation in the coordinate s = theta^1 and the time "
                      "t; a table takes precedence.");
    prm.declare_entry("Times",
                      "",
                      patterns::List(patterns::Double("s")),
                      "Increasing times of a table.");
    prm.declare_entry("Values",
                      "",
                      patterns::List(patterns::Double()),
                      "Activation at the times of the table, everywhere.");
    prm.declare_entry("Period",
                      "0 s",
                      patterns::Double("s", 0.),
                      "Formula and table repeat with this period; 0: not.");
  }

  void
  PrescribedActivation::Parameters::parse(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Prescribed activation");
    formula = prm.get("Formula");
    times   = prm.get_double_list("Times");
    values  = prm.get_double_list("Values");
    period  = prm.get_double("Period");
    if (times.size() != values.size())
      prm.add_error("Values", "there must be as many values as times");
    if (std::adjacent_find(
          times.begin(), times.end(), std::greater_equal<>()) != times.end())
      prm.add_error("Times", "the times must increase");
  }

  PrescribedActivation::PrescribedActivation(const Parameters &parameters)
    : prm(parameters)
    , expression(parameters.formula, {"s", "t"})
  {
    EphyraThrowIf(prm.times.size() != prm.values.size() ||
                    std::adjacent_find(prm.times.begin(),
                                       prm.times.end(),
                                       std::greater_equal<>()) !=
                      prm.times.end(),
                  InputError,
                  "The table of the prescribed activation has "
                    << prm.times.size() << " times and " << prm.values.size()
                    << " values; it needs as many values as times, and the "
                       "times must increase.");
  }

  double
  PrescribedActivation::table_value(const double t) const
  {
    const auto upper = std::upper_bound(prm.times.begin(), prm.times.end(), t);
    if (upper == prm.times.begin())
      return prm.values.front();
    if (upper == prm.times.end())
      return prm.values.back();
    const auto   i = upper - prm.times.begin();
    const double x = (t - prm.times[i - 1]) / (prm.times[i] - prm.times[i - 1]);
    return (1 - x) * prm.values[i - 1] + x * prm.values[i];
  }

  double
  PrescribedActivation::value(const double s, const double t) const
  {
    const double time =
      prm.period > 0 ? t - prm.period * std::floor(t / prm.period) : t;
    return prm.times.empty() ? expression({s, time}) : table_value(time);
  }

  void
  PrescribedActivation::evaluate(const std::vector<double> &s,
                                 const double               t,
                                 std::vector<double>       &gamma) const
  {
    gamma.resize(s.size());
    for (std::size_t i = 0; i < s.size(); ++i)
      gamma[i] = value(s[i], t);
  }
} // namespace ephyra::electrophysiology
