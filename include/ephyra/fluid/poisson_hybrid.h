#pragma once

#include "ephyra/fluid/poisson_solver.h"
#include "ephyra/fluid/row_transforms.h"
#include "ephyra/fluid/row_tridiagonal.h"
#include "ephyra/fluid/stretched_ends.h"

namespace ephyra::fluid
{
  /// The longest run of cells of equal width, to round-off.
  mpi::Share
  longest_uniform_block(const GridLine &line);

  /// Grids in y with a uniform block between stretched ends (either may be
  /// missing). The block is solved as by PoissonFft, with phi given on the
  /// faces between block and ends; the ends as by PoissonEigen. The values on
  /// the two faces follow, for each radial mode, from the fluxes through them:
  /// a system of two equations.
  ///   1. Block with phi = 0 on the faces: fluxes there, to radial modes.
  ///   2. Ends eliminated towards the faces; values on the faces.
  ///   3. Ends substituted; block once more, with the values on the faces.
  class PoissonHybrid : public PoissonSolver
  {
  public:
    /// Throws InputError where the grid is periodic or uniform in y, or has no
    /// uniform block of shortest_block cells.
    PoissonHybrid(const StaggeredGrid &grid, const PoissonSides &sides);

    /// Fewer cells are not worth a block of their own.
    static constexpr int shortest_block = 16;

    void
    solve(DistributedArray    &phi,
          const RightHandSide &right_hand_side,
          const RowFunction   &visit) override;
    using PoissonSolver::solve;

    std::string
    name() const override
    {
      return "hybrid";
    }

  private:
    /// A face between the block and an end; empty where there is none.
    struct Face
    {
      AlignedVector source; ///< modes of 1 in the cell beside it
      AlignedVector weight; ///< of the modes in the value of that cell
    };

    /// Fills the row of step s and its cells of the ends; the block's part.
    double *
    fill_row(DistributedArray    &phi,
             int                  s,
             const RightHandSide &right_hand_side);
    double *
    end_row(int i);
    /// Gradients beside the faces with phi = 0 on them.
    void
    evaluate_beside_faces(DistributedArray &phi);
    /// Adds the values on the faces to the eliminated right-hand sides.
    void
    add_faces(DistributedArray &phi);

    const StaggeredGrid &grid;
    const mpi::Share     block;   ///< uniform cells
    const double         spacing; ///< of the block, m
    RowTransforms        transforms;
    RowTridiagonal       tridiagonal;
    StretchedEnds        ends;
    AlignedVector        end_rows;    ///< [own row][cell of the ends]
    AlignedVector        face_values; ///< [lower, upper][own row]
    Face                 faces[2];
    AlignedVector        work[2];
  };
} // namespace ephyra::fluid
