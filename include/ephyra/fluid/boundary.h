#pragma once

#include "ephyra/base/expression.h"
#include "ephyra/fluid/flow_parameters.h"
#include "ephyra/fluid/poisson_solver.h"
#include "ephyra/fluid/velocity_field.h"

#include <vector>

namespace ephyra::fluid
{
  /// Boundary conditions of the flow. Values on the sides are evaluated from
  /// their formulas at one time (set_time) and used until the next; velocities
  /// normal to a side live on its faces, everything else in ghosts. A ghost
  /// mirrors the first cell at the side: the mean of both is the given value.
  class Boundary
  {
  public:
    Boundary(const FlowParameters &parameters, const StaggeredGrid &grid);

    PoissonSides
    poisson_sides() const;

    /// Faces whose velocities follow from the momentum equation, those of this
    /// rank: rows of v_r and columns of v_y, [first, end).
    int
    first_r_face() const;
    int
    end_r_face() const;
    /// 1 where the radial velocity on the outer side follows from the momentum
    /// equation, else 0.
    int
    opens_outer_side() const
    {
      return sides[outer].kind == SideKind::pressure ? 1 : 0;
    }
    int
    first_y_face() const;
    int
    end_y_face() const;

    /// Evaluates all formulas at time t, s.
    void
    set_time(double t);
    /// The grid has moved: set_time() evaluates steady formulas anew, too.
    void
    forget_values()
    {
      evaluated = false;
    }

    /// Sets the velocities through the sides at the time set last. Convective
    /// outflow is advanced over @p dt from @p previous,
    ///   d v_n/dt + C d v_n/dn = 0,
    /// C the largest velocity towards that side beside it, and corrected
    /// uniformly such that what flows in flows out. Throws InputError where
    /// nothing can balance an inflow. Collective.
    void
    set_normal_velocities(const VelocityField &previous,
                          double               dt,
                          VelocityField       &velocity) const;

    /// Ghosts outside the domain; halo rows must be up to date.
    void
    fill_ghosts(VelocityField &velocity) const;
    void
    fill_pressure_ghosts(DistributedArray &pressure) const;
    /// phi = 0 where the pressure is given, else d phi/dn = 0.
    void
    fill_correction_ghosts(DistributedArray &phi) const;
    /// The same at the ends of one row.
    void
    fill_correction_ghosts(double *row) const;

    enum Side
    {
      lower,
      upper,
      outer
    };
    /// Whether the velocity along a side is given there (else it is free of
    /// stress), and its value: index i of the radial face or j of the axial
    /// face.
    bool
    fixes_tangential(Side side) const;
    double
    tangential(Side side, int index) const;

  private:
    /// A formula in (s, t); a plain zero costs nothing.
    class Formula
    {
    public:
      explicit Formula(const std::string &text);
      double
      operator()(const double s, const double t) const
      {
        return zero ? 0. : expression({s, t});
      }
      const bool zero;

    private:
      Expression expression;
    };
    struct Formulas
    {
      explicit Formulas(const SideParameters &parameters);
      SideKind kind;
      Formula  radial, axial, pressure;
      bool     steady; ///< no formula holds t

      std::vector<double> radial_values, axial_values, pressure_values;
    };

    /// Index of row i in the values of the lower and upper side.
    std::size_t
    slot(const int i) const
    {
      return static_cast<std::size_t>(i - grid.first_row +
                                      DistributedArray::halo);
    }
    void
    fill_scalar_ghosts(DistributedArray &field, bool homogeneous) const;
    void
    advance_outflow(const VelocityField &previous,
                    double               dt,
                    VelocityField       &velocity) const;
    void
    balance_mass(VelocityField &velocity) const;

    const StaggeredGrid &grid;
    Formulas             sides[3];
    bool                 evaluated = false;
    double               now       = 0; ///< of set_time(), s
  };
} // namespace ephyra::fluid
