#include "ephyra/electrophysiology/prescribed_activation.h"

#include "ephyra/base/parameter_handler.h"

namespace ephyra::electrophysiology
{
  void
  PrescribedActivation::Parameters::declare(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Prescribed activation");
    const Parameters                defaults;
    prm.declare_entry("Profile",
                      defaults.profile,
                      patterns::Expression({"s", "t"}),
                      "Activation along the line in s = theta^1 and the time "
                      "t; multiplied by the time course.");
    prm.declare_entry("Time course",
                      defaults.course,
                      patterns::TimeFunction(),
                      "Activation in time, everywhere.");
  }

  void
  PrescribedActivation::Parameters::parse(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Prescribed activation");
    profile = prm.get("Profile");
    course  = prm.get("Time course");
  }

  PrescribedActivation::PrescribedActivation(const Parameters &parameters)
    : profile(parameters.profile, {"s", "t"})
    , course(parameters.course)
  {
  }

  double
  PrescribedActivation::value(const double s, const double t) const
  {
    return profile({s, t}) * course(t);
  }

  void
  PrescribedActivation::evaluate(const std::vector<double> &s,
                                 const double               t,
                                 std::vector<double>       &gamma) const
  {
    const double now = course(t);
    gamma.resize(s.size());
    for (std::size_t i = 0; i < s.size(); ++i)
      gamma[i] = profile({s[i], t}) * now;
  }
} // namespace ephyra::electrophysiology
