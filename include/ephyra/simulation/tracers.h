#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/base/output.h"
#include "ephyra/base/parameter_handler.h"
#include "ephyra/base/record.h"
#include "ephyra/fluid/flow_parameters.h"
#include "ephyra/fluid/velocity_field.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ephyra::simulation
{
  /// Section "Tracers NAME": where and when points are let go that the flow
  /// carries along.
  struct TracerParameters
  {
    std::string           name;
    std::array<double, 2> start{{0., 0.}}, end{{0., 0.}}; ///< (r, y), m
    std::array<int, 2> numbers{{1, 1}}; ///< on a line: the first; else along r
                                        ///< and along y in a rectangle
    bool   rectangle = false;
    double first     = 0; ///< time at which the first are let go, s
    double interval  = 0; ///< s, to the next ones; 0: once

    static void
    declare(ParameterHandler &prm);
    /// All sections of a file.
    static std::vector<TracerParameters>
    parse_all(ParameterHandler &prm);
  };

  /// Passive tracers, dx/dt = v(x, t). A step goes by Heun's method
  ///   x* = x^n + dt v^n(x^n),
  ///   x^(n+1) = x^n + dt/2 [v^n(x^n) + v^(n+1)(x*)]
  /// (second order) with velocities bilinear between the nodes
  /// (fluid/local_velocity.h). Tracers do not leave through walls or the axis;
  /// those that leave through another end of the domain are dropped. Replicated:
  /// every rank has all of them, the same on any number of ranks.
  class Tracers
  {
  public:
    /// Lets the first ones go if it is time. Throws InputError where a place is
    /// outside of the grid.
    Tracers(const TracerParameters      &parameters,
            const fluid::FlowParameters &flow,
            const fluid::VelocityField  &velocity);

    /// From t to t + dt (s), @p velocity being that of t + dt; collective.
    void
    advance(double t, double dt, const fluid::VelocityField &velocity);

    const std::string &
    name() const
    {
      return parameters.name;
    }
    struct Tracer
    {
      std::array<double, 2> x{{0., 0.}}; ///< (r, y), m
      std::array<double, 2> v{{0., 0.}}; ///< m/s
      double                start  = 0;  ///< when it was let go, s
      double                number = 0;  ///< in the order of letting go
    };
    const std::vector<Tracer> &
    all() const
    {
      return tracers;
    }
    /// "NAME tracers [-]": how many there are.
    void
    evaluate(Record &record) const;
    /// Places, numbers, ages and velocities at @p time (s).
    PointOutput
    output(double time) const;
    void
    serialize(Archive &archive);

  private:
    void
    let_go(double time, const fluid::VelocityField &velocity);
    std::vector<std::array<double, 2>>
    places() const;
    /// Moves a point that has left the domain through a wall, the axis or a
    /// periodic end back; false where it has really left.
    bool
    stay(const fluid::StaggeredGrid &grid, std::array<double, 2> &x) const;

    const TracerParameters parameters;
    const fluid::SideKind  lower, upper, outer;
    std::vector<Tracer>    tracers;
    std::int64_t           n_let_go = 0; ///< tracers so far
    std::int64_t           n_times  = 0; ///< passed times of letting go
  };
} // namespace ephyra::simulation
