#include "ephyra/fluid/poisson_solver.h"

#include "ephyra/fluid/flow_parameters.h"
#include "ephyra/fluid/poisson_eigen.h"
#include "ephyra/fluid/poisson_fft.h"

namespace ephyra::fluid
{
  std::unique_ptr<PoissonSolver>
  make_poisson_solver(const PoissonKind    kind,
                      const StaggeredGrid &grid,
                      const PoissonSides  &sides)
  {
    if (kind == PoissonKind::fft ||
        (kind == PoissonKind::automatic && grid.y.uniform))
      return std::make_unique<PoissonFft>(grid, sides);
    return std::make_unique<PoissonEigen>(grid, sides);
  }
} // namespace ephyra::fluid
