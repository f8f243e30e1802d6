#include "ephyra/electrophysiology/boundary_condition.h"

#include "ephyra/base/parameter_handler.h"

namespace ephyra::electrophysiology
{
  void
  BoundaryCondition::Parameters::declare(ParameterHandler  &prm,
                                         const std::string &section_name)
  {
    const ParameterHandler::Section section(prm, section_name);
    prm.declare_entry("Type",
                      "no flux",
                      patterns::Selection("no flux|potential"),
                      "Natural condition, or the potential held.");
    prm.declare_entry("Potential",
                      Parameters().potential,
                      patterns::TimeFunction("V"),
                      "Held potential as a function of time.");
    prm.declare_entry("Start time",
                      "0 s",
                      patterns::Double("s", 0.),
                      "From when on the potential is held.");
    prm.declare_entry("End time",
                      "0 s",
                      patterns::Double("s", 0.),
                      "Until when it is held; 0: to the end. -69 mV held for "
                      "good launch a second wave after 53 ms.");
  }

  void
  BoundaryCondition::Parameters::parse(ParameterHandler  &prm,
                                       const std::string &section_name)
  {
    const ParameterHandler::Section section(prm, section_name);
    holds_potential    = prm.get("Type") == "potential";
    potential          = prm.get("Potential");
    start              = prm.get_double("Start time");
    const double until = prm.get_double("End time");
    end = until > 0 ? until : std::numeric_limits<double>::infinity();
    if (end <= start)
      prm.add_error("End time", "it must be later than the start time");
  }

  BoundaryCondition::BoundaryCondition(const Parameters &parameters)
    : prm(parameters)
    , potential(parameters.potential, "V")
  {
  }

  bool
  BoundaryCondition::holds(const double t, const double dt) const
  {
    const double middle = t + 0.5 * dt;
    return prm.holds_potential && middle > prm.start && middle < prm.end;
  }

  double
  BoundaryCondition::held_potential(const double t) const
  {
    return potential(t);
  }

  double
  BoundaryCondition::next_event(const double t) const
  {
    if (prm.holds_potential)
      for (const double time : {prm.start, prm.end})
        if (time > t)
          return time;
    return std::numeric_limits<double>::infinity();
  }
} // namespace ephyra::electrophysiology
