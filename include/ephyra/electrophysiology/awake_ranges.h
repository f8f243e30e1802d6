#pragma once

#include "ephyra/electrophysiology/ionic_model.h"

#include <array>
#include <vector>

namespace ephyra::electrophysiology
{
  /// Which points of a line have to be computed. A block of points sleeps while
  /// everything in it is at rest: potentials within a tolerance of the resting
  /// potential, gates and synapses within what the tolerance means for them.
  /// Its gates then stand still and its ionic currents are zero; diffusion goes
  /// on and wakes it. The state alone decides, so that nothing is to be saved.
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
    std::vector<double> resting_gates;
    std::vector<Range>  awake;
  };
} // namespace ephyra::electrophysiology
