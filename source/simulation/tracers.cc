#include "ephyra/simulation/tracers.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/fluid/local_velocity.h"

#include <algorithm>
#include <cmath>

namespace ephyra::simulation
{
  namespace
  {
    /// Each rank has all of them, and all ranks exchange them twice a step.
    constexpr std::size_t most_tracers = 1000000;

    using Point = std::array<double, 2>;

    void
    declare_tracers(ParameterHandler &prm)
    {
      for (const char *const name : {"Start", "End"})
        prm.declare_entry(name,
                          "0, 0",
                          patterns::List(patterns::Double("m"), 2, 2),
                          std::string(name) +
                            " (r, y) of the line, or a corner of the "
                            "rectangle.");
      prm.declare_entry("Pattern",
                        "line",
                        patterns::Selection("line|rectangle"),
                        "Tracers at equal distances on the line from Start to "
                        "End, both included, or a lattice in the rectangle.");
      prm.declare_entry("Numbers",
                        "1",
                        patterns::List(patterns::Integer(1, 100000), 1, 2),
                        "How many on the line (1: at Start), or along r and "
                        "along y in the rectangle.");
      prm.declare_entry("First time",
                        "0",
                        patterns::Double("s", 0.),
                        "They are let go at the end of the step that reaches "
                        "this time.");
      prm.declare_entry("Interval",
                        "0",
                        patterns::Double("s", 0.),
                        "Time after which more are let go from the same "
                        "places, again and again; 0: once.");
    }

    /// Point k of n between a and b.
    double
    between(const double a, const double b, const int k, const int n)
    {
      return n > 1 ? a + (b - a) * k / (n - 1) : a;
    }

    bool
    is_wall(const fluid::SideKind kind)
    {
      return kind == fluid::SideKind::no_slip ||
             kind == fluid::SideKind::free_slip;
    }

    /// A moving window leaves tracers behind: no wall holds them back there.
    fluid::SideKind
    end_of(const fluid::FlowParameters &flow, const fluid::SideKind kind)
    {
      return flow.window.on() ? fluid::SideKind::outflow : kind;
    }
  } // namespace

  void
  TracerParameters::declare(ParameterHandler &prm)
  {
    prm.declare_repeated_subsection(
      "Tracers",
      declare_tracers,
      "Points that the flow carries along, written to NAME.pvd as often as the "
      "fields.");
  }

  std::vector<TracerParameters>
  TracerParameters::parse_all(ParameterHandler &prm)
  {
    std::vector<TracerParameters> result;
    for (const std::string &name : prm.instances("Tracers"))
      {
        const ParameterHandler::Section section(prm, "Tracers " + name);
        TracerParameters                p;
        p.name           = name;
        const auto start = prm.get_double_list("Start"),
                   end   = prm.get_double_list("End");
        if (start.size() == 2 && end.size() == 2) // else it has been reported
          {
            p.start = {{start[0], start[1]}};
            p.end   = {{end[0], end[1]}};
          }
        p.rectangle = prm.get("Pattern") == "rectangle";
        const std::vector<std::string> numbers = prm.get_list("Numbers");
        if (numbers.size() != (p.rectangle ? 2 : 1))
          prm.add_error(
            "Numbers",
            p.rectangle ? "a rectangle needs two numbers, along r and along y."
                        : "a line needs one number.");
        else
          for (std::size_t k = 0; k < numbers.size(); ++k)
            p.numbers[k] = std::stoi(numbers[k]);
        p.first    = prm.get_double("First time");
        p.interval = prm.get_double("Interval");
        if (name == "flow" || name == "body" || name.rfind("surface_", 0) == 0)
          prm.add_error("Start",
                        "the name '" + name +
                          "' is that of other files of the output; choose "
                          "another one.");
        result.push_back(p);
      }
    return result;
  }

  Tracers::Tracers(const TracerParameters      &parameters,
                   const fluid::FlowParameters &flow,
                   const fluid::VelocityField  &velocity)
    : parameters(parameters)
    , lower(end_of(flow, flow.lower.kind))
    , upper(end_of(flow, flow.upper.kind))
    , outer(flow.outer.kind)
  {
    const fluid::StaggeredGrid &grid = velocity.grid();
    for (const Point &x : places())
      EphyraThrowIf(
        !(x[0] >= 0 && x[0] <= grid.r.face.back() &&
          x[1] >= grid.y.face.front() && x[1] <= grid.y.face.back()),
        InputError,
        "The tracers '" << name() << "' start at (r, y) = (" << x[0] << ", "
                        << x[1]
                        << ") m, which is outside of the grid; move them or "
                           "widen the grid.");
    let_go(0., velocity);
  }

