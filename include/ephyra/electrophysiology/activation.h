#pragma once

#include "ephyra/base/archive.h"

#include <vector>

namespace ephyra
{
  class ParameterHandler;
}

namespace ephyra::electrophysiology
{
  /// Muscle activation by a slow replay of the gate G_a, eq. (46) of Nitti et
  /// al. 2023: at a point where G_a exceeds 0.005 at the time t*,
  ///
  ///   gamma(t) = G_a(t* + eta (t - t*)) / 0.902,  eta = 1/140.
  ///
  /// As printed gamma jumps from 0 to 0.0055 at t* ("literal" start); the
  /// default subtracts the threshold and rescales,
  /// gamma = (G_a - 0.005)/(0.902 - 0.005), which starts from 0 and peaks at 1.
  /// A replay lasts 1.4 s: where the next spike comes earlier, gamma is the
  /// largest of the replays still running (default), or that of the newest
  /// one alone, which then drops at once.
  ///
  /// G_a is kept at samples of a fixed interval, counted from t*, until it
  /// falls below the threshold again, the first 100 of them ten times denser:
  /// about 10 ms, 200 samples in single precision or 0.8 kB for each point and
  /// running replay. Between samples it is a cubic.
  class Activation
  {
  public:
    enum class Replays
    {
      largest,
      newest
    };
    enum class Start
    {
      continuous,
      literal
    };

    struct Parameters
    {
      double  threshold       = 0.005;
      double  peak            = 0.902;
      double  stretch         = 140; ///< 1/eta
      Replays replays         = Replays::largest;
      Start   start           = Start::continuous;
      bool    fit_to_pacing   = false;
      double  spike_duration  = 10.1e-3; ///< of G_a above its threshold, s
      double  sample_interval = 0.1e-3;  ///< s
      bool    clip            = false;   ///< at one

      static void
      declare(ParameterHandler &prm);
      void
      parse(ParameterHandler &prm);
    };

    /// With fit_to_pacing, eta is raised to spike_duration * pacing_frequency
    /// where that is larger than 1/stretch: a replay then ends when the next
    /// begins.
    Activation(const Parameters &parameters,
               int               n_points,
               double            pacing_frequency);

    /// G_a of all points at the initial time.
    void
    initialize(const double *gate);
    /// G_a of all points at t + dt; the steps have to follow one another.
    void
    record(double t, double dt, const double *gate);

    /// gamma of a point at a time up to the last recorded one.
    double
    value(int point, double t) const;
    int
    n_points() const
    {
      return static_cast<int>(points.size());
    }
    double
    eta() const
    {
      return replay_speed;
    }
    /// Time t* of the last activation of a point, s; negative and huge where
    /// there was none.
    double
    last_start(int point) const;
    /// Samples held in all histories, of 4 B each.
    std::size_t
    n_samples() const;

    void
    serialize(Archive &archive);

  private:
    struct Replay
    {
      double             start;
      std::vector<float> samples;
    };
    static constexpr int n_fine     = 100;
    static constexpr int refinement = 10;

    struct PointHistory
    {
      /// The newest is the last.
      std::vector<Replay> replays;
      bool                recording = false;
    };

    double
    value(const Replay &replay, double t) const;
    /// Time of a sample after the start of its replay, s: the first n_fine are
    /// denser, because G_a turns sharply where the front passes.
    double
    sample_time(std::size_t k) const;
    /// Samples of a point up to t + dt.
    void
    record_point(int point, double t, double dt, double before, double now);
    /// Adds a replay in the place of one that has ended, or in a new one.
    void
    begin_replay(PointHistory &history, double start) const;

    Parameters                prm;
    double                    replay_speed;
    double                    closing_level;
    std::vector<PointHistory> points;
    std::vector<int>          recording; ///< points that record
    std::vector<double>       previous;  ///< G_a at the last recorded time
    std::vector<double>       packed;    ///< buffer of serialize()
  };
} // namespace ephyra::electrophysiology
