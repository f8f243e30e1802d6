#include "ephyra/electrophysiology/synapses.h"

#include "ephyra/base/mpi.h"
#include "ephyra/base/parameter_handler.h"

#include <cmath>
#include <string>

namespace ephyra::electrophysiology
{
  void
  Synapses::Parameters::declare(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Synapses");
    prm.declare_entry("Conductance",
                      "75 nS",
                      patterns::Double("S", 0.),
                      "Peak conductance of one EPSC.");
    prm.declare_entry("Rise time",
                      "20 ms",
                      patterns::Positive("s"),
                      "Time constant of the rise of an EPSC.");
    prm.declare_entry("Fast decay time",
                      "3 ms",
                      patterns::Positive("s"),
                      "First time constant of the decay.");
    prm.declare_entry("Slow decay time",
                      "6 ms",
                      patterns::Positive("s"),
                      "Second time constant of the decay.");
    prm.declare_entry("Fast fraction",
                      "0.957",
                      patterns::Double("", 0., 1.),
                      "Share of the fast decay.");
    prm.declare_entry("Release",
                      "true",
                      patterns::Bool(),
                      "Whether an upward crossing of the release threshold "
                      "triggers an EPSC; without it the wave is slow. An "
                      "isolated neuron never has it.");
    prm.declare_entry("Release threshold",
                      "-70 mV",
                      patterns::Double("V"),
                      "Potential whose upward crossing releases transmitter.");
    prm.declare_entry("Lock-out time",
                      "30 ms",
                      patterns::Double("s", 0.),
                      "Shortest time between two releases of one point.");
    prm.declare_entry("Reflux",
                      "true",
                      patterns::Bool(),
                      "Whether an upward crossing of the reflux threshold "
                      "triggers a second EPSC (not locked out).");
    prm.declare_entry("Reflux threshold",
                      "20 mV",
                      patterns::Double("V"),
                      "Potential whose upward crossing causes the reflux.");
    prm.declare_entry("Trigger time",
                      "interpolated",
                      patterns::Selection("interpolated|rounded"),
                      "Whether the time of a crossing is interpolated inside "
                      "the step (second order) or rounded to its end (first "
                      "order).");
  }

  void
  Synapses::Parameters::parse(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Synapses");
    conductance       = prm.get_double("Conductance");
    rise_time         = prm.get_double("Rise time");
    fast_time         = prm.get_double("Fast decay time");
    slow_time         = prm.get_double("Slow decay time");
    fast_fraction     = prm.get_double("Fast fraction");
    release           = prm.get_bool("Release");
    release_threshold = prm.get_double("Release threshold");
    lock_out          = prm.get_double("Lock-out time");
    reflux            = prm.get_bool("Reflux");
    reflux_threshold  = prm.get_double("Reflux threshold");
    trigger_time      = prm.get("Trigger time") == "rounded"
                          ? TriggerTime::rounded
                          : TriggerTime::interpolated;
  }

  Synapses::Synapses(const Parameters &parameters,
                     const double      capacitance,
                     const int         n_points)
    : prm(parameters)
    , peak(parameters.conductance / capacitance)
    , n(n_points)
    , rate{{1. / prm.fast_time,
            1. / prm.slow_time,
            1. / prm.fast_time + 1. / prm.rise_time,
            1. / prm.slow_time + 1. / prm.rise_time}}
    , amplitude{{prm.fast_fraction,
                 1. - prm.fast_fraction,
                 -prm.fast_fraction,
                 prm.fast_fraction - 1.}}
    , total(n_points, 0.)
    , release_time(n_points, never_happened)
    , reflux_time(n_points, never_happened)
    , decay{}
  {
    for (std::vector<double> &term : terms)
      term.assign(n, 0.);
  }

  void
  Synapses::update_total()
  {
    const double *__restrict__ a = terms[0].data();
    const double *__restrict__ b = terms[1].data();
    const double *__restrict__ c = terms[2].data();
    const double *__restrict__ d = terms[3].data();
    double *__restrict__ sum     = total.data();
    for (int i = 0; i < n; ++i)
      sum[i] = peak * ((a[i] + c[i]) + (b[i] + d[i]));
  }

  void
  Synapses::advance(const double t,
                    const double dt,
                    const double *__restrict__ v_old,
                    const double *__restrict__ v_new)
  {
    if (dt != decay_dt)
      {
        for (int k = 0; k < n_terms; ++k)
          decay[k] = std::exp(-dt * rate[k]);
        decay_dt = dt;
      }
    for (int k = 0; k < n_terms; ++k)
      {
        double *__restrict__ term = terms[k].data();
        const double factor       = decay[k];
        for (int i = 0; i < n; ++i)
          {
            // Long after an EPSC: zero rather than slow subnormal numbers.
            const double x = factor * term[i];
            term[i]        = std::abs(x) < 1e-100 ? 0. : x;
          }
      }

    // Does any point cross one of the thresholds? Rarely.
    const double low = prm.release_threshold, high = prm.reflux_threshold;
    int          crossings = 0;
    for (int i = 0; i < n; ++i)
      crossings += ((v_old[i] < low) & (v_new[i] >= low)) |
                   ((v_old[i] < high) & (v_new[i] >= high));
    if (crossings > 0)
      {
        const double end            = t + dt;
        const auto time_of_crossing = [&](const int i, const double threshold) {
          return prm.trigger_time == TriggerTime::rounded
                   ? end
                   : t + dt * (threshold - v_old[i]) / (v_new[i] - v_old[i]);
        };
        for (int i = 0; i < n; ++i)
          {
            if (prm.release && v_old[i] < low && v_new[i] >= low)
              {
                const double start = time_of_crossing(i, low);
                if (start - release_time[i] >= prm.lock_out)
                  {
                    release_time[i] = start;
                    add_epsc(i, start, end);
                  }
              }
            if (prm.reflux && v_old[i] < high && v_new[i] >= high)
              {
                reflux_time[i] = time_of_crossing(i, high);
                add_epsc(i, reflux_time[i], end);
              }
          }
      }
    update_total();
  }

  void
  Synapses::add_epsc(const int point, const double start, const double now)
  {
    double sum = 0;
    for (int k = 0; k < n_terms; ++k)
      {
        terms[k][point] += amplitude[k] * std::exp(-(now - start) * rate[k]);
        sum += terms[k][point];
      }
    total[point] = peak * sum;
  }

  void
  Synapses::serialize(Archive &archive)
  {
    const Archive::Group group(archive, "synapses");
    for (int k = 0; k < n_terms; ++k)
      archive.values("term " + std::to_string(k), terms[k]);
    archive.values("last release", release_time);
    archive.values("last reflux", reflux_time);
    if (archive.reading())
      update_total();
  }

  void
  Synapses::synchronize(MPI_Comm comm)
  {
    for (std::vector<double> &term : terms)
      mpi::broadcast(term.data(), term.size(), comm);
    mpi::broadcast(release_time.data(), release_time.size(), comm);
    mpi::broadcast(reflux_time.data(), reflux_time.size(), comm);
    update_total();
  }
} // namespace ephyra::electrophysiology
