#pragma once

#include "ephyra/fluid/poisson_solver.h"
#include "ephyra/fluid/radial_modes.h"
#include "ephyra/fluid/transposition.h"

#include <memory>
#include <vector>

namespace ephyra::fluid
{
  /// The Poisson equation in the two stretched ends of a grid in y, and on the
  /// faces between them and a uniform block of cells, in radial modes. In an
  /// end, from the side of the domain towards the block, mode lambda obeys
  ///   a_s (x_(s+1) - x_s) - a_(s-1) (x_s - x_(s-1)) - lambda dy_s x_s = f_s,
  /// a_s one over the distance; x behind the last cell is the value on the
  /// face. Elimination in terms of fluxes, e_s = lambda dy_s + a_(s-1) e_(s-1)
  /// / (a_(s-1) + e_(s-1)), has no differences: the response of the face's flux
  /// to its value is exact even where it is small. That of the block is known
  /// in closed form.
  class StretchedEnds
  {
  public:
    StretchedEnds(const StaggeredGrid &grid,
                  const PoissonSides  &sides,
                  const mpi::Share    &block);

    /// Number of cells in y in both ends.
    int
    n_cells() const
    {
      return n_lower + n_upper;
    }
    double
    root_weight(const int row) const
    {
      return radial.root_weight[row];
    }

    /// @p rows: [own row][cells of the lower end, then of the upper one], on
    /// entry the right-hand side times root_weight dy, on return phi.
    /// @p faces: [lower, upper][own row], on entry root_weight times the
    /// gradient in the block beside the face, pointing into the block, for
    /// phi = 0 on both faces; on return phi on the face. A face at a side of
    /// the domain is ignored. Collective.
    void
    solve(double *rows, double *faces);

  private:
    /// One end in order of elimination.
    struct End
    {
      std::vector<int>    column;   ///< index among the cells of both ends
      std::vector<double> ahead;    ///< a_s
      AlignedVector       inverse;  ///< 1/(a_s + e_s), [s][own mode]
      std::vector<double> response; ///< of the flux on the face to its value
    };

    void
    set_up_end(End &end,
               int  first_cell,
               int  direction,
               int  n_cells,
               int  first_column,
               bool dirichlet);
    void
    set_up_block(double spacing, const PoissonSides &sides);
    void
    eliminate(const End &end, double *flux);
    void
    substitute(const End &end, const double *face);
    void
    solve_faces(double *lower_face, double *upper_face);
    /// Calls f(modes of rank q) for all ranks.
    template <typename Function>
    void
    for_each_share(const Function &function) const;
    void
    to_modes(const double *rows);
    void
    from_modes(double *rows);

    const StaggeredGrid &grid;
    const int            n_lower, n_upper, n_block;
    const RadialModes    radial;
    const mpi::Share     own_modes;
    End                  lower, upper;
    // Of the block, [own mode]: flux on a face per value there, per value on
    // the other face, and the difference of their squares.
    std::vector<double> near_response, far_response, determinant;

    AlignedVector modes;       ///< [cell of the ends][own mode]
    AlignedVector face_modes;  ///< [lower, upper][all modes]
    AlignedVector face_values; ///< [lower, upper][own mode]
    // Several ranks: own cells of the ends with all rows, with all modes.
    std::unique_ptr<Transposition> transposition;
    AlignedVector                  columns, column_modes;
    std::vector<int> send_count, send_offset, receive_count, receive_offset;
    AlignedVector    message;
  };
} // namespace ephyra::fluid
