#pragma once

#include "ephyra/base/parameter_handler.h"
#include "ephyra/elasticity/body_measures.h"

#include <functional>
#include <string>
#include <vector>

namespace ephyra::simulation
{
  /// A body at one instant, as what is recorded of it sees it.
  struct BodyState
  {
    const std::vector<double> &displacement; ///< 2 * point + component, m
    const std::vector<double> &velocity;     ///< m/s
    /// At theta^1, theta^2, with the displacement and activation of that
    /// instant.
    std::function<elasticity::PointFields(double, double)> fields;
  };

  /// One column of what is recorded at a material point.
  struct BodyQuantity
  {
    std::string name; ///< with its unit: column of a probe
    std::string file; ///< end of the name of a profile
    /// Index into the values that evaluate_quantities() gives.
    int index;
  };

  /// Entry "Quantities": names of groups of quantities. A group that is named
  /// twice is an error.
  void
  declare_quantities(ParameterHandler &prm, const std::string &default_value);
  std::vector<std::string>
  parse_quantities(ParameterHandler &prm);

  /// The quantities of groups such as "displacement", in their order; SI.
  /// Throws InputError on another name.
  std::vector<BodyQuantity>
  body_quantities(const std::vector<std::string> &groups);

  /// The values of all quantities at a material point. @p rest and @p velocity
  /// are its reference position (m) and its velocity (m/s).
  std::vector<double>
  evaluate_quantities(const splines::Point          &rest,
                      const splines::Point          &velocity,
                      const elasticity::PointFields &fields);
} // namespace ephyra::simulation
