#include "ephyra/simulation/scene_checks.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/simulation/body_checks.h"
#include "ephyra/simulation/flow_checks.h"
#include "ephyra/simulation/front_checks.h"
#include "ephyra/simulation/tissue_checks.h"
#include "ephyra/simulation/window_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace ephyra::simulation
{
  namespace
  {
    /// Cells between a body and the end of the grid that the forcing needs.
    constexpr double n_cells_to_end = 3;
    /// Cells across a body below which forces from both sides overlap.
    constexpr double n_cells_across = 3;

    struct Grid
    {
      fluid::GridLine r, y;
      bool            periodic_y;

      /// Length of a vector at a place in cells.
      double
      in_cells(const splines::Point &at, const double dr, const double dy) const
      {
        const auto width = [](const fluid::GridLine &line, const double x) {
          return line.width[std::clamp(line.cell_of(x), 0, line.n_cells - 1)];
        };
        return std::hypot(dr / width(r, at.r), dy / width(y, at.y));
      }
    };

    std::optional<Grid>
    make_grid(const Scene &scene, ParameterHandler &prm)
    {
      const fluid::GridParameters    &parameters = scene.fluid.grid;
      const ParameterHandler::Section section(prm, "Fluid");
      const auto                      line =
        [&prm](const fluid::GridDirection &direction,
               const std::string          &name,
               const std::string &entry) -> std::optional<fluid::GridLine> {
        try
          {
            return direction.generate(name);
          }
        catch (const InputError &error)
          {
            prm.add_error("Grid/" + entry, error.what());
            return {};
          }
      };
      const auto r = line(parameters.r, "radial", "Radial breakpoints");
      const auto y = line(parameters.y, "axial", "Axial breakpoints");
      if (!r || !y)
        return {};
      try
        {
          parameters.make_grid(scene.fluid.periodic_y(), MPI_COMM_SELF);
        }
      catch (const InputError &error)
        {
          prm.add_error("Grid/Radial breakpoints", error.what());
          return {};
        }
      return Grid{*r, *y, scene.fluid.periodic_y()};
    }

    /// Adds an error to @p entry where a point is outside of the grid, or too
    /// close to its end.
    void
    check_inside(const Grid                        &grid,
                 const std::vector<splines::Point> &points,
                 const std::string                 &name,
                 const std::string                 &entry,
                 ParameterHandler                  &prm)
    {
      const double limit_r =
        grid.r.face.back() - n_cells_to_end * grid.r.width.back();
      const double lower =
        grid.y.face.front() + n_cells_to_end * grid.y.width.front();
      const double upper =
        grid.y.face.back() - n_cells_to_end * grid.y.width.back();
      for (const splines::Point &p : points)
        if (p.r > limit_r || (!grid.periodic_y && (p.y < lower || p.y > upper)))
          {
            std::ostringstream message;
            message << name << " reaches (r, y) = (" << p.r << ", " << p.y
                    << ") m, but it must stay " << n_cells_to_end
                    << " cells inside of the flow grid [0, "
                    << grid.r.face.back() << "] x [" << grid.y.face.front()
                    << ", " << grid.y.face.back()
                    << "] m: move the body or enlarge the grid.";
            prm.add_error(entry, message.str());
            return;
          }
    }

    std::vector<splines::Point>
    surface_points(const geometry::BodyPatch &body)
    {
      constexpr int               n = 100;
      std::vector<splines::Point> result;
      for (int k = 0; k <= n; ++k)
        {
          const double s = static_cast<double>(k) / n;
          for (const double end : {0., 1.})
            {
              result.push_back(body.patch.point({{s, end}}));
              result.push_back(body.patch.point({{end, s}}));
            }
        }
      return result;
    }

    /// Smallest distance of opposite sides in cells of the grid; twice that
    /// where one of them is the axis.
    double
    thickness_in_cells(const geometry::BodyPatch &body, const Grid &grid)
    {
      constexpr int n        = 100;
      double        smallest = std::numeric_limits<double>::infinity();
      const auto    measure  = [&](const splines::Point &a,
                               const splines::Point &b) {
        constexpr double on_axis = 1e-12;
        const bool       whole   = a.r > on_axis && b.r > on_axis;
        smallest                 = std::min(
          smallest, (whole ? 1. : 2.) * grid.in_cells(a, b.r - a.r, b.y - a.y));
      };
      for (int k = 1; k < n; ++k)
        {
          const double s = static_cast<double>(k) / n;
          measure(body.patch.point({{s, 0.}}), body.patch.point({{s, 1.}}));
          measure(body.patch.point({{0., s}}), body.patch.point({{1., s}}));
        }
      return smallest;
    }

    void
    check_body(Scene &scene, const Grid *const grid, ParameterHandler &prm)
    {
      try
        {
          const geometry::BodyPatch body = geometry::create_body(scene.body);
          check_elasticity(scene, body.patch, prm);
          if (grid == nullptr)
            return;
          check_inside(*grid,
                       surface_points(body),
                       "The " + body.shape,
                       "Body/Axial position",
                       prm);
          const double thickness = thickness_in_cells(body, *grid);
          if (thickness < n_cells_across)
            {
              std::ostringstream warning;
              warning << "The " << body.shape << " is only " << thickness
                      << " cells of the flow grid thick; with less than "
                      << n_cells_across
                      << " its two sides disturb each other: refine the grid.";
              scene.warnings.push_back(warning.str());
            }
        }
      catch (const InputError &error)
        {
          prm.add_error("Body/Shape", error.what());
        }
    }

    void
    check_places(const Scene &scene, const Grid &grid, ParameterHandler &prm)
    {
      for (const auto &parameters : scene.bodies)
        {
          const std::string section = "Rigid body " + parameters.name;
          try
            {
              const immersed_boundary::RigidBody body(parameters);
              std::vector<splines::Point> points = body.outline.control_points;
              for (splines::Point &p : points)
                p.y += parameters.position;
              check_inside(grid,
                           points,
                           "The body '" + parameters.name + "'",
                           section + "/Position",
                           prm);
            }
          catch (const InputError &error)
            {
              prm.add_error(section + "/Shape", error.what());
            }
        }
    }

    void
    check_coupling(const Scene &scene, ParameterHandler &prm)
    {
      using Kind                = coupling::CouplingParameters::SchemeKind;
      const double body_density = scene.mechanics.body.density;
      if (scene.coupling.scheme == Kind::forcing_as_load &&
          body_density < scene.fluid.density)
        {
          std::ostringstream message;
          message << "it needs a body at least as dense as the fluid, but the "
                     "body has "
                  << body_density << " kg/m^3 and the fluid "
                  << scene.fluid.density << "; set Scheme = added mass.";
          prm.add_error("Coupling/Scheme", message.str());
        }
      if (scene.coupling.scheme == Kind::forcing_as_load &&
          scene.fluid.scheme != fluid::TimeScheme::ab2)
        prm.add_error("Fluid/Time scheme",
                      "Coupling/Scheme = forcing as load needs one projection "
                      "a step; set Time scheme = ab2, or Scheme = added mass.");
      if (scene.coupling.scheme == Kind::added_mass &&
          scene.coupling.added_mass == coupling::AddedMassKind::forcing &&
          scene.fluid.scheme != fluid::TimeScheme::ab2)
        prm.add_error("Fluid/Time scheme",
                      "Coupling/Added mass = forcing needs one projection a "
                      "step; set Time scheme = ab2.");
      if (scene.coupling.scheme != Kind::sequential &&
          scene.fluid.scheme != fluid::TimeScheme::ab2 &&
          (scene.immersed_boundary.load == immersed_boundary::Load::forcing ||
           scene.immersed_boundary.no_slip_iterations > 0))
        prm.add_error("Fluid/Time scheme",
                      "Immersed boundary/Load = forcing and No-slip iterations "
                      "of a deformable body need one projection a step; set "
                      "Time scheme = ab2.");
    }

    /// What is recorded in the flow and in the body goes into different files.
    void
    check_names_of_samples(const Scene &scene, ParameterHandler &prm)
    {
      const auto check = [&prm](const auto        &of_body,
                                const auto        &of_flow,
                                const std::string &kind,
                                const std::string &entry) {
        for (const auto &a : of_body)
          for (const auto &b : of_flow)
            if (a.name == b.name)
              prm.add_error("Body " + kind + " " + a.name + "/" + entry,
                            "the section Flow " + kind + " " + a.name +
                              " writes files of the same names; choose another "
                              "name for one of them.");
      };
      check(
        scene.body_sampling.lines, scene.flow_sampling.lines, "line", "End");
      check(scene.body_sampling.probes,
            scene.flow_sampling.probes,
            "probe",
            "Point");
    }

    /// Sections that are set, but of which nothing is used.
    void
    warn_of_unused_sections(Scene &scene, const ParameterHandler &prm)
    {
      const auto warn =
        [&](const bool used, const std::string &name, const std::string &why) {
          if (!used && prm.any_is_set(name))
            scene.warnings.push_back("The section \"" + name +
                                     "\" has no effect: " + why + ".");
        };
      const std::string no_elasticity = "elasticity is not in Scene/Physics";
      const std::string no_flow       = "flow is not in Scene/Physics";
      warn(scene.elasticity, "Body", no_elasticity);
      warn(scene.elasticity, "Elasticity", no_elasticity);
      warn(scene.electrophysiology && !scene.elasticity,
           "Tissue",
           "it is for electrophysiology without a body");
      if (!scene.electrophysiology || scene.elasticity)
        for (const char *kind : {"Tissue probe", "Tissue line"})
          for (const std::string &name : prm.instances(kind))
            warn(false,
                 std::string(kind) + " " + name,
                 "it is for electrophysiology without a body");
      warn(scene.electrophysiology,
           "Electrophysiology",
           "electrophysiology is not in Scene/Physics");
      warn(scene.muscle == Scene::Muscle::prescribed,
           "Prescribed activation",
           "Scene/Muscle is not prescribed");
      warn(scene.flow, "Fluid", no_flow);
      warn(scene.flow && (scene.elasticity || scene.rigid_bodies),
           "Immersed boundary",
           "there is no body in a flow");
      warn(scene.flow && scene.elasticity,
           "Coupling",
           "there is no deformable body in a flow");
      if (!scene.rigid_bodies)
        for (const std::string &name : prm.instances("Rigid body"))
          warn(false,
               "Rigid body " + name,
               "rigid bodies are not in Scene/Physics");
    }
  } // namespace

  void
  check_scene(Scene &scene, ParameterHandler &prm)
  {
    if (scene.rigid_bodies && scene.bodies.empty())
      prm.add_error("Scene/Physics",
                    "there is no section \"Rigid body NAME\"; add one for each "
                    "body.");
    std::optional<Grid> grid;
    if (scene.flow)
      grid = make_grid(scene, prm);
    if (scene.electrophysiology && !scene.elasticity)
      check_tissue(scene, prm);
    if (scene.elasticity)
      check_body(scene, grid ? &*grid : nullptr, prm);
    if (grid)
      check_flow(scene, grid->r, grid->y, prm);
    if (scene.rigid_bodies && grid)
      {
        check_places(scene, *grid, prm);
        check_rigid_bodies(scene, grid->r, grid->y, prm);
      }
    if (scene.elasticity && scene.flow)
      check_coupling(scene, prm);
    if (scene.flow)
      check_window(scene, grid ? &grid->y : nullptr, prm);
    if (scene.electrophysiology)
      check_front(scene);
    check_names_of_samples(scene, prm);
    warn_of_unused_sections(scene, prm);
  }
} // namespace ephyra::simulation
