#pragma once

#include "ephyra/base/record.h"
#include "ephyra/splines/nurbs_patch.h"

#include <array>
#include <vector>

namespace ephyra::diagnostics
{
  /// Shape of a bell-like patch as it moves: apex at theta^1 = 0, margin at
  /// theta^1 = 1, outer surface at theta^2 = 1. Displacements are control
  /// values u[2 * point + component], m.
  class BodyKinematics
  {
  public:
    explicit BodyKinematics(const splines::NurbsPatch<2> &patch);

    /// Adds: margin radius r(1, 1), inner margin radius r(1, 0), widest radius
    /// (largest r of the outer surface), height (extent along y), apex y, and
    /// the drops of diameter 1 - r / (widest radius at rest) of margin and
    /// widest section, and 1 - r / (r at rest) of the inner margin where that
    /// is off the axis. In the results of a run, the largest drop of the margin
    /// is 1 - min r(1, 1) / a_ex over the time, for a bell.
    void
    evaluate(const std::vector<double> &displacement, Record &record) const;

    /// Radii of one instant, m.
    struct Radii
    {
      double margin, inner_margin, widest;
    };
    Radii
    radii(const std::vector<double> &displacement) const;
    /// The widest radius and the inner radius of the margin (0: on the axis)
    /// at rest, m.
    double
    widest_at_rest() const
    {
      return rest_radius;
    }
    double
    inner_margin_at_rest() const
    {
      return inner_rest_radius;
    }

    /// Present position of a point, m.
    splines::Point
    position(const std::array<double, 2> &theta,
             const std::vector<double>   &displacement) const;

  private:
    const splines::NurbsPatch<2>         patch;
    std::vector<splines::BasisValues<2>> outer; ///< at the samples
    splines::BasisValues<2>              inner_margin;
    double                               rest_radius, inner_rest_radius;

    splines::Point
    position(const splines::BasisValues<2> &basis,
             const std::vector<double>     &displacement) const;
  };
} // namespace ephyra::diagnostics
