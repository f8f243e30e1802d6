#pragma once

#include "ephyra/base/expression.h"
#include "ephyra/linear_algebra/direct_solver.h"
#include "ephyra/splines/nurbs_patch.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace ephyra
{
  class ParameterHandler;
}

namespace ephyra::elasticity
{
  inline constexpr std::array<splines::Side, 4> all_sides{
    {splines::Side::theta1_0,
     splines::Side::theta1_1,
     splines::Side::theta2_0,
     splines::Side::theta2_1}};

  /// "theta1_0" and so on, as in parameter files and messages.
  std::string
  name(splines::Side side);

  /// What is prescribed on one side of a patch. Formulas are in the reference
  /// position (r, y), the parameter s along the side, and the time t.
  struct SideCondition
  {
    static const std::vector<std::string> variables; ///< s, r, y, t

    /// Components (0 = r, 1 = y) whose displacement is prescribed, and its
    /// value, m: both: clamp; one: roller.
    std::array<bool, 2>       fixed{{false, false}};
    std::array<Expression, 2> displacement{
      {Expression("0", variables), Expression("0", variables)}};

    /// Pressure, Pa, positive towards the body.
    Expression pressure{"0", variables};
    /// Pressure on the deformed (true) or on the reference surface.
    bool follower = true;
    /// Force on reference area, Pa.
    std::array<Expression, 2> traction{
      {Expression("0", variables), Expression("0", variables)}};

    static void
    declare(ParameterHandler &prm);
    void
    parse(ParameterHandler &prm);
    bool
    loaded() const;
  };

  /// Opposite sides whose displacements are tied to each other (a periodic
  /// body).
  enum class Tie
  {
    none,
    theta1, ///< side theta1_1 follows theta1_0
    theta2  ///< side theta2_1 follows theta2_0
  };

  /// Prescribed displacements, the axis and ties, by elimination: a tied
  /// unknown follows its master, a fixed one has a value, and both have the row
  /// of the identity in the matrix. Unknown 2 * point + component. Points on
  /// the axis keep u_r = 0.
  class Constraints
  {
  public:
    /// Throws InputError where a tie is impossible.
    Constraints(const splines::NurbsPatch<2>       &patch,
                const std::array<SideCondition, 4> &sides,
                Tie                                 tie);

    int
    n_unknowns() const
    {
      return static_cast<int>(target.size());
    }
    /// Unknown that an unknown stands for in the equations: itself, its
    /// master, or -1 where it is fixed.
    int
    equation(const int unknown) const
    {
      return target[unknown];
    }
    /// Whether the axial translation of the whole body is prevented.
    bool
    holds_axial_position() const;

    /// Whether a prescribed displacement differs from zero.
    bool
    moves() const
    {
      return moving;
    }
    /// A vector of forces with zeros where the unknown is not fixed.
    std::vector<double>
    fixed_part(const std::vector<double> &force) const;

    /// Values of the fixed unknowns (m) at time t, times @p factor, by
    /// interpolation at the Greville points of each side. Throws InputError
    /// where two sides contradict each other at a common point.
    void
    set_time(double t, double factor);
    /// Writes values of fixed unknowns and copies masters to what follows them.
    void
    apply(std::vector<double> &displacement) const;
    /// The same for a change of the displacement at fixed loads: zero where
    /// fixed.
    void
    complete(std::vector<double> &correction) const;
    /// Adds entries of tied unknowns to their masters; zero for fixed ones.
    void
    condense(std::vector<double> &force) const;

  private:
    struct FixedSide
    {
      splines::Side    side;
      std::vector<int> points; ///< control points
      /// s and reference position at the Greville points of the side.
      std::vector<double>                           parameter;
      std::vector<splines::Point>                   position;
      std::unique_ptr<linear_algebra::DirectSolver> interpolation;
    };

    std::array<SideCondition, 4> sides;
    std::vector<FixedSide>       fixed_sides;
    std::vector<int>             target;
    std::vector<int>             master;  ///< of tied unknowns, else itself
    std::vector<double>          value;   ///< of fixed unknowns
    std::vector<bool>            on_axis; ///< control points
    double                       size;    ///< of the patch, m
    bool                         moving = false;
  };
} // namespace ephyra::elasticity
