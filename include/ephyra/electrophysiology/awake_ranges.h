#pragma once

#include "ephyra/electrophysiology/ionic_model.h"

#include <array>
#include <vector>

namespace ephyra::electrophysiology
{
  /// Which points of a line have to be computed. A block of points sleeps while
  /// everything in it is at rest: potentials within a tolerance of the resting
  /// potential, gates and synapses within what the tolerance means for them.
  /// Its gates then stand still, its ionic current is linear in the distance
  /// from rest, so that the potential goes on towards it, and diffusion wakes
  /// it. The state alone decides, so that nothing is to be saved.
  class AwakeRanges
  {
  public:
    using Range = std::array<int, 2>; ///< first point, one past the last

    /// @p tolerance of the potential, V; 0: all points are always awake.
    AwakeRanges(const IonicModel *model, int n_points, double tolerance);

    void
    update(const double *v, const double *gates, const double *synapse);

    const std::vector<Range> &
    ranges() const
    {
      return awake;
    }
    int
    n_awake() const;
    /// Longest step for which the explicit currents at rest are stable, s.
    double
    largest_resting_step() const
    {
      return resting_slope < 0 ? -1. / resting_slope : 0.;
    }
    /// f of a sleeping point, V/s.
    double
    rate_asleep(const double v) const
    {
      return resting_slope * (v - rest);
    }

  private:
    bool
    asleep(const Range  &block,
           const double *v,
           const double *gates,
           const double *synapse) const;

    static constexpr int block_size = 32;

    int                 n;
    double              tolerance;
    double              rest;
    double              resting_slope = 0; ///< df/dv at rest, 1/s
    std::vector<double> resting_gates;
    std::vector<Range>  awake;
  };
} // namespace ephyra::electrophysiology
