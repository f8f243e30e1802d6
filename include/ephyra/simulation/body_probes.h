#pragma once

#include "ephyra/base/parameter_handler.h"
#include "ephyra/simulation/run_output.h"
#include "ephyra/splines/nurbs_patch.h"

#include <array>
#include <string>
#include <vector>

namespace ephyra::simulation
{
  /// Material points of a body that are followed: section "Body probe NAME".
  struct BodyProbe
  {
    std::string           name;
    std::array<double, 2> theta{{0., 0.}};

    static void
    declare(ParameterHandler &prm);
    /// All instances of the section.
    static std::vector<BodyProbe>
    parse_all(ParameterHandler &prm);
  };

  /// Writes probes/NAME.csv: position, displacement and velocity, m and m/s.
  class BodyProbes
  {
  public:
    BodyProbes(const std::vector<BodyProbe> &probes,
               const splines::NurbsPatch<2> &patch);

    void
    write(double                     time,
          const std::vector<double> &displacement,
          const std::vector<double> &velocity,
          RunOutput                 &output) const;

  private:
    struct Point
    {
      std::string             name;
      splines::Point          rest; ///< m
      splines::BasisValues<2> basis;
    };
    std::vector<Point> points;
  };
} // namespace ephyra::simulation
