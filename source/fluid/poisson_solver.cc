#include "ephyra/fluid/poisson_solver.h"

#include "ephyra/fluid/flow_parameters.h"
#include "ephyra/fluid/poisson_eigen.h"
#include "ephyra/fluid/poisson_fft.h"
#include "ephyra/fluid/poisson_hybrid.h"

#include <cmath>
#include <sstream>

namespace ephyra::fluid
{
  namespace
  {
    /// ns for each cell and solve of one core, rough: 30 GFlop/s in matrix
    /// products, the rest is bound by memory.
    double
    eigen_cost(const int n_r)
    {
      return 9. + 4. * n_r / 30.;
    }
    double
    hybrid_cost(const int n_r, const double share_of_block)
    {
      constexpr double in_block = 16., seam = 3.;
      return share_of_block * in_block +
             (1. - share_of_block) * (eigen_cost(n_r) + seam);
    }
  } // namespace

  PoissonChoice
  choose_poisson_solver(const PoissonKind kind, const StaggeredGrid &grid)
  {
    if (kind != PoissonKind::automatic)
      return {kind, "as chosen"};
    if (grid.y.uniform)
      return {PoissonKind::fft, "the axial spacing is uniform"};
    const int        n_r = grid.r.n_cells, n_y = grid.y.n_cells;
    const mpi::Share block = longest_uniform_block(grid.y);
    const double     eigen = eigen_cost(n_r);
    const double     hybrid =
      hybrid_cost(n_r, static_cast<double>(block.count) / n_y);
    const bool worth =
      block.count >= PoissonHybrid::shortest_block && hybrid < eigen;
    std::ostringstream reason;
    reason << block.count << " of " << n_y
           << " cells in y are a uniform block; estimates for each cell and "
              "solve: hybrid "
           << std::round(hybrid) << " ns, eigen " << std::round(eigen) << " ns";
    return {worth ? PoissonKind::hybrid : PoissonKind::eigen, reason.str()};
  }

  std::unique_ptr<PoissonSolver>
  make_poisson_solver(const PoissonKind    kind,
                      const StaggeredGrid &grid,
                      const PoissonSides  &sides)
  {
    switch (choose_poisson_solver(kind, grid).kind)
      {
      case PoissonKind::fft:
        return std::make_unique<PoissonFft>(grid, sides);
      case PoissonKind::hybrid:
        return std::make_unique<PoissonHybrid>(grid, sides);
      default:
        return std::make_unique<PoissonEigen>(grid, sides);
      }
  }
} // namespace ephyra::fluid
