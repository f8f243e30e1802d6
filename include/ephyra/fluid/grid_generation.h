#pragma once

#include "ephyra/fluid/staggered_grid.h"

#include <string>
#include <vector>

namespace ephyra
{
  class ParameterHandler;
}

namespace ephyra::fluid
{
  /// How the spacing changes between two breakpoints.
  enum class Stretching
  {
    geometric, ///< h linear in x: each cell wider by the same factor
    smooth     ///< h by a cubic step: its slope vanishes at both breakpoints
  };

  /// One direction of the grid: the spacing h at breakpoints, which are faces;
  /// one value of h for all is a uniform segment. The faces are equidistant in
  /// xi, d xi / dx = 1/h(x); h is scaled in each segment such that a whole
  /// number of cells fits. Dividing all spacings by two halves every cell of
  /// the same map x(xi), so order of convergence can be observed.
  struct GridDirection
  {
    std::vector<double> breakpoints{0., 1.}; ///< m, increasing
    std::vector<double> spacings{1. / 32.};  ///< m, one or one each
    Stretching          stretching = Stretching::geometric;

    /// Throws InputError where the data contradict each other; @p name of the
    /// direction appears in the message.
    GridLine
    generate(const std::string &name) const;
  };

  /// The subsection "Grid": both directions.
  struct GridParameters
  {
    GridDirection r, y;
    double        largest_ratio = 1.2; ///< of neighbouring cells, refused above

    static void
    declare(ParameterHandler &prm);
    void
    parse(ParameterHandler &prm);

    /// Generates the grid; throws InputError where cells grow faster than
    /// largest_ratio.
    StaggeredGrid
    make_grid(bool periodic_y, MPI_Comm comm) const;
  };
} // namespace ephyra::fluid
