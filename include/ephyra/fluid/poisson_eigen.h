#pragma once

#include "ephyra/fluid/poisson_solver.h"
#include "ephyra/fluid/radial_modes.h"
#include "ephyra/fluid/row_tridiagonal.h"
#include "ephyra/fluid/transposition.h"

namespace ephyra::fluid
{
  /// Eigenvectors of the radial operator (Haidvogel & Zang 1979,
  /// 10.1016/0021-9991(79)90097-4) and a tridiagonal system in y for each:
  /// any tensor grid. The eigenvectors are applied by matrix products, 4 n_r
  /// operations a cell. Over several ranks the field is transposed, so that
  /// each holds all r of its share of columns; the tridiagonal systems cross
  /// the ranks through interfaces.
  class PoissonEigen : public PoissonSolver
  {
  public:
    PoissonEigen(const StaggeredGrid &grid, const PoissonSides &sides);

    void
    solve(DistributedArray    &phi,
          const RightHandSide &right_hand_side,
          const RowFunction   &visit) override;
    using PoissonSolver::solve;

    std::string
    name() const override
    {
      return "eigen";
    }

  private:
    const StaggeredGrid           &grid;
    const int                      n_r;
    const mpi::Share               columns; ///< of this rank, transposed
    const RadialModes              radial;
    RowTridiagonal                 tridiagonal;
    AlignedVector                  modes;  ///< [own column][mode]
    AlignedVector                  values; ///< several ranks: [own column][row]
    std::unique_ptr<Transposition> transposition; ///< several ranks
  };
} // namespace ephyra::fluid
