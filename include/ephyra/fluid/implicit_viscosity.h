#pragma once

#include "ephyra/fluid/boundary.h"
#include "ephyra/fluid/column_tridiagonal.h"
#include "ephyra/fluid/momentum.h"
#include "ephyra/fluid/row_tridiagonal.h"

#include <memory>
#include <vector>

namespace ephyra::fluid
{
  /// Crank-Nicolson viscosity by approximate factorisation, eq. (78) and Beam
  /// & Warming 1976 (10.1016/0021-9991(76)90110-8):
  ///   (1 - a L_r) (1 - a L_y) du = right-hand side, a = alpha dt nu / 2,
  /// or one of the factors alone where the other direction is explicit. The
  /// factorisation error is a^2 L_r L_y du = O(dt^3).
  class ImplicitViscosity
  {
  public:
    ImplicitViscosity(const FlowParameters &parameters,
                      const StaggeredGrid  &grid,
                      const Boundary       &boundary,
                      const Momentum       &momentum);

    /// On entry @p field holds the right-hand side (Momentum::update()) on the
    /// faces that follow from the momentum equation and the new velocities on
    /// the sides of the domain; on return u*. @p old: u^k with ghosts. The
    /// boundary must be at the time of u*. @p step: alpha dt, s. Collective.
    void
    solve(double                    step,
          const ImplicitDirections &directions,
          const VelocityField      &old,
          VelocityField            &field);

    /// @p increment becomes what is left of it behind implicit viscosity,
    ///   [(1 - a L_r) (1 - a L_y)]^-1 increment,
    /// with zeros on the sides of the domain. Collective.
    void
    spread_out(double                    step,
               const ImplicitDirections &directions,
               VelocityField            &increment);

    /// Entries of (1 - a L)^-1 of one component (0: radial, 1: axial) along one
    /// direction between the @p nodes of the whole grid, row by row; 0 where a
    /// node is on a side of the domain. Every rank for itself.
    std::vector<double>
    line_response(double                  step,
                  int                     component,
                  bool                    along_r,
                  const std::vector<int> &nodes) const;

  private:
    /// The factorised matrices of one step size.
    struct Factors
    {
      double            step;
      RowTridiagonal    radial_r, axial_r; ///< of v_r and of v_y, along r
      ColumnTridiagonal radial_y, axial_y; ///< along y
    };
    Factors &
    factors(double step);
    /// @p old: null where the values on the sides do not change.
    void
    solve_along_r(Factors &,
                  double               a,
                  const VelocityField *old,
                  VelocityField &);
    void
    solve_along_y(Factors &,
                  double               a,
                  const VelocityField *old,
                  VelocityField &);

    /// Rows [first, end) along r; of v_r without the axis.
    RowTridiagonal::Rows
    radial_rows(double a, int first, int end) const;
    RowTridiagonal::Rows
    axial_rows(double a, int first, int end) const;
    ColumnTridiagonal
    radial_columns(double a) const;
    ColumnTridiagonal
    axial_columns(double a) const;

    const StaggeredGrid                  &grid;
    const Boundary                       &boundary;
    const Momentum                       &momentum;
    const double                          nu;
    std::vector<std::unique_ptr<Factors>> cache;
  };
} // namespace ephyra::fluid
