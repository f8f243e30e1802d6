#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/base/expression.h"
#include "ephyra/base/parameter_handler.h"
#include "ephyra/base/record.h"

#include <string>
#include <utility>
#include <vector>

namespace ephyra::diagnostics
{
  /// Section "Cycles".
  struct CycleParameters
  {
    double period = 0; ///< s; 0: that of the pacing, if there is one
    double start  = 0; ///< of the first cycle, s
    /// Formula in U (m/s): force that tows the body at rest, N; 0: none.
    std::string towing_force = "0";

    static void
    declare(ParameterHandler &prm);
    void
    parse(ParameterHandler &prm);
    bool
    on() const
    {
      return period > 0;
    }
  };

  /// What a swimmer does in each cycle of its contraction. It is shown every
  /// step; what happens at the ends of a cycle is interpolated between the
  /// steps that enclose them.
  class Cycles
  {
  public:
    /// A swimmer after a step.
    struct Instant
    {
      double time         = 0; ///< s
      double position     = 0; ///< of the centre of mass along y, m
      double speed        = 0; ///< m/s
      double margin       = 0; ///< radius, m
      double inner_margin = 0; ///< radius, m
      double widest       = 0; ///< radius, m
      double muscle_work  = 0; ///< since the start of the run, J
      double fluid_work   = 0; ///< done on the fluid since then, J
    };
    /// Radii at rest (m; inner: 0 for a body closed there), mass (kg) and whether there is a muscle.
    struct Swimmer
    {
      double rest_radius, rest_inner_radius, mass;
      bool   muscle;
    };

    Cycles(const CycleParameters &parameters, const Swimmer &swimmer);

    /// The state after a step, or at the start of the run; returns the cycles
    /// that end with it: their ends (s) and what is known of them,
    /// see docs/manual/energy.md.
    std::vector<std::pair<double, Record>>
    add(const Instant &now);
    /// Adds the columns of the last cycle that is complete, none before that,
    /// as "mean speed of last cycle [m/s]".
    void
    add_results(Record &record) const;
    void
    serialize(Archive &archive);

  private:
    struct Peak
    {
      double time, speed; ///< not a number where there is none
    };

    std::vector<std::string>
    columns() const;
    double
    end_of_cycle() const;
    void
    begin(const Instant &now);
    void
    collect(const Instant &now);
    void
    finish(const Instant &end);
    /// After the largest speed at index @p peak: the end of the largest rise.
    Peak
    second_peak(std::size_t peak) const;

    const CycleParameters prm;
    const Swimmer         swimmer;
    const Expression      towing_force;
    bool                  begun  = false;
    std::int64_t          number = 0;        ///< of the present cycle, from 0
    Instant               first;             ///< of the present cycle
    Instant               last;              ///< the last that was seen
    Instant               smallest, largest; ///< radii of the present cycle
    double                positive_work = 0; ///< in the present cycle, J
    double                speed_before  = 0; ///< mean of the cycle before, m/s
    std::vector<double>   times, speeds;     ///< of the present cycle
    std::vector<double>   complete; ///< values of the last complete cycle
  };
} // namespace ephyra::diagnostics
