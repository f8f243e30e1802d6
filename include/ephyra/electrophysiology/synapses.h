#pragma once

#include "ephyra/base/archive.h"

#include <mpi.h>

#include <array>
#include <vector>

namespace ephyra
{
  class ParameterHandler;
}

namespace ephyra::electrophysiology
{
  /// Excitatory postsynaptic currents of many points, eqs. (44), (45):
  ///
  ///   s(t) = g_syn/C_m sum_i (1 - e^{-t'/rise})(a e^{-t'/fast}
  ///                                             + (1-a) e^{-t'/slow}),
  ///   t' = t - t_i > 0.
  ///
  /// Each term is a sum of four decaying exponentials, so that all EPSCs of a
  /// point together are four numbers, multiplied by constants in every step.
  ///
  /// Two triggers per point: *release*, when v crosses -70 mV upwards, then
  /// none within 30 ms of the last; *reflux*, whenever v crosses +20 mV
  /// upwards. External EPSCs always add and lock nothing. The crossing time is
  /// interpolated inside the step, or rounded up to its end.
  class Synapses
  {
  public:
    enum class TriggerTime
    {
      interpolated,
      rounded
    };

    struct Parameters
    {
      double      conductance       = 75e-9;  ///< g_syn, S
      double      rise_time         = 20e-3;  ///< s
      double      fast_time         = 3e-3;   ///< s
      double      slow_time         = 6e-3;   ///< s
      double      fast_fraction     = 0.957;  ///< a
      bool        release           = true;   ///< first trigger
      double      release_threshold = -70e-3; ///< V
      double      lock_out          = 30e-3;  ///< s
      bool        reflux            = true;   ///< second trigger
      double      reflux_threshold  = 20e-3;  ///< V
      TriggerTime trigger_time      = TriggerTime::interpolated;

      static void
      declare(ParameterHandler &prm);
      void
      parse(ParameterHandler &prm);
    };

    /// @p capacitance of the membrane that g_syn belongs to, F.
    Synapses(const Parameters &parameters, double capacitance, int n_points);

    /// s over C_m at the current time, 1/s, n_points values.
    const double *
    conductance() const
    {
      return total.data();
    }

    /// From t to t + dt, in which the potential went from v_old to v_new.
    void
    advance(double t, double dt, const double *v_old, const double *v_new);
    /// One more EPSC at a point that began at @p start <= @p now, the time up
    /// to which the synapses were advanced.
    void
    add_epsc(int point, double start, double now);

    /// Time of the last release and of the last reflux of each point, s; far
    /// in the past (never_happened) where there was none.
    const std::vector<double> &
    last_release() const
    {
      return release_time;
    }
    const std::vector<double> &
    last_reflux() const
    {
      return reflux_time;
    }
    static constexpr double never_happened = -1e30;

    void
    serialize(Archive &archive);
    /// The first rank's state on all ranks.
    void
    synchronize(MPI_Comm comm);

  private:
    void
    update_total();

    static constexpr int n_terms = 4;

    Parameters                               prm;
    double                                   peak; ///< g_syn/C_m, 1/s
    int                                      n;
    std::array<double, n_terms>              rate;      ///< 1/s
    std::array<double, n_terms>              amplitude; ///< of one EPSC
    std::array<std::vector<double>, n_terms> terms;
    std::vector<double>                      total;
    std::vector<double>                      release_time;
    std::vector<double>                      reflux_time;
    double                      decay_dt = -1; ///< step of the factors below
    std::array<double, n_terms> decay;
  };
} // namespace ephyra::electrophysiology
