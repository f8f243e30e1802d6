#include "ephyra/diagnostics/cycles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ephyra::diagnostics
{
  namespace
  {
    /// Of a period: ends of cycles that steps miss by less are met.
    constexpr double round_off = 1e-9;
    /// Of the range of the speed: smaller rises are no peak.
    constexpr double least_rise = 0.02;

    double
    blend(const double a, const double b, const double share)
    {
      return (1. - share) * a + share * b;
    }

    /// At @p time between two instants; the later one where they are one.
    Cycles::Instant
    between(const Cycles::Instant &a,
            const Cycles::Instant &b,
            const double           time)
    {
      if (!(b.time > a.time) || time >= b.time)
        return b;
      const double s = (time - a.time) / (b.time - a.time);
      return {time,
              blend(a.position, b.position, s),
              blend(a.speed, b.speed, s),
              blend(a.margin, b.margin, s),
              blend(a.inner_margin, b.inner_margin, s),
              blend(a.widest, b.widest, s),
              blend(a.muscle_work, b.muscle_work, s),
              blend(a.fluid_work, b.fluid_work, s)};
    }

    void
    serialize_instant(Archive           &archive,
                      const std::string &name,
                      Cycles::Instant   &x)
    {
      const Archive::Group group(archive, name);
      archive.value("time", x.time);
      archive.value("position", x.position);
      archive.value("speed", x.speed);
      archive.value("margin", x.margin);
      archive.value("inner margin", x.inner_margin);
      archive.value("widest", x.widest);
      archive.value("muscle work", x.muscle_work);
      archive.value("fluid work", x.fluid_work);
    }
  } // namespace

  void
  CycleParameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("Period",
                      "0",
                      patterns::Double("s", 0.),
                      "Of the contraction, for cycles.csv; 0: that of the "
                      "pacing, and without pacing there is no table.");
    prm.declare_entry("Start",
                      "0",
                      patterns::Double("s", 0.),
                      "Of the first cycle; with the period of the pacing, the "
                      "time of the first pulse instead.");
    prm.declare_entry("Towing force",
                      "0",
                      patterns::Expression({"U"}, "N"),
                      "Force that tows the body at rest at the speed U "
                      "(m/s), for the efficiency of a swimmer; 0: there is "
                      "none.");
  }

  void
  CycleParameters::parse(ParameterHandler &prm)
  {
    period       = prm.get_double("Period");
    start        = prm.get_double("Start");
    towing_force = prm.get("Towing force");
  }

  Cycles::Cycles(const CycleParameters &parameters, const Swimmer &swimmer)
    : prm(parameters)
    , swimmer(swimmer)
    , towing_force(parameters.towing_force, {"U"})
  {
  }

  double
  Cycles::end_of_cycle() const
  {
    return prm.start + static_cast<double>(number + 1) * prm.period;
  }

  std::vector<std::string>
  Cycles::columns() const
  {
    std::vector<std::string> names{"cycle [-]",
                                   "mean speed [m/s]",
                                   "change of mean speed [-]",
                                   "distance [m]",
                                   "peak speed [m/s]",
                                   "time of peak speed [s]",
                                   "second peak speed [m/s]",
                                   "time of second peak speed [s]",
                                   "smallest speed [m/s]",
                                   "drop of margin diameter [-]",
                                   "drop of widest diameter [-]",
                                   "Strouhal number [-]",
                                   "Strouhal number of excursion [-]"};
    if (swimmer.rest_inner_radius > 0.)
      names.emplace_back("drop of inner margin diameter [-]");
    if (swimmer.muscle)
      names.insert(names.end(),
                   {"muscle work [J]",
                    "positive muscle work [J]",
                    "work on fluid [J]",
                    "cost of transport [J/(kg m)]",
                    "net cost of transport [J/(kg m)]"});
    if (swimmer.muscle && !towing_force.is_zero())
      names.insert(names.end(), {"efficiency [-]", "net efficiency [-]"});
    return names;
  }

  void
  Cycles::begin(const Instant &now)
  {
    begun         = true;
    first         = now;
    last          = now;
    smallest      = now;
    largest       = now;
    positive_work = 0;
    times.clear();
    speeds.clear();
    collect(now);
  }

  void
  Cycles::collect(const Instant &now)
  {
    times.push_back(now.time);
    speeds.push_back(now.speed);
    smallest.margin       = std::min(smallest.margin, now.margin);
    largest.margin        = std::max(largest.margin, now.margin);
    smallest.inner_margin = std::min(smallest.inner_margin, now.inner_margin);
    smallest.widest       = std::min(smallest.widest, now.widest);
    positive_work += std::max(0., now.muscle_work - last.muscle_work);
    last = now;
  }

  Cycles::Peak
  Cycles::second_peak(const std::size_t peak) const
  {
    const auto range  = std::minmax_element(speeds.begin(), speeds.end());
    double     valley = speeds[peak];
    double     rise   = least_rise * (*range.second - *range.first);
    Peak       result{std::numeric_limits<double>::quiet_NaN(),
                std::numeric_limits<double>::quiet_NaN()};
    for (std::size_t k = peak + 1; k + 1 < speeds.size(); ++k)
      {
        valley = std::min(valley, speeds[k]);
        if (speeds[k] - valley > rise && speeds[k] >= speeds[k + 1])
          {
            rise   = speeds[k] - valley;
            result = {times[k] - first.time, speeds[k]};
          }
      }
    return result;
  }

  void
  Cycles::finish(const Instant &end)
  {
    const double distance = end.position - first.position;
    const double mean     = distance / prm.period;
    const auto   peak     = std::distance(
      speeds.begin(), std::max_element(speeds.begin(), speeds.end()));
    const Peak   second   = second_peak(peak);
    const double per_mean = 1. / (prm.period * std::abs(mean));

    complete = {static_cast<double>(number + 1),
                mean,
                mean == 0. ? 0. : (mean - speed_before) / std::abs(mean),
                distance,
                speeds[peak],
                times[peak] - first.time,
                second.speed,
                second.time,
                *std::min_element(speeds.begin(), speeds.end()),
                1. - smallest.margin / swimmer.rest_radius,
                1. - smallest.widest / swimmer.rest_radius,
                (swimmer.rest_radius - smallest.margin) * per_mean,
                2. * (largest.margin - smallest.margin) * per_mean};
    if (swimmer.rest_inner_radius > 0.)
      complete.push_back(1. -
                         smallest.inner_margin / swimmer.rest_inner_radius);
    if (swimmer.muscle)
      {
        const double work   = end.muscle_work - first.muscle_work;
        const double length = swimmer.mass * std::abs(distance);
        complete.insert(complete.end(),
                        {work,
                         positive_work,
                         end.fluid_work - first.fluid_work,
                         positive_work / length,
                         work / length});
        if (!towing_force.is_zero())
          {
            const double useful = towing_force({mean}) * distance;
            complete.insert(complete.end(),
                            {useful / positive_work, useful / work});
          }
      }
    speed_before = mean;
    ++number;
  }

  std::vector<std::pair<double, Record>>
  Cycles::add(const Instant &now)
  {
    const double                           tolerance = round_off * prm.period;
    std::vector<std::pair<double, Record>> rows;
    if (!begun && now.time >= prm.start - tolerance)
      begin(between(last, now, prm.start));
    if (!begun)
      {
        last = now;
        return rows;
      }
    while (now.time >= end_of_cycle() - tolerance)
      {
        const Instant end = between(last, now, end_of_cycle());
        collect(end);
        finish(end);
        Record                         row;
        const std::vector<std::string> names = columns();
        for (std::size_t k = 0; k < names.size(); ++k)
          row.add(names[k], complete[k]);
        rows.emplace_back(end.time, row);
        begin(end);
      }
    if (now.time > last.time)
      collect(now);
    return rows;
  }

  void
  Cycles::add_results(Record &record) const
  {
    const std::vector<std::string> names = columns();
    for (std::size_t k = 0; k < complete.size(); ++k)
      {
        std::string name = names[k];
        record.add(name.insert(name.find(" ["), " of last cycle"), complete[k]);
      }
  }

  void
  Cycles::serialize(Archive &archive)
  {
    const Archive::Group group(archive, "cycles");
    double               has_begun = begun ? 1. : 0.;
    archive.value("begun", has_begun);
    begun = has_begun != 0.;
    archive.value("number", number);
    serialize_instant(archive, "first", first);
    serialize_instant(archive, "last", last);
    serialize_instant(archive, "smallest", smallest);
    serialize_instant(archive, "largest", largest);
    archive.value("positive work", positive_work);
    archive.value("speed before", speed_before);
    archive.values("times", times);
    archive.values("speeds", speeds);
    archive.values("complete", complete);
  }
} // namespace ephyra::diagnostics
