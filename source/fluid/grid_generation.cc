#include "ephyra/fluid/grid_generation.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/parameter_handler.h"

#include <algorithm>
#include <cmath>

namespace ephyra::fluid
{
  namespace
  {
    /// Spacing at the relative position s of a segment between h0 and h1.
    double
    spacing(const double     s,
            const double     h0,
            const double     h1,
            const Stretching kind)
    {
      const double weight =
        kind == Stretching::geometric ? s : s * s * (3 - 2 * s);
      return h0 + (h1 - h0) * weight;
    }

    /// Appends the faces of the segment (x0, x1] to @p faces.
    void
    append_segment(std::vector<double> &faces,
                   const double         x0,
                   const double         x1,
                   const double         h0,
                   const double         h1,
                   const Stretching     kind)
    {
      const double length = x1 - x0;
      if (h0 == h1)
        {
          const int n = std::max(1, static_cast<int>(std::lround(length / h0)));
          for (int i = 1; i < n; ++i)
            faces.push_back(x0 + length * i / n);
          faces.push_back(x1);
          return;
        }
      // xi(s) = int_0^s length / h, tabulated with Simpson's rule.
      constexpr int       n_table = 4000;
      std::vector<double> xi(n_table + 1, 0.);
      const auto          density = [&](const double s) {
        return length / spacing(s, h0, h1, kind);
      };
      for (int k = 0; k < n_table; ++k)
        {
          const double s = static_cast<double>(k) / n_table;
          const double d = 1. / n_table;
          xi[k + 1] =
            xi[k] +
            d / 6 * (density(s) + 4 * density(s + d / 2) + density(s + d));
        }
      const int n = std::max(1, static_cast<int>(std::lround(xi.back())));
      for (int i = 1; i < n; ++i)
        {
          const double target = xi.back() * i / n;
          const int    k      = static_cast<int>(
            std::upper_bound(xi.begin(), xi.end(), target) - xi.begin());
          double s =
            (k - 1 + (target - xi[k - 1]) / (xi[k] - xi[k - 1])) / n_table;
          // One Newton step makes the linear interpolation exact to round-off.
          const double s0 = static_cast<double>(k - 1) / n_table;
          const double ds = s - s0;
          const double at =
            xi[k - 1] +
            ds / 6 * (density(s0) + 4 * density(s0 + ds / 2) + density(s));
          s -= (at - target) / density(s);
          faces.push_back(x0 + length * s);
        }
      faces.push_back(x1);
    }
  } // namespace

  GridLine
  GridDirection::generate(const std::string &name) const
  {
    const std::size_t n = breakpoints.size();
    EphyraThrowIf(n < 2,
                  InputError,
                  "The " << name << " breakpoints of the flow grid are " << n
                         << ", give at least the two ends of the domain.");
    EphyraThrowIf(spacings.size() != 1 && spacings.size() != n,
                  InputError,
                  "The flow grid has " << n << ' ' << name
                                       << " breakpoints but " << spacings.size()
                                       << " spacings: give one spacing or one "
                                          "for each breakpoint.");
    for (const double h : spacings)
      EphyraThrowIf(!(h > 0),
                    InputError,
                    "The " << name << " spacing " << h
                           << " m of the flow grid must be positive.");
    for (std::size_t k = 1; k < n; ++k)
      EphyraThrowIf(!(breakpoints[k] > breakpoints[k - 1]),
                    InputError,
                    "The " << name << " breakpoints of the flow grid must "
                           << "increase, but " << breakpoints[k - 1]
                           << " m is followed by " << breakpoints[k] << " m.");

    std::vector<double> faces{breakpoints.front()};
    for (std::size_t k = 1; k < n; ++k)
      append_segment(faces,
                     breakpoints[k - 1],
                     breakpoints[k],
                     spacings.size() == 1 ? spacings[0] : spacings[k - 1],
                     spacings.size() == 1 ? spacings[0] : spacings[k],
                     stretching);
    return GridLine(std::move(faces));
  }

  void
  GridParameters::declare(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Grid");
    const patterns::List            lengths(patterns::Double("m"), 2);
    const patterns::List            widths(patterns::Positive("m"), 1);
    prm.declare_entry("Length unit",
                      "1 m",
                      patterns::Positive("m"),
                      "What the breakpoints and spacings are multiples of, "
                      "such as the radius of the bell; with another one than "
                      "1 m they are plain numbers.");
    prm.declare_entry(
      "Radial breakpoints",
      "0, 1",
      lengths,
      "Radii at which a spacing is given, from the axis 0 to the "
      "outer boundary; each becomes a face of the grid.");
    prm.declare_entry("Radial spacings",
                      "0.03125",
                      widths,
                      "Width of the cells at the breakpoints (or one value for "
                      "all); in between it changes as the stretching says.");
    prm.declare_entry("Axial breakpoints",
                      "0, 1",
                      lengths,
                      "Heights at which a spacing is given, from the lower to "
                      "the upper boundary.");
    prm.declare_entry("Axial spacings",
                      "0.03125",
                      widths,
                      "Width of the cells at the axial breakpoints. A uniform "
                      "axial spacing, or a long uniform block, makes the flow "
                      "faster.");
    prm.declare_entry("Stretching",
                      "geometric",
                      patterns::Selection("geometric|smooth"),
                      "How the spacing h changes between breakpoints: linearly "
                      "(every cell wider by one factor), or by a cubic step "
                      "with no kink of h at the breakpoints.");
    prm.declare_entry("Largest stretching ratio",
                      "1.2",
                      patterns::Double("", 1.),
                      "Grids with a larger ratio of neighbouring cells are "
                      "refused.");
  }

  void
  GridParameters::parse(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Grid");
    const double                    unit = prm.get_double("Length unit");
    const auto lengths = [&prm, unit](const std::string &entry) {
      std::vector<double> values = prm.get_double_list(entry);
      const std::string   text   = prm.get(entry);
      if (unit != 1 && text.find('m') != std::string::npos)
        prm.add_error(entry,
                      "with a Length unit these are plain numbers, multiples "
                      "of it.");
      for (double &value : values)
        value *= unit;
      return values;
    };
    r.breakpoints = lengths("Radial breakpoints");
    r.spacings    = lengths("Radial spacings");
    y.breakpoints = lengths("Axial breakpoints");
    y.spacings    = lengths("Axial spacings");
    r.stretching = y.stretching = prm.get("Stretching") == "smooth"
                                    ? Stretching::smooth
                                    : Stretching::geometric;
    largest_ratio               = prm.get_double("Largest stretching ratio");
  }

  StaggeredGrid
  GridParameters::make_grid(const bool periodic_y, const MPI_Comm comm) const
  {
    GridLine r_line = r.generate("radial");
    GridLine y_line = y.generate("axial");
    for (const GridLine *line : {&r_line, &y_line})
      EphyraThrowIf(line->largest_ratio() > largest_ratio,
                    InputError,
                    "Neighbouring cells of the "
                      << (line == &r_line ? "radial" : "axial")
                      << " grid differ by a factor of " << line->largest_ratio()
                      << ", more than the largest stretching ratio "
                      << largest_ratio
                      << ": move the breakpoints apart or bring their spacings "
                         "closer together.");
    return StaggeredGrid(
      std::move(r_line), std::move(y_line), periodic_y, comm);
  }
} // namespace ephyra::fluid
