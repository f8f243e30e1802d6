#pragma once

#include <vector>

namespace ephyra::coupling
{
  /// Control values of a body at one instant, 2 * point + component.
  struct BodyMotion
  {
    std::vector<double> position;     ///< m
    std::vector<double> velocity;     ///< m/s
    std::vector<double> acceleration; ///< m/s^2
  };
} // namespace ephyra::coupling
