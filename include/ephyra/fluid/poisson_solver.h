#pragma once

#include "ephyra/fluid/distributed_array.h"

#include <functional>
#include <memory>
#include <string>

namespace ephyra::fluid
{
  /// What the pressure correction satisfies on the sides of the domain:
  /// d phi/dn = 0 or phi = 0 on the faces of the side.
  struct PoissonSides
  {
    bool outer_dirichlet = false;
    bool lower_dirichlet = false;
    bool upper_dirichlet = false;

    /// Whether phi is determined up to a constant only.
    bool
    singular() const
    {
      return !outer_dirichlet && !lower_dirichlet && !upper_dirichlet;
    }
  };

  /// Solves the five-point equations of the staggered grid
  ///   1/(rc_i dr_i) [r_(i+1) (phi_(i+1) - phi_i)/gap_(i+1)
  ///                  - r_i (phi_i - phi_(i-1))/gap_i]
  ///   + 1/dy_j [(phi_(j+1) - phi_j)/gap_(j+1) - (phi_j - phi_(j-1))/gap_j] = f
  /// directly, to round-off. Where phi is determined up to a constant, f must
  /// have zero mean (weights rc dr dy); which constant phi contains then depends
  /// on the solver.
  class PoissonSolver
  {
  public:
    /// Work on the data of the owned row i, n_y values.
    using RowFunction = std::function<void(int i, double *row)>;
    /// Fills the row with @p factor times the right-hand side.
    using RightHandSide =
      std::function<void(int i, double factor, double *row)>;

    virtual ~PoissonSolver() = default;

    /// @p right_hand_side fills the rows of @p phi, in any order;
    /// @p visit sees the rows of the solution, from one end of the rank's rows
    /// to the other, while they are in cache. Collective.
    virtual void
    solve(DistributedArray    &phi,
          const RightHandSide &right_hand_side,
          const RowFunction   &visit) = 0;

    /// On entry f, on return the solution; owned rows.
    void
    solve(DistributedArray &phi)
    {
      const int n = phi.grid().y.n_cells;
      solve(
        phi,
        [n](int, const double factor, double *const row) {
          for (int j = 0; j < n; ++j)
            row[j] *= factor;
        },
        [](int, double *) {});
    }

    virtual std::string
    name() const = 0;
  };

  enum class PoissonKind;

  /// A choice, never automatic, and why: for the log.
  struct PoissonChoice
  {
    PoissonKind kind;
    std::string reason;
  };
  /// The kind itself, or the cheapest that fits the grid: fft where y is
  /// uniform, else hybrid or eigen by their estimated cost.
  PoissonChoice
  choose_poisson_solver(PoissonKind kind, const StaggeredGrid &grid);

  /// Throws InputError where the choice does not fit the grid.
  std::unique_ptr<PoissonSolver>
  make_poisson_solver(PoissonKind          kind,
                      const StaggeredGrid &grid,
                      const PoissonSides  &sides);
} // namespace ephyra::fluid
