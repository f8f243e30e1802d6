#pragma once

#include "ephyra/fluid/poisson_solver.h"
#include "ephyra/fluid/row_transforms.h"
#include "ephyra/fluid/row_tridiagonal.h"

namespace ephyra::fluid
{
  /// Real transforms along y, which has to be uniform (cosines, sines, their
  /// odd-frequency forms for mixed sides, Fourier where periodic), and a
  /// tridiagonal system in r for each mode.
  class PoissonFft : public PoissonSolver
  {
  public:
    PoissonFft(const StaggeredGrid &grid, const PoissonSides &sides);

    void
    solve(DistributedArray    &phi,
          const RightHandSide &right_hand_side,
          const RowFunction   &visit) override;
    using PoissonSolver::solve;

    std::string
    name() const override
    {
      return "fft";
    }

  private:
    const StaggeredGrid &grid;
    RowTransforms        transforms;
    RowTridiagonal       tridiagonal;
    AlignedVector        modes[2];
  };

  /// The rows of the radial part of the Poisson equation, times rc_i dr_i.
  RowTridiagonal::Rows
  radial_poisson_rows(const StaggeredGrid &grid, bool outer_dirichlet);
} // namespace ephyra::fluid
