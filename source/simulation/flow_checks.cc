#include "ephyra/simulation/flow_checks.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/expression.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace ephyra::simulation
{
  namespace
  {
    /// Times at which formulas are looked at before the run.
    constexpr int n_times = 64;
    /// CFL number beyond which the Runge-Kutta scheme is unstable.
    constexpr double stable_cfl = 1.73;

    struct NamedSide
    {
      const char                  *name;
      const fluid::SideParameters *parameters;
      bool                         along_r;
    };

    std::array<NamedSide, 3>
    sides(const fluid::FlowParameters &p)
    {
      return {{{"Lower boundary", &p.lower, true},
               {"Upper boundary", &p.upper, true},
               {"Outer boundary", &p.outer, false}}};
    }

    /// Velocities given through all sides: the same sums over faces as in the
    /// solver.
    void
    check_balance(const Scene           &scene,
                  const fluid::GridLine &r,
                  const fluid::GridLine &y,
                  ParameterHandler      &prm)
    {
      using fluid::SideKind;
      std::vector<Expression> normal;
      bool                    flows = false;
      for (const NamedSide &side : sides(scene.fluid))
        {
          const SideKind kind = side.parameters->kind;
          if (kind == SideKind::pressure || kind == SideKind::outflow)
            return;
          const bool given = kind == SideKind::velocity;
          normal.emplace_back(!given         ? std::string("0")
                              : side.along_r ? side.parameters->axial_velocity
                                             : side.parameters->radial_velocity,
                              std::vector<std::string>{"s", "t"});
          flows = flows || !normal.back().is_zero();
        }
      for (int k = 0; flows && k <= n_times; ++k)
        {
          const double t   = scene.time.end_time * k / n_times;
          double       net = 0, size = 0;
          const auto   add = [&](const double flux) {
            net += flux;
            size += std::abs(flux);
          };
          for (int i = 0; i < r.n_cells; ++i)
            {
              const double area = 2 * M_PI * r.centre[i] * r.width[i];
              add(area * normal[0]({r.centre[i], t}));
              add(-area * normal[1]({r.centre[i], t}));
            }
          for (int j = 0; j < y.n_cells; ++j)
            add(-2 * M_PI * r.face.back() * y.width[j] *
                normal[2]({y.centre[j], t}));
          if (std::abs(net) <= 1e-8 * size)
            continue;
          std::ostringstream text;
          text << "the velocities given on the sides of the flow domain let "
               << std::abs(net) << " m^3/s more "
               << (net > 0 ? "in than out" : "out than in") << " at t = " << t
               << " s, and an incompressible flow cannot store it: make one "
                  "side \"outflow\" or \"pressure\", or balance the formulas.";
          prm.add_error("Upper boundary/Type", text.str());
          return;
        }
    }

    void
    check_sides(const Scene           &scene,
                const fluid::GridLine &y,
                ParameterHandler      &prm)
    {
      if (scene.fluid.periodic_y() && !y.uniform)
        prm.add_error("Grid/Axial spacings",
                      "a periodic flow needs a uniform axial spacing: give one "
                      "value.");
      for (const NamedSide &side : sides(scene.fluid))
        if (scene.fluid.viscosity == 0 &&
            side.parameters->kind == fluid::SideKind::no_slip)
          prm.add_error(std::string(side.name) + "/Type",
                        "a flow without viscosity cannot stick to a wall: set "
                        "it to free-slip, or give a viscosity.");
    }

    void
    check_steps(Scene                 &scene,
                const fluid::GridLine &r,
                const fluid::GridLine &y,
                ParameterHandler      &prm)
    {
      const fluid::FlowParameters &p = scene.fluid;
      if (scene.time.adaptive)
        return;
      const double dt    = scene.time.time_step;
      const double limit = p.explicit_time_step_limit(r, y);
      if (p.viscous == fluid::ViscousTreatment::explicit_ &&
          dt > limit * (1. + 1e-9))
        {
          std::ostringstream text;
          text << "the time step " << dt
               << " s exceeds the limit of explicit viscosity, " << limit
               << " s: choose a smaller step or set Viscous terms = automatic.";
          prm.add_error("Viscous terms", text.str());
        }
      // Speeds that are given: those of the sides that let fluid through.
      double rate = 0;
      for (const NamedSide &side : sides(p))
        if (side.parameters->kind == fluid::SideKind::velocity)
          {
            const Expression v(side.along_r ? side.parameters->axial_velocity
                                            : side.parameters->radial_velocity,
                               {"s", "t"});
            const fluid::GridLine &along  = side.along_r ? r : y;
            const fluid::GridLine &across = side.along_r ? y : r;
            const double           width  = side.parameters == &p.lower
                                              ? across.width.front()
                                              : across.width.back();
            for (int k = 0; !v.is_zero() && k <= n_times; ++k)
              for (const double s : along.centre)
                rate = std::max(
                  rate,
                  std::abs(v({s, scene.time.end_time * k / n_times})) / width);
          }
      if (p.convection && rate * dt > stable_cfl)
        {
          std::ostringstream text;
          text << "The velocities given on the sides cross " << rate * dt
               << " cells in a time step, and no more than " << stable_cfl
               << " is stable: reduce Time/Time step to " << stable_cfl / rate
               << " s, or set Time/Time step control = adaptive.";
          scene.warnings.push_back(text.str());
        }
    }

    // --- rigid bodies -------------------------------------------------------

    /// A body in the meridional plane: sampled curves.
    struct Shape
    {
      std::string                              name;
      std::vector<std::vector<splines::Point>> curves;

      bool
      holds(const splines::Point &p) const
      {
        bool inside = false; // crossings of the ray away from the axis
        for (const auto &curve : curves)
          for (std::size_t k = 1; k < curve.size(); ++k)
            {
              const splines::Point &a = curve[k - 1], &b = curve[k];
              if ((a.y > p.y) != (b.y > p.y) &&
                  p.r < a.r + (p.y - a.y) / (b.y - a.y) * (b.r - a.r))
                inside = !inside;
            }
        return inside;
      }
    };

    Shape
    sample(const immersed_boundary::RigidBody &body)
    {
      constexpr int n = 400;
      Shape         shape{body.parameters.name, {}};
      for (const auto &curve : body.outline.curves)
        {
          const auto  &breaks = curve.curve.knot_vector(0).breaks();
          const double length = breaks.back() - breaks.front();
          shape.curves.emplace_back();
          for (int k = 0; k <= n; ++k)
            {
              splines::Point p =
                curve.curve.point({{breaks.front() + length * k / n}});
              p.y += body.parameters.position;
              shape.curves.back().push_back(p);
            }
        }
      return shape;
    }

    /// Extent of a shape in cells, the smaller one of both directions; twice
    /// the radius where it reaches the axis.
    double
    size_in_cells(const Shape           &shape,
                  const fluid::GridLine &r,
                  const fluid::GridLine &y)
    {
      double r0 = r.length(), r1 = 0, y0 = y.face.back(), y1 = y.face.front();
      for (const auto &curve : shape.curves)
        for (const splines::Point &p : curve)
          {
            r0 = std::min(r0, p.r);
            r1 = std::max(r1, p.r);
            y0 = std::min(y0, p.y);
            y1 = std::max(y1, p.y);
          }
      const auto width = [](const fluid::GridLine &line, const double x) {
        return line.width[std::clamp(line.cell_of(x), 0, line.n_cells - 1)];
      };
      const bool whole = r0 <= 1e-9 * r1;
      return std::min((whole ? 2 * r1 : r1 - r0) / width(r, r1),
                      (y1 - y0) / width(y, 0.5 * (y0 + y1)));
    }

    void
    check_one(Scene                                          &scene,
              const immersed_boundary::RigidBody::Parameters &body,
              const double                                    cells,
              const double                                    smallest_width,
              ParameterHandler                               &prm)
    {
      using Body                 = immersed_boundary::RigidBody;
      const std::string  section = "Rigid body " + body.name;
      std::ostringstream text;
      if (cells < 1)
        {
          text << "the body is only " << cells
               << " cells of the flow grid thick: refine the grid, at least 3 "
                  "cells are needed and 10 are good.";
          prm.add_error(section + "/Shape", text.str());
        }
      else if (cells < 3)
        {
          text << "The body '" << body.name << "' is only " << cells
               << " cells of the flow grid thick; with less than 3 its two "
                  "sides disturb each other: refine the grid.";
          scene.warnings.push_back(text.str());
        }
      if (body.motion == Body::Motion::free &&
          body.interior == Body::InteriorFluid::rigid &&
          body.density < scene.fluid.density)
        {
          std::ostringstream light;
          light << "it needs a body at least as dense as the fluid, but the "
                   "body has "
                << body.density << " kg/m^3 and the fluid "
                << scene.fluid.density << "; set Interior fluid = automatic.";
          prm.add_error(section + "/Interior fluid", light.str());
        }
      if (body.motion != Body::Motion::prescribed || scene.time.adaptive)
        return;
      const Expression law(body.velocity, {"t"});
      double           speed = 0;
      for (int k = 0; k <= n_times; ++k)
        speed =
          std::max(speed, std::abs(law(scene.time.end_time * k / n_times)));
      const double crossed = speed * scene.time.time_step / smallest_width;
      if (crossed > stable_cfl)
        {
          std::ostringstream fast;
          fast << "The body '" << body.name << "' crosses " << crossed
               << " cells in a time step, and no more than " << stable_cfl
               << " is stable: reduce Time/Time step, or set Time/Time step "
                  "control = adaptive.";
          scene.warnings.push_back(fast.str());
        }
    }
  } // namespace

  void
  check_flow(Scene                 &scene,
             const fluid::GridLine &r,
             const fluid::GridLine &y,
             ParameterHandler      &prm)
  {
    const ParameterHandler::Section section(prm, "Fluid");
    check_sides(scene, y, prm);
    check_balance(scene, r, y, prm);
    check_steps(scene, r, y, prm);
  }

  void
  check_rigid_bodies(Scene                 &scene,
                     const fluid::GridLine &r,
                     const fluid::GridLine &y,
                     ParameterHandler      &prm)
  {
    std::vector<Shape> shapes;
    for (const auto &parameters : scene.bodies)
      try
        {
          shapes.push_back(sample(immersed_boundary::RigidBody(parameters)));
          check_one(scene,
                    parameters,
                    size_in_cells(shapes.back(), r, y),
                    y.smallest_width(),
                    prm);
        }
      catch (const InputError &) // reported where the shape is checked
        {
        }
    const auto overlap = [](const Shape &a, const Shape &b) {
      for (const auto &curve : a.curves)
        for (const splines::Point &p : curve)
          if (b.holds(p))
            return true;
      return false;
    };
    for (std::size_t a = 0; a < shapes.size(); ++a)
      for (std::size_t b = a + 1; b < shapes.size(); ++b)
        if (overlap(shapes[a], shapes[b]) || overlap(shapes[b], shapes[a]))
          prm.add_error("Rigid body " + shapes[b].name + "/Position",
                        "the body overlaps with the body '" + shapes[a].name +
                          "' at the start: move them apart.");
  }
} // namespace ephyra::simulation
