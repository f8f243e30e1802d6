#include "ephyra/electrophysiology/activation.h"

#include "ephyra/base/parameter_handler.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace ephyra::electrophysiology
{
  void
  Activation::Parameters::declare(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Activation");
    prm.declare_entry("Threshold",
                      "0.005",
                      patterns::Double("", 0., 1.),
                      "G_a at which a replay begins.");
    prm.declare_entry("Peak",
                      "0.902",
                      patterns::Positive(),
                      "G_a that counts as full activation.");
    prm.declare_entry("Time stretch",
                      "140",
                      patterns::Double("", 1.),
                      "1/eta: how much slower than the gate the muscle is.");
    prm.declare_entry("Overlapping replays",
                      "largest",
                      patterns::Selection("largest|newest"),
                      "What counts where a spike comes before the replay of "
                      "the last one has ended.");
    prm.declare_entry("Start",
                      "continuous",
                      patterns::Selection("continuous|literal"),
                      "continuous: the threshold is subtracted, so that the "
                      "activation starts from zero; literal: eq. (46) as "
                      "printed, with a jump of 0.0055.");
    prm.declare_entry("Fit to pacing",
                      "false",
                      patterns::Bool(),
                      "Whether replays are shortened so that one ends when "
                      "the next begins.");
    prm.declare_entry("Spike duration",
                      "10.1 ms",
                      patterns::Positive("s"),
                      "Time for which G_a exceeds its threshold; used to fit "
                      "replays to the pacing.");
    prm.declare_entry("Sample interval",
                      "0.1 ms",
                      patterns::Positive("s"),
                      "Interval at which G_a is kept.");
    prm.declare_entry("Clip",
                      "false",
                      patterns::Bool(),
                      "Whether the activation is cut at one. G_a peaks higher "
                      "than in the tissue where the wave starts or ends.");
  }

  void
  Activation::Parameters::parse(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Activation");
    threshold = prm.get_double("Threshold");
    peak      = prm.get_double("Peak");
    stretch   = prm.get_double("Time stretch");
    replays   = prm.get("Overlapping replays") == "newest" ? Replays::newest
                                                           : Replays::largest;
    start = prm.get("Start") == "literal" ? Start::literal : Start::continuous;
    fit_to_pacing   = prm.get_bool("Fit to pacing");
    spike_duration  = prm.get_double("Spike duration");
    sample_interval = prm.get_double("Sample interval");
    clip            = prm.get_bool("Clip");
    if (threshold >= peak)
      prm.add_error("Threshold", "it must be below the peak");
  }

  Activation::Activation(const Parameters &parameters,
                         const int         n_points,
                         const double      pacing_frequency)
    : prm(parameters)
    , replay_speed(1. / prm.stretch)
    // A literal replay is followed down to where it is negligible.
    , closing_level(prm.start == Start::literal ? 0.01 * prm.threshold
                                                : prm.threshold)
    , points(n_points)
    , previous(n_points, std::numeric_limits<double>::max())
  {
    if (prm.fit_to_pacing)
      replay_speed = std::min(
        1., std::max(replay_speed, prm.spike_duration * pacing_frequency));
  }

  void
  Activation::initialize(const double *gate)
  {
    std::copy(gate, gate + previous.size(), previous.begin());
  }

  double
  Activation::sample_time(const std::size_t k) const
  {
    const double fine =
      static_cast<double>(std::min<std::size_t>(k, n_fine)) / refinement;
    return prm.sample_interval *
           (fine + static_cast<double>(std::max<std::size_t>(k, n_fine)) -
            n_fine);
  }

  void
  Activation::begin_replay(PointHistory &history, const double start) const
  {
    std::vector<Replay> &replays = history.replays;
    // All but one that is being recorded may have ended.
    const auto ended =
      std::find_if(replays.begin(), replays.end(), [&](const Replay &replay) {
        return start >
               replay.start + sample_time(replay.samples.size()) / replay_speed;
      });
    if (ended != replays.end())
      std::rotate(ended, ended + 1, replays.end());
    else
      {
        replays.emplace_back();
        replays.back().samples.reserve(static_cast<std::size_t>(
          n_fine + 1.1 * prm.spike_duration / prm.sample_interval));
      }
    replays.back().start = start;
    replays.back().samples.clear();
    history.recording = true;
  }

  void
  Activation::record_point(const int    point,
                           const double t,
                           const double dt,
                           const double before,
                           const double now)
  {
    Replay &replay = points[point].replays.back();
    for (;;)
      {
        const double time = replay.start + sample_time(replay.samples.size());
        if (time > t + dt)
          break;
        replay.samples.push_back(
          static_cast<float>(before + (now - before) * (time - t) / dt));
      }
    // One sample below the level is kept for the interpolation.
    if (now < closing_level && replay.samples.back() < closing_level)
      points[point].recording = false;
  }

  void
  Activation::record(const double t,
                     const double dt,
                     const double *__restrict__ gate)
  {
    const int n                       = n_points();
    const double *__restrict__ before = previous.data();
    int n_started                     = 0;
    for (int i = 0; i < n; ++i)
      n_started += (before[i] < prm.threshold) & (gate[i] >= prm.threshold);
    for (int i = 0; n_started > 0 && i < n; ++i)
      if (before[i] < prm.threshold && gate[i] >= prm.threshold)
        {
          if (!points[i].recording)
            recording.push_back(i);
          begin_replay(points[i],
                       t + dt * (prm.threshold - before[i]) /
                             (gate[i] - before[i]));
        }
    for (const int i : recording)
      record_point(i, t, dt, before[i], gate[i]);
    recording.erase(
      std::remove_if(recording.begin(),
                     recording.end(),
                     [&](const int i) { return !points[i].recording; }),
      recording.end());
    std::copy(gate, gate + n, previous.begin());
  }

  double
  Activation::value(const Replay &replay, const double t) const
  {
    // Place in the denser samples or in those after them.
    const int all = static_cast<int>(replay.samples.size());
    double    x   = (t - replay.start) * replay_speed / prm.sample_interval;
    if (x < 0)
      return 0;
    constexpr double fine_end = static_cast<double>(n_fine) / refinement;
    const bool       is_fine  = x < fine_end || all <= n_fine + 1;
    x                         = is_fine ? x * refinement : x - fine_end;
    const int    n       = is_fine ? std::min(all, n_fine + 1) : all - n_fine;
    const float *samples = replay.samples.data() + (is_fine ? 0 : n_fine);
    if (x > n - 1 + 1e-9)
      return 0;
    double gate;
    if (n < 4)
      {
        const int    j = std::min(static_cast<int>(x), std::max(n - 2, 0));
        const double s = x - j;
        gate = n == 1 ? samples[0] : (1 - s) * samples[j] + s * samples[j + 1];
      }
    else
      {
        // Lagrange's cubic through four samples around x.
        const int    j = std::clamp(static_cast<int>(x) - 1, 0, n - 4);
        const float *G = samples + j;
        const double s = x - j;
        gate           = -G[0] * (s - 1) * (s - 2) * (s - 3) / 6. +
               G[1] * s * (s - 2) * (s - 3) / 2. -
               G[2] * s * (s - 1) * (s - 3) / 2. +
               G[3] * s * (s - 1) * (s - 2) / 6.;
      }
    const double gamma =
      prm.start == Start::literal
        ? gate / prm.peak
        : std::max(0., (gate - prm.threshold) / (prm.peak - prm.threshold));
    return prm.clip ? std::min(gamma, 1.) : gamma;
  }

  double
  Activation::value(const int point, const double t) const
  {
    const std::vector<Replay> &replays = points[point].replays;
    if (replays.empty())
      return 0;
    if (prm.replays == Replays::newest)
      return value(replays.back(), t);
    double largest = 0;
    for (const Replay &replay : replays)
      largest = std::max(largest, value(replay, t));
    return largest;
  }

  double
  Activation::last_start(const int point) const
  {
    return points[point].replays.empty() ? -1e30
                                         : points[point].replays.back().start;
  }

  std::size_t
  Activation::n_samples() const
  {
    std::size_t sum = 0;
    for (const PointHistory &history : points)
      for (const Replay &replay : history.replays)
        sum += replay.samples.size();
    return sum;
  }

  void
  Activation::serialize(Archive &archive)
  {
    const Archive::Group group(archive, "activation");
    archive.values("previous gate", previous);
    // For each point: whether it is recording, number of replays, and of each
    // its start, number of samples and samples.
    if (!archive.reading())
      {
        packed.clear();
        for (const PointHistory &history : points)
          {
            const std::size_t header[2] = {history.recording,
                                           history.replays.size()};
            packed.insert(packed.end(), header, header + 2);
            for (const Replay &replay : history.replays)
              {
                packed.push_back(replay.start);
                packed.push_back(static_cast<double>(replay.samples.size()));
                // Two samples in the place of one double.
                const std::size_t at = packed.size();
                packed.resize(at + (replay.samples.size() + 1) / 2);
                std::memcpy(&packed[at],
                            replay.samples.data(),
                            replay.samples.size() * sizeof(float));
              }
          }
      }
    archive.values("replays", packed);
    if (archive.reading())
      {
        recording.clear();
        auto next = packed.cbegin();
        for (PointHistory &history : points)
          {
            history.recording = *next++ != 0;
            if (history.recording)
              recording.push_back(static_cast<int>(&history - &points[0]));
            history.replays.resize(static_cast<std::size_t>(*next++));
            for (Replay &replay : history.replays)
              {
                replay.start         = *next++;
                const auto n_samples = static_cast<std::size_t>(*next++);
                replay.samples.resize(n_samples);
                std::memcpy(replay.samples.data(),
                            packed.data() + (next - packed.cbegin()),
                            n_samples * sizeof(float));
                next += static_cast<std::ptrdiff_t>((n_samples + 1) / 2);
              }
          }
      }
  }
} // namespace ephyra::electrophysiology
