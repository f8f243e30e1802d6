#include "ephyra/coupling/acceleration.h"

#include "ephyra/coupling/aitken.h"
#include "ephyra/coupling/quasi_newton.h"

namespace ephyra::coupling
{
  void
  Acceleration::Parameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("Acceleration",
                      "quasi-Newton",
                      patterns::Selection("relaxation|Aitken|quasi-Newton"),
                      "How the interface iteration is accelerated: constant "
                      "relaxation, Aitken's dynamic relaxation, or the "
                      "interface quasi-Newton method (IQN-ILS).");
    prm.declare_entry("Initial relaxation",
                      "0.3",
                      patterns::Double("", 1e-6, 1.),
                      "Relaxation of the first iteration of a step as long as "
                      "nothing is known from earlier steps; the constant "
                      "factor of \"relaxation\".");
    prm.declare_entry("Largest relaxation",
                      "1",
                      patterns::Double("", 1e-6, 10.),
                      "Bound of Aitken's relaxation factor.");
    prm.declare_entry(
      "Reused steps",
      "8",
      patterns::Integer(0, 100),
      "Quasi-Newton: earlier steps whose differences are kept.");
    prm.declare_entry("Filter",
                      "1e-2",
                      patterns::Double("", 0., 1.),
                      "Quasi-Newton: differences whose part orthogonal to the "
                      "newer ones is smaller than this fraction are dropped.");
  }

  void
  Acceleration::Parameters::parse(ParameterHandler &prm)
  {
    type               = prm.get("Acceleration");
    initial_relaxation = prm.get_double("Initial relaxation");
    largest_relaxation = prm.get_double("Largest relaxation");
    reused_steps       = prm.get_integer("Reused steps");
    filter             = prm.get_double("Filter");
  }

  std::unique_ptr<Acceleration>
  make_acceleration(const Acceleration::Parameters &parameters)
  {
    if (parameters.type == "quasi-Newton")
      return std::make_unique<QuasiNewton>(parameters);
    return std::make_unique<Aitken>(parameters, parameters.type == "Aitken");
  }
} // namespace ephyra::coupling
