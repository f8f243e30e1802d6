#pragma once

#include "ephyra/fluid/poisson_solver.h"
#include "ephyra/fluid/row_tridiagonal.h"

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
    using Columns = mpi::Share; ///< of this rank after the transposition

    /// Fills root_weight and vectors; returns the eigenvalues.
    std::vector<double>
    decompose(bool outer_dirichlet);
    /// Copies owned rows to all rows of own columns, or back.
    void
    transpose(DistributedArray &phi, bool to_columns);

    const StaggeredGrid &grid;
    const int            n_r;
    const Columns        columns;
    std::vector<double>  root_weight; ///< sqrt(rc_i dr_i) of all rows
    AlignedVector        vectors;     ///< of the symmetric form, column-major
    std::vector<double>  eigenvalues; ///< of the negative operator, 1/m^2
    RowTridiagonal       tridiagonal;
    AlignedVector        modes;  ///< [own column][mode]
    AlignedVector        values; ///< several ranks: [own column][row]
    AlignedVector        buffer, send_buffer;
  };
} // namespace ephyra::fluid
