#include "ephyra/simulation/body_checks.h"

#include "ephyra/base/exceptions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace ephyra::simulation
{
  using elasticity::Constraints;
  using elasticity::SideCondition;
  using elasticity::Tie;
  using splines::Side;

  namespace
  {
    using Sides = std::array<SideCondition, 4>;

    std::string
    section(const Side side)
    {
      return "Elasticity/Side " + elasticity::name(side) + "/";
    }

    /// Times of the run at which formulas are looked at.
    std::vector<double>
    sample_times(const Scene &scene)
    {
      constexpr int       n = 50;
      std::vector<double> times;
      for (int k = 0; k <= n; ++k)
        times.push_back(scene.time.end_time * k / n);
      return times;
    }

    /// Adds what @p action throws to the errors; true where it threw nothing.
    template <typename Action>
    bool
    passes(ParameterHandler  &prm,
           const std::string &entry,
           const Action      &action)
    {
      try
        {
          action();
        }
      catch (const InputError &error)
        {
          prm.add_error(entry, error.what());
          return false;
        }
      return true;
    }

    /// The entry of a side that has most to do with its displacements.
    std::string
    displacement_entry(const SideCondition &condition, const Side side)
    {
      for (int i = 0; i < 2; ++i)
        if (condition.fixed[i] && !condition.displacement[i].is_zero())
          return section(side) + (i == 0 ? "Radial" : "Axial") +
                 " displacement";
      return section(side) + "Fixed components";
    }

    bool
    on_axis(const splines::NurbsPatch<2> &patch, const Side side)
    {
      for (const int k : patch.side_control_points(side))
        if (patch.control_points()[k].r > 0.)
          return false;
      return true;
    }

    /// Prescribed displacements: each side by itself, then beside each
    /// neighbour.
    void
    check_displacements(const Sides                  &sides,
                        const splines::NurbsPatch<2> &patch,
                        const std::vector<double>    &times,
                        ParameterHandler             &prm)
    {
      const auto try_sides = [&](const std::vector<Side> &which) {
        Sides some;
        for (const Side side : which)
          some[static_cast<int>(side)] = sides[static_cast<int>(side)];
        const Side last = which.back();
        return passes(
          prm, displacement_entry(sides[static_cast<int>(last)], last), [&]() {
            Constraints constraints(patch, some, Tie::none);
            for (const double t : times)
              constraints.set_time(t, 1.);
          });
      };
      std::array<bool, 4> good{};
      for (const Side side : elasticity::all_sides)
        good[static_cast<int>(side)] = try_sides({side});
      for (const Side along : {Side::theta2_0, Side::theta2_1})
        for (const Side end : {Side::theta1_0, Side::theta1_1})
          if (good[static_cast<int>(end)] && good[static_cast<int>(along)])
            try_sides({end, along});
    }

    void
    check_tie(const Sides                  &sides,
              const Tie                     tie,
              const splines::NurbsPatch<2> &patch,
              ParameterHandler             &prm)
    {
      if (tie == Tie::none)
        return;
      const bool first = tie == Tie::theta1;
      passes(prm, "Elasticity/Tied sides", [&]() {
        const Constraints constraints(patch, Sides(), tie);
      });
      for (const Side side : {first ? Side::theta1_0 : Side::theta2_0,
                              first ? Side::theta1_1 : Side::theta2_1})
        {
          const SideCondition &condition = sides[static_cast<int>(side)];
          if (condition.fixed[0] || condition.fixed[1])
            prm.add_error(section(side) + "Fixed components",
                          "side " + elasticity::name(side) +
                            " is tied to the opposite one and fixed as well; "
                            "choose one of the two.");
          if (condition.loaded())
            prm.add_error(section(side) + (condition.pressure.is_zero()
                                             ? "Radial traction"
                                             : "Pressure"),
                          "side " + elasticity::name(side) +
                            " is tied to the opposite one, so that it is no "
                            "surface that a load could act on; remove the load "
                            "or the tie.");
        }
    }

    /// Formulas of the loads have values, and an area to act on.
    void
    check_loads(const elasticity::ElasticityParameters &body,
                const splines::NurbsPatch<2>           &patch,
                const std::vector<double>              &times,
                ParameterHandler                       &prm)
    {
      for (const Side side : elasticity::all_sides)
        {
          const SideCondition &all = body.sides[static_cast<int>(side)];
          if (all.loaded() && on_axis(patch, side))
            prm.add_error(section(side) + (all.pressure.is_zero()
                                             ? "Axial traction"
                                             : "Pressure"),
                          "side " + elasticity::name(side) +
                            " lies on the axis and has no area; load another "
                            "side.");
          const auto try_one = [&](const std::string &entry,
                                   const Expression  &formula) {
            if (formula.is_zero())
              return;
            SideCondition one;
            one.pressure = formula;
            passes(prm, section(side) + entry, [&]() {
              elasticity::SideLoad load(
                patch, side, one, 1., patch.degree(0) + 1, true);
              for (const double t : times)
                load.set_time(t, 1.);
            });
          };
          try_one("Pressure", all.pressure);
          try_one("Radial traction", all.traction[0]);
          try_one("Axial traction", all.traction[1]);
        }
      const char *const axes[] = {"Radial", "Axial"};
      for (int i = 0; i < 2; ++i)
        if (!body.body_force[i].is_zero())
          passes(
            prm, "Elasticity/" + std::string(axes[i]) + " body force", [&]() {
              for (const double t : times)
                for (const double theta1 : {0.01, 0.5, 0.99})
                  for (const double theta2 : {0.01, 0.5, 0.99})
                    {
                      const splines::Point x = patch.point({{theta1, theta2}});
                      body.body_force[i]({x.r, x.y, t});
                    }
            });
    }

    /// Mean length of the patch along each direction, m.
    std::array<double, 2>
    extents(const splines::NurbsPatch<2> &patch)
    {
      constexpr int         n = 20;
      std::array<double, 2> result{};
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          {
            const auto g = patch.tangents({{(i + .5) / n, (j + .5) / n}});
            for (int d = 0; d < 2; ++d)
              result[d] += std::hypot(g[d].r, g[d].y) / (n * n);
          }
      return result;
    }

    void
    warn_of_locking(Scene &scene, const splines::NurbsPatch<2> &patch)
    {
      const auto  &material = scene.mechanics.body.material;
      const double ratio    = material.K / material.c10;
      // The shorter direction, unless its faces are held so that nothing bends.
      const auto  length = extents(patch);
      const auto &sides  = scene.mechanics.body.sides;
      const auto  held   = [&sides](const int side) {
        return sides[side].fixed[0] || sides[side].fixed[1];
      };
      int across = length[0] < length[1] ? 0 : 1;
      if (held(2 * across) && held(2 * across + 1))
        across = 1 - across;
      const int    n      = patch.knot_vector(across).n_elements();
      const int    degree = std::min(patch.degree(0), patch.degree(1));
      const double limit  = locking_limit(degree, n);
      if (ratio <= limit)
        return;
      std::ostringstream text;
      text << "Elements of degree " << degree << ", " << n
           << " of them across the body, lock where it bends: K/c10 = " << ratio
           << " is beyond " << limit << ", where the error is about 1 %; raise "
           << "Body/Degree or refine across.";
      scene.warnings.push_back(text.str());
    }
  } // namespace

  double
  locking_limit(const int degree, const int n)
  {
    switch (degree)
      {
      case 1:
        return 0.1 * std::pow(n, 2);
      case 2:
        return 30. * std::pow(n, 3);
      case 3:
        return 1000. * std::pow(n, 6);
      default:
        return std::numeric_limits<double>::infinity();
      }
  }

  void
  check_elasticity(Scene                        &scene,
                   const splines::NurbsPatch<2> &patch,
                   ParameterHandler             &prm)
  {
    const elasticity::ElasticityParameters &body  = scene.mechanics.body;
    const std::vector<double>               times = sample_times(scene);

    check_tie(body.sides, body.tie, patch, prm);
    check_displacements(body.sides, patch, times, prm);
    check_loads(body, patch, times, prm);
    if (scene.statics &&
        std::none_of(body.sides.begin(),
                     body.sides.end(),
                     [](const SideCondition &side) { return side.fixed[1]; }))
      prm.add_error("Scene/Mechanics",
                    "nothing holds the body along the axis, so that it has no "
                    "equilibrium; fix the component y on a side.");

    // What is left, by building it without its sides: degree, muscle.
    elasticity::ElasticityParameters rest = body;
    rest.sides                            = Sides();
    rest.tie                              = Tie::none;
    const auto &muscle                    = body.active_strain;
    const bool  active = muscle.form != elasticity::ActiveStrain::Form::none;
    if (patch.degree(0) > 6 || patch.degree(1) > 6 || active)
      passes(
        prm,
        !active
          ? "Body/Degree"
          : std::string("Elasticity/Active strain/") +
              (muscle.a1 > muscle.a3 ? "Radial" : "Coronal") + " amplitude",
        [&]() {
          const elasticity::ElasticityOperator op(rest, patch, MPI_COMM_SELF);
        });
    warn_of_locking(scene, patch);
  }
} // namespace ephyra::simulation