  std::vector<Point>
  Tracers::places() const
  {
    std::vector<Point> result;
    const Point       &a = parameters.start, &b = parameters.end;
    const int          n = parameters.numbers[0], m = parameters.numbers[1];
    if (!parameters.rectangle)
      for (int k = 0; k < n; ++k)
        result.push_back(
          {{between(a[0], b[0], k, n), between(a[1], b[1], k, n)}});
    else
      for (int k = 0; k < n; ++k)
        for (int l = 0; l < m; ++l)
          result.push_back(
            {{between(a[0], b[0], k, n), between(a[1], b[1], l, m)}});
    return result;
  }

  void
  Tracers::let_go(const double time, const fluid::VelocityField &velocity)
  {
    const double round_off = 1e-12 * std::max(1., std::abs(time));
    const auto   due       = [&]() {
      return (n_times == 0 || parameters.interval > 0) &&
             parameters.first + n_times * parameters.interval <=
               time + round_off;
    };
    if (!due())
      return;
    while (due())
      ++n_times;
    const std::vector<Point> x = places();
    const std::vector<Point> v = fluid::local_velocities(velocity, x);
    EphyraThrowIf(tracers.size() + x.size() > most_tracers,
                  InputError,
                  "There would be more than "
                    << most_tracers << " tracers '" << name() << "' at time "
                    << time << " s; let fewer go, or use a longer Interval.");
    for (std::size_t k = 0; k < x.size(); ++k)
      tracers.push_back({x[k], v[k], time, static_cast<double>(n_let_go++)});
  }

  bool
  Tracers::stay(const fluid::StaggeredGrid &grid, Point &x) const
  {
    const auto &[r, y] = x;
    const double r_end = grid.r.face.back(), y_start = grid.y.face.front(),
                 y_end = grid.y.face.back();
    x[0]               = std::abs(r);
    if (r > r_end && is_wall(outer))
      x[0] = r_end;
    if (grid.periodic_y && (y < y_start || y >= y_end))
      x[1] = y - grid.y.length() * std::floor((y - y_start) / grid.y.length());
    if (y < y_start && is_wall(lower))
      x[1] = y_start;
    if (y > y_end && is_wall(upper))
      x[1] = y_end;
    return r <= r_end && y >= y_start && y <= y_end;
  }

  void
  Tracers::advance(const double                t,
                   const double                dt,
                   const fluid::VelocityField &velocity)
  {
    const fluid::StaggeredGrid &grid = velocity.grid();
    std::vector<Point>          predicted;
    for (const Tracer &tracer : tracers)
      {
        predicted.push_back(
          {{tracer.x[0] + dt * tracer.v[0], tracer.x[1] + dt * tracer.v[1]}});
        stay(grid, predicted.back());
      }
    const std::vector<Point> v = fluid::local_velocities(velocity, predicted);
    std::vector<Tracer>      remaining;
    std::vector<Point>       corrected;
    for (std::size_t k = 0; k < tracers.size(); ++k)
      {
        Tracer tracer = tracers[k];
        for (int c = 0; c < 2; ++c)
          tracer.x[c] += 0.5 * dt * (tracer.v[c] + v[k][c]);
        if (!stay(grid, tracer.x))
          continue;
        remaining.push_back(tracer);
        corrected.push_back(tracer.x);
      }
    const std::vector<Point> at_end =
      fluid::local_velocities(velocity, corrected);
    for (std::size_t k = 0; k < remaining.size(); ++k)
      remaining[k].v = at_end[k];
    tracers.swap(remaining);
    let_go(t + dt, velocity);
  }

  void
  Tracers::evaluate(Record &record) const
  {
    record.add(name() + " tracers [-]", static_cast<double>(tracers.size()));
  }

  PointOutput
  Tracers::output(const double time) const
  {
    PointOutput result;
    result.fields = {{"number [-]", {}},
                     {"age [s]", {}},
                     {"radial velocity [m/s]", {}},
                     {"axial velocity [m/s]", {}}};
    for (const Tracer &tracer : tracers)
      {
        result.r.push_back(tracer.x[0]);
        result.y.push_back(tracer.x[1]);
        result.fields[0].values.push_back(tracer.number);
        result.fields[1].values.push_back(time - tracer.start);
        result.fields[2].values.push_back(tracer.v[0]);
        result.fields[3].values.push_back(tracer.v[1]);
      }
    return result;
  }

  void
  Tracers::serialize(Archive &archive)
  {
    const Archive::Group group(archive, "tracers " + name());
    archive.value("let go", n_let_go);
    archive.value("times", n_times);
    std::vector<double> values;
    for (const Tracer &tracer : tracers)
      values.insert(values.end(),
                    {tracer.x[0],
                     tracer.x[1],
                     tracer.v[0],
                     tracer.v[1],
                     tracer.start,
                     tracer.number});
    archive.values("all", values);
    if (!archive.reading())
      return;
    tracers.clear();
    for (std::size_t k = 0; k + 5 < values.size(); k += 6)
      tracers.push_back({{{values[k], values[k + 1]}},
                         {{values[k + 2], values[k + 3]}},
                         values[k + 4],
                         values[k + 5]});
  }
} // namespace ephyra::simulation
