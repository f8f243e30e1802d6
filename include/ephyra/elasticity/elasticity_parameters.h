#pragma once

#include "ephyra/elasticity/active_strain.h"
#include "ephyra/elasticity/boundary_conditions.h"
#include "ephyra/elasticity/material.h"

#include <array>
#include <optional>

namespace ephyra::elasticity
{
  /// A body: material, muscle, supports and loads.
  struct ElasticityParameters
  {
    Material                     material;
    double                       density = 1000.; ///< kg/m^3, reference
    ActiveStrain::Parameters     active_strain;
    std::array<SideCondition, 4> sides;
    Tie                          tie = Tie::none;
    /// N per m^3 of the reference shape: formulas in r, y, t.
    std::array<Expression, 2> body_force{
      {Expression("0", {"r", "y", "t"}), Expression("0", {"r", "y", "t"})}};
    /// Gauss points per direction: degree + 1 + this.
    int extra_points = 0;
    /// In the direction theta^2; empty: as many, but two where there is a
    /// muscle, whose layer is thin.
    std::optional<int> extra_points_across;

    /// The two in use.
    std::array<int, 2>
    n_extra_points() const;

    static void
    declare(ParameterHandler &prm);
    void
    parse(ParameterHandler &prm);
  };
} // namespace ephyra::elasticity
