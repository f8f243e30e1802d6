#include "ephyra/electrophysiology/crossing_probes.h"

namespace ephyra::electrophysiology
{
  int
  CrossingProbes::add(const MonodomainOperator &monodomain,
                      const double              theta,
                      const double              level)
  {
    probes.emplace_back();
    probes.back().theta = theta;
    probes.back().level = level;
    monodomain.basis(theta, probes.back().first, probes.back().basis);
    return static_cast<int>(probes.size()) - 1;
  }

  void
  CrossingProbes::record(const double               t,
                         const double               dt,
                         const std::vector<double> &old_v,
                         const std::vector<double> &new_v)
  {
    for (Probe &probe : probes)
      {
        double before = 0, after = 0;
        for (std::size_t a = 0; a < probe.basis.size(); ++a)
          {
            before += probe.basis[a] * old_v[probe.first + a];
            after += probe.basis[a] * new_v[probe.first + a];
          }
        if (before < probe.level && after >= probe.level)
          probe.times.push_back(t +
                                dt * (probe.level - before) / (after - before));
      }
  }

  void
  CrossingProbes::serialize(Archive &archive)
  {
    if (probes.empty())
      return;
    std::vector<double> numbers, times;
    for (const Probe &probe : probes)
      {
        numbers.push_back(static_cast<double>(probe.times.size()));
        times.insert(times.end(), probe.times.begin(), probe.times.end());
      }
    archive.values("numbers of crossings", numbers);
    archive.values("crossing times", times);
    if (!archive.reading())
      return;
    auto begin = times.begin();
    for (std::size_t i = 0; i < probes.size(); ++i)
      {
        const auto end = begin + static_cast<std::ptrdiff_t>(numbers[i]);
        probes[i].times.assign(begin, end);
        begin = end;
      }
  }
} // namespace ephyra::electrophysiology
