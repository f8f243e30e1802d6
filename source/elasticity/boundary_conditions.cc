#include "ephyra/elasticity/boundary_conditions.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/parameter_handler.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ephyra::elasticity
{
  const std::vector<std::string> SideCondition::variables{"s", "r", "y", "t"};

  std::string
  name(const splines::Side side)
  {
    static const char *const names[] = {
      "theta1_0", "theta1_1", "theta2_0", "theta2_1"};
    return names[static_cast<int>(side)];
  }

  void
  SideCondition::declare(ParameterHandler &prm)
  {
    const std::string where =
      " A formula in the reference position r, y (m), the parameter s along "
      "the side and the time t (s).";
    prm.declare_entry("Fixed components",
                      "none",
                      patterns::Selection("none|r|y|both"),
                      "Components of the displacement that are prescribed: "
                      "both is a clamp, one of them a roller.");
    const char *const axes[] = {"Radial", "Axial"};
    for (const std::string axis : axes)
      {
        prm.declare_entry(axis + " displacement",
                          "0",
                          patterns::Expression(variables, "m"),
                          "Prescribed value where this component is fixed." +
                            where);
        prm.declare_entry(axis + " traction",
                          "0",
                          patterns::Expression(variables, "Pa"),
                          "Force on the area of the reference shape." + where);
      }
    prm.declare_entry("Pressure",
                      "0",
                      patterns::Expression(variables, "Pa"),
                      "Pressure, positive towards the body." + where);
    prm.declare_entry("Pressure acts on",
                      "deformed surface",
                      patterns::Selection("deformed surface|reference surface"),
                      "A follower load, or a dead one.");
  }

  void
  SideCondition::parse(ParameterHandler &prm)
  {
    const std::string components = prm.get("Fixed components");
    fixed                        = {{components == "r" || components == "both",
                                     components == "y" || components == "both"}};
    const char *const axes[]     = {"Radial", "Axial"};
    for (int i = 0; i < 2; ++i)
      {
        const std::string axis = axes[i];
        displacement[i] =
          Expression(prm.get(axis + " displacement"), variables);
        traction[i] = Expression(prm.get(axis + " traction"), variables);
        if (!fixed[i] && prm.is_set(axis + " displacement") &&
            !displacement[i].is_zero())
          prm.add_error(axis + " displacement",
                        "is given, but \"Fixed components\" leaves this "
                        "component free; fix it or remove the entry");
        if (fixed[i] && !traction[i].is_zero())
          prm.add_error(axis + " traction",
                        "has no effect on a component that is fixed; remove "
                        "one of the two");
      }
    pressure = Expression(prm.get("Pressure"), variables);
    follower = prm.get("Pressure acts on") == "deformed surface";
  }

  bool
  SideCondition::loaded() const
  {
    return !pressure.is_zero() || !traction[0].is_zero() ||
           !traction[1].is_zero();
  }

  namespace
  {
    /// Factorised matrix of the basis of a curve at its Greville points.
    std::unique_ptr<linear_algebra::DirectSolver>
    interpolation(const splines::NurbsPatch<1> &curve)
    {
      using linear_algebra::SparseMatrix;
      const std::vector<double> greville = curve.knot_vector(0).greville();
      linear_algebra::SparsityPattern      pattern(curve.n_control_points());
      std::vector<splines::BasisValues<1>> rows(greville.size());
      for (std::size_t k = 0; k < greville.size(); ++k)
        {
          curve.evaluate_basis({greville[k]}, rows[k]);
          pattern.columns[k] = rows[k].index;
        }
      pattern.compress();
      SparseMatrix matrix(pattern, SparseMatrix::Storage::band, MPI_COMM_SELF);
      matrix.begin_assembly();
      for (std::size_t k = 0; k < rows.size(); ++k)
        for (std::size_t a = 0; a < rows[k].index.size(); ++a)
          matrix.add(k, rows[k].index[a], rows[k].value[a]);
      matrix.finish_assembly();
      auto solver = linear_algebra::make_direct_solver(
        matrix.storage(), "interpolation along a side");
      solver->factorize(matrix);
      return solver;
    }
  } // namespace

  Constraints::Constraints(const splines::NurbsPatch<2>       &patch,
                           const std::array<SideCondition, 4> &conditions,
                           const Tie                           tie)
    : sides(conditions)
    , target(2 * patch.n_control_points())
    , master(target.size())
    , value(target.size(), 0.)
    , size(0.)
  {
    for (std::size_t i = 0; i < target.size(); ++i)
      target[i] = master[i] = static_cast<int>(i);
    for (const splines::Point &x : patch.control_points())
      size = std::max({size, std::abs(x.r), std::abs(x.y)});

    if (tie != Tie::none)
      {
        const bool first = tie == Tie::theta1;
        const auto start =
          first ? splines::Side::theta1_0 : splines::Side::theta2_0;
        const auto end =
          first ? splines::Side::theta1_1 : splines::Side::theta2_1;
        for (const splines::Side side : {start, end})
          for (int i = 0; i < 2; ++i)
            EphyraThrowIf(sides[static_cast<int>(side)].fixed[i],
                          InputError,
                          "Side " << name(side)
                                  << " is tied to the opposite one and fixed "
                                     "as well; choose one of the two.");
        const std::vector<int> from = patch.side_control_points(end);
        const std::vector<int> to   = patch.side_control_points(start);
        for (std::size_t k = 0; k < from.size(); ++k)
          {
            const double change = patch.control_points()[from[k]].r -
                                  patch.control_points()[to[k]].r;
            EphyraThrowIf(std::abs(change) > 1e-9 * size ||
                            std::abs(patch.weights()[from[k]] -
                                     patch.weights()[to[k]]) > 1e-9,
                          InputError,
                          "Sides " << name(start) << " and " << name(end)
                                   << " cannot be tied: their control points "
                                   << k << " differ in radius by " << change
                                   << " m or in weight; tie congruent sides.");
            for (int i = 0; i < 2; ++i)
              master[2 * from[k] + i] = target[2 * from[k] + i] = 2 * to[k] + i;
          }
      }

    for (const splines::Side side : all_sides)
      {
        const SideCondition &condition = sides[static_cast<int>(side)];
        if (!condition.fixed[0] && !condition.fixed[1])
          continue;
        const splines::NurbsPatch<1> curve    = patch.side(side);
        const std::vector<double>    greville = curve.knot_vector(0).greville();
        FixedSide                    fixed{
          side, patch.side_control_points(side), greville, {}, {}};
        fixed.interpolation = interpolation(curve);
        for (const double s : greville)
          fixed.position.push_back(curve.point({s}));
        for (int i = 0; i < 2; ++i)
          if (condition.fixed[i])
            {
              moving = moving || !condition.displacement[i].is_zero();
              for (const int point : fixed.points)
                target[2 * point + i] = -1;
            }
        fixed_sides.push_back(std::move(fixed));
      }

    for (int k = 0; k < patch.n_control_points(); ++k)
      {
        on_axis.push_back(std::abs(patch.control_points()[k].r) <=
                          1e-12 * size);
        if (on_axis[k])
          target[2 * k] = -1;
      }
    // What follows a fixed master is fixed with it, and the other way round.
    for (std::size_t i = 0; i < target.size(); ++i)
      if (target[i] == -1)
        target[master[i]] = -1;
    for (std::size_t i = 0; i < target.size(); ++i)
      if (target[master[i]] == -1)
        target[i] = -1;
    set_time(0., 1.);
  }

  bool
  Constraints::holds_axial_position() const
  {
    for (std::size_t i = 1; i < target.size(); i += 2)
      if (target[i] == -1)
        return true;
    return false;
  }

  void
  Constraints::set_time(const double t, const double factor)
  {
    std::vector<const FixedSide *> source(value.size(), nullptr);
    for (const FixedSide &fixed : fixed_sides)
      for (int i = 0; i < 2; ++i)
        {
          const SideCondition &condition = sides[static_cast<int>(fixed.side)];
          const Expression    &formula   = condition.displacement[i];
          if (!condition.fixed[i])
            continue;
          const std::size_t   n = fixed.points.size();
          std::vector<double> values(n, 0.);
          if (!formula.is_zero())
            {
              std::vector<double> at_points(n);
              for (std::size_t k = 0; k < n; ++k)
                at_points[k] = factor * formula({fixed.parameter[k],
                                                 fixed.position[k].r,
                                                 fixed.position[k].y,
                                                 t});
              fixed.interpolation->solve(at_points, values);
            }
          for (std::size_t k = 0; k < n; ++k)
            {
              const int unknown = 2 * fixed.points[k] + i;
              EphyraThrowIf(
                source[unknown] &&
                  std::abs(values[k] - value[unknown]) > 1e-10 * size,
                InputError,
                "Sides " << name(source[unknown]->side) << " and "
                         << name(fixed.side)
                         << " contradict each other in their common corner: "
                         << (i == 0 ? "radial" : "axial") << " displacement "
                         << value[unknown] << " m and " << values[k]
                         << " m at t = " << t
                         << " s; prescribe the same value or free one side.");
              EphyraThrowIf(i == 0 && on_axis[fixed.points[k]] &&
                              std::abs(values[k]) > 1e-10 * size,
                            InputError,
                            "Side " << name(fixed.side)
                                    << " moves a point of the axis radially by "
                                    << values[k] << " m at t = " << t
                                    << " s; points on the axis stay there.");
              value[unknown]  = values[k];
              source[unknown] = &fixed;
            }
        }
  }

  void
  Constraints::apply(std::vector<double> &displacement) const
  {
    for (std::size_t i = 0; i < target.size(); ++i)
      if (target[i] == -1)
        displacement[i] = value[i];
      else if (master[i] != static_cast<int>(i))
        displacement[i] = displacement[master[i]];
  }

  void
  Constraints::condense(std::vector<double> &force) const
  {
    for (std::size_t i = 0; i < target.size(); ++i)
      if (target[i] != static_cast<int>(i))
        {
          if (target[i] >= 0)
            force[target[i]] += force[i];
          force[i] = 0.;
        }
  }

  std::vector<double>
  Constraints::fixed_part(const std::vector<double> &force) const
  {
    std::vector<double> part(force.size(), 0.);
    for (std::size_t i = 0; i < target.size(); ++i)
      if (target[i] == -1)
        part[i] = force[i];
    return part;
  }

  void
  Constraints::complete(std::vector<double> &correction) const
  {
    for (std::size_t i = 0; i < target.size(); ++i)
      if (target[i] == -1)
        correction[i] = 0.;
      else if (master[i] != static_cast<int>(i))
        correction[i] = correction[master[i]];
  }
} // namespace ephyra::elasticity
