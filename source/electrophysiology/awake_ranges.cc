#include "ephyra/electrophysiology/awake_ranges.h"

#include <algorithm>
#include <cmath>

namespace ephyra::electrophysiology
{
  namespace
  {
    // What one volt off the resting potential means for gates (1/V) and
    // synapses: the conductance (1/s per V) whose current equals that of the
    // leakage.
    constexpr double gate_per_volt    = 1.;
    constexpr double synapse_per_volt = 1e4;

    double
    largest_distance(const double *x, const int n, const double from)
    {
      double largest = 0;
      for (int i = 0; i < n; ++i)
        {
          const double distance = std::abs(x[i] - from);
          largest               = distance > largest ? distance : largest;
        }
      return largest;
    }
  } // namespace

  AwakeRanges::AwakeRanges(const IonicModel *model,
                           const int         n_points,
                           const double      tolerance)
    : n(n_points)
    , tolerance(model ? tolerance : 0.)
    , rest(model ? model->rest_potential() : 0.)
    , resting_gates(model ? model->n_gates() : 0)
    , awake{{{0, n_points}}}
  {
    if (!model)
      return;
    model->steady_gates(rest, resting_gates.data());
    constexpr double    h    = 1e-5;
    const double        v[2] = {rest - h, rest + h}, no_synapse[2] = {0., 0.};
    double              f[2];
    std::vector<double> gates;
    for (const double gate : resting_gates)
      gates.insert(gates.end(), 2, gate);
    model->rate(2, v, gates.data(), 2, no_synapse, f);
    resting_slope = (f[1] - f[0]) / (2 * h);
  }

  bool
  AwakeRanges::asleep(const Range  &block,
                      const double *v,
                      const double *gates,
                      const double *synapse) const
  {
    const int begin = block[0], size = block[1] - block[0];
    // Not a number is not asleep.
    double sum = 0;
    for (int i = begin; i < block[1]; ++i)
      sum += v[i];
    if (!std::isfinite(sum) ||
        largest_distance(v + begin, size, rest) > tolerance ||
        largest_distance(synapse + begin, size, 0.) >
          synapse_per_volt * tolerance)
      return false;
    for (std::size_t k = 0; k < resting_gates.size(); ++k)
      if (largest_distance(gates + k * n + begin, size, resting_gates[k]) >
          gate_per_volt * tolerance)
        return false;
    return true;
  }

  void
  AwakeRanges::update(const double *v,
                      const double *gates,
                      const double *synapse)
  {
    if (tolerance <= 0)
      return;
    awake.clear();
    for (int begin = 0; begin < n; begin += block_size)
      {
        const Range block{{begin, std::min(n, begin + block_size)}};
        if (asleep(block, v, gates, synapse))
          continue;
        if (!awake.empty() && awake.back()[1] == begin)
          awake.back()[1] = block[1];
        else
          awake.push_back(block);
      }
  }

  int
  AwakeRanges::n_awake() const
  {
    int sum = 0;
    for (const Range &range : awake)
      sum += range[1] - range[0];
    return sum;
  }
} // namespace ephyra::electrophysiology
