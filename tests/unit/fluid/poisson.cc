#include "ephyra/base/exceptions.h"
#include "ephyra/fluid/flow_parameters.h"
#include "ephyra/fluid/poisson_eigen.h"
#include "ephyra/fluid/poisson_fft.h"
#include "ephyra/fluid/poisson_hybrid.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <random>

using namespace ephyra;
using namespace ephyra::fluid;

namespace
{
  StaggeredGrid
  make_grid(const bool stretched_y, const bool periodic = false)
  {
    GridParameters parameters;
    parameters.r.breakpoints = {0., 0.4, 2.};
    parameters.r.spacings    = {0.02, 0.02, 0.15};
    parameters.y.breakpoints = {-1., 0., 1.};
    parameters.y.spacings    = stretched_y ? std::vector<double>{0.1, 0.03, 0.1}
                                           : std::vector<double>{0.04};
    return parameters.make_grid(periodic, MPI_COMM_WORLD);
  }

  /// A uniform block of y with stretched ends where asked for.
  StaggeredGrid
  make_block_grid(const bool lower, const bool upper)
  {
    GridParameters parameters;
    parameters.r.breakpoints = {0., 0.4, 2.};
    parameters.r.spacings    = {0.02, 0.02, 0.15};
    parameters.y.breakpoints = {0., 1.2};
    parameters.y.spacings    = {0.04, 0.04};
    if (lower)
      {
        parameters.y.breakpoints.insert(parameters.y.breakpoints.begin(), -0.7);
        parameters.y.spacings.insert(parameters.y.spacings.begin(), 0.1);
      }
    if (upper)
      {
        parameters.y.breakpoints.push_back(2.);
        parameters.y.spacings.push_back(0.09);
      }
    return parameters.make_grid(false, MPI_COMM_WORLD);
  }

  /// Largest difference of two fields over the largest value, but for their
  /// mean difference where only differences count.
  double
  difference(const DistributedArray &a,
             const DistributedArray &b,
             const PoissonSides     &sides)
  {
    const StaggeredGrid &grid = a.grid();
    const double cells = static_cast<double>(grid.r.n_cells) * grid.y.n_cells;
    const auto   for_each = [&](const auto &f) {
      for (int i = grid.first_row; i < grid.end_row(); ++i)
        for (int j = 0; j < grid.y.n_cells; ++j)
          f(a(i, j), b(i, j));
    };
    double mean = 0, error = 0, size = 0;
    for_each([&](const double x, const double y) { mean += (x - y) / cells; });
    mean = sides.singular() ? mpi::sum(mean, MPI_COMM_WORLD) : 0.;
    for_each([&](const double x, const double y) {
      error = std::max(error, std::abs(x - y - mean));
      size  = std::max(size, std::abs(x));
    });
    return mpi::max(error, MPI_COMM_WORLD) / mpi::max(size, MPI_COMM_WORLD);
  }

  /// Random values that do not depend on the number of ranks, with zero mean.
  DistributedArray
  random_field(const StaggeredGrid &grid)
  {
    std::mt19937                           generator(7);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    DistributedArray                       f(grid);
    double                                 sum = 0, volume = 0;
    for (int i = 0; i < grid.r.n_cells; ++i)
      for (int j = 0; j < grid.y.n_cells; ++j)
        {
          const double value = uniform(generator);
          const double weight =
            grid.r.centre[i] * grid.r.width[i] * grid.y.width[j];
          sum += value * weight;
          volume += weight;
          if (grid.owns_row(i))
            f(i, j) = value;
        }
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      for (int j = 0; j < grid.y.n_cells; ++j)
        f(i, j) -= sum / volume;
    return f;
  }

  /// Largest residual over the largest right-hand side, both times the cell
  /// volume: the axis rows are not drowned by the others.
  double
  residual(DistributedArray        phi,
           const DistributedArray &f,
           const PoissonSides     &sides)
  {
    const StaggeredGrid &grid = phi.grid();
    phi.exchange_halo();
    const int n_r = grid.r.n_cells, n_y = grid.y.n_cells;
    double    error = 0, size = 0;
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      for (int j = 0; j < n_y; ++j)
        {
          const auto flux_r = [&](const int k) { // through face k, times r
            if (k == 0 || (k == n_r && !sides.outer_dirichlet))
              return 0.;
            const double above = k == n_r ? 0. : phi(k, j);
            return grid.r.face[k] * (above - phi(k - 1, j)) /
                   grid.r.centre_gap[k];
          };
          const auto flux_y = [&](const int k) {
            double below = k > 0 ? phi(i, k - 1) : 0.;
            double above = k < n_y ? phi(i, k) : 0.;
            if (grid.periodic_y && k == 0)
              below = phi(i, n_y - 1);
            else if (grid.periodic_y && k == n_y)
              above = phi(i, 0);
            else if ((k == 0 && !sides.lower_dirichlet) ||
                     (k == n_y && !sides.upper_dirichlet))
              return 0.;
            return (above - below) / grid.y.centre_gap[k];
          };
          const double laplacian =
            (flux_r(i + 1) - flux_r(i)) / (grid.r.centre[i] * grid.r.width[i]) +
            (flux_y(j + 1) - flux_y(j)) / grid.y.width[j];
          error = std::max(error, std::abs(laplacian - f(i, j)));
          size  = std::max(size, std::abs(f(i, j)));
        }
    return mpi::max(error, MPI_COMM_WORLD) / mpi::max(size, MPI_COMM_WORLD);
  }

  constexpr double limit = 1e-10;
} // namespace

BOOST_AUTO_TEST_SUITE(poisson)

BOOST_AUTO_TEST_CASE(residuals)
{
  for (const bool outer : {false, true})
    for (const bool lower : {false, true})
      for (const bool upper : {false, true})
        {
          const PoissonSides sides{outer, lower, upper};
          for (const bool stretched : {false, true})
            {
              const StaggeredGrid    grid = make_grid(stretched);
              const DistributedArray f    = random_field(grid);
              PoissonEigen           eigen(grid, sides);
              DistributedArray       phi(grid);
              phi.copy_from(f);
              eigen.solve(phi);
              BOOST_TEST(residual(phi, f, sides) < limit);
              if (stretched)
                continue;
              PoissonFft fft(grid, sides);
              phi.copy_from(f);
              fft.solve(phi);
              BOOST_TEST(residual(phi, f, sides) < limit);
            }
        }
}

BOOST_AUTO_TEST_CASE(hybrid)
{
  // Residual and difference from eigenvectors alone are round-off of phi,
  // which is up to 20 times f / h^2 here.
  for (const bool lower_end : {false, true})
    for (const bool upper_end : {false, true})
      for (const bool outer : {false, true})
        for (const bool lower : {false, true})
          for (const bool upper : {false, true})
            {
              if (!lower_end && !upper_end)
                continue;
              const PoissonSides  sides{outer, lower, upper};
              const StaggeredGrid grid = make_block_grid(lower_end, upper_end);
              const DistributedArray f = random_field(grid);
              DistributedArray       phi(grid), psi(grid);
              phi.copy_from(f);
              psi.copy_from(f);
              PoissonHybrid(grid, sides).solve(phi);
              PoissonEigen(grid, sides).solve(psi);
              BOOST_TEST(residual(phi, f, sides) < 2e-12);
              BOOST_TEST(difference(phi, psi, sides) < 1e-12);
            }
}

BOOST_AUTO_TEST_CASE(automatic_choice)
{
  const auto kind = [](const StaggeredGrid &grid) {
    return choose_poisson_solver(PoissonKind::automatic, grid).kind;
  };
  BOOST_CHECK(kind(make_grid(false)) == PoissonKind::fft);
  BOOST_CHECK(kind(make_grid(true)) == PoissonKind::eigen);
  // Few rows: eigenvectors cost next to nothing.
  BOOST_CHECK(kind(make_block_grid(true, true)) == PoissonKind::eigen);
  GridParameters parameters;
  parameters.r.breakpoints = {0., 1.};
  parameters.r.spacings    = {0.01};
  parameters.y.breakpoints = {0., 1., 2.};
  parameters.y.spacings    = {0.02, 0.02, 0.1};
  BOOST_CHECK(kind(parameters.make_grid(false, MPI_COMM_WORLD)) ==
              PoissonKind::hybrid);
}

BOOST_AUTO_TEST_CASE(periodic_residual)
{
  for (const bool outer : {false, true})
    {
      const PoissonSides     sides{outer, false, false};
      const StaggeredGrid    grid = make_grid(false, true);
      const DistributedArray f    = random_field(grid);
      PoissonFft             fft(grid, sides);
      DistributedArray       phi(grid);
      phi.copy_from(f);
      fft.solve(phi);
      BOOST_TEST(residual(phi, f, sides) < limit);
    }
}

BOOST_AUTO_TEST_CASE(both_solvers_agree)
{
  const PoissonSides     sides{false, false, true};
  const StaggeredGrid    grid = make_grid(false);
  const DistributedArray f    = random_field(grid);
  DistributedArray       phi(grid), psi(grid);
  phi.copy_from(f);
  psi.copy_from(f);
  PoissonFft(grid, sides).solve(phi);
  PoissonEigen(grid, sides).solve(psi);
  BOOST_TEST(difference(phi, psi, sides) < 1e-12);
}

BOOST_AUTO_TEST_CASE(transforms)
{
  // Each mode is an eigenvector of the second difference with its ends.
  for (const RowEnds ends : {RowEnds::neumann_neumann,
                             RowEnds::dirichlet_dirichlet,
                             RowEnds::neumann_dirichlet,
                             RowEnds::dirichlet_neumann,
                             RowEnds::periodic})
    // First steps of radix 1, 1, 3, 18 and 23.
    for (const int n : {5, 12, 96, 216, 184})
      {
        RowTransforms             transforms(n, ends);
        const std::vector<double> lambda = transforms.eigenvalues(1.);
        AlignedVector             a(n), b(n), x(n), y(n);
        double                    worst = 0;
        for (const bool pair : {false, true})
          for (int k = 0; k < n; ++k)
            {
              std::fill(a.begin(), a.end(), 0.);
              std::fill(b.begin(), b.end(), 0.);
              a[k]         = 1;
              b[n - 1 - k] = -2;
              transforms.backward(a.data(),
                                  pair ? b.data() : nullptr,
                                  x.data(),
                                  pair ? y.data() : nullptr);
              const auto check = [&](const AlignedVector &v,
                                     const double         eigenvalue) {
                for (int j = 0; j < n; ++j)
                  {
                    double below = j > 0 ? v[j - 1] : v[0];
                    double above = j < n - 1 ? v[j + 1] : v[n - 1];
                    if (j == 0 && ends == RowEnds::periodic)
                      below = v[n - 1];
                    if (j == n - 1 && ends == RowEnds::periodic)
                      above = v[0];
                    if (j == 0 && (ends == RowEnds::dirichlet_dirichlet ||
                                   ends == RowEnds::dirichlet_neumann))
                      below = -v[0];
                    if (j == n - 1 && (ends == RowEnds::dirichlet_dirichlet ||
                                       ends == RowEnds::neumann_dirichlet))
                      above = -v[n - 1];
                    worst = std::max(
                      worst,
                      std::abs(below - 2 * v[j] + above + eigenvalue * v[j]));
                  }
              };
              check(x, lambda[k]);
              if (pair)
                check(y, lambda[n - 1 - k]);
              transforms.forward(x.data(), pair ? y.data() : nullptr);
              for (int m = 0; m < n; ++m)
                {
                  worst =
                    std::max(worst, std::abs(x[m] / transforms.scale() - a[m]));
                  if (pair)
                    worst = std::max(
                      worst, std::abs(y[m] / transforms.scale() - b[m]));
                }
            }
        BOOST_TEST(worst < 1e-13);
      }
  BOOST_TEST(!is_awkward_length(4600)); // 23 is a radix
  BOOST_TEST(is_awkward_length(4604));  // 1151
  BOOST_TEST(next_good_length(4604) == 4606);
}

BOOST_AUTO_TEST_CASE(unsuitable_grids_are_refused)
{
  BOOST_CHECK_THROW(PoissonFft(make_grid(true), {}), InputError);
  BOOST_CHECK_THROW(PoissonEigen(make_grid(false, true), {}), InputError);
  BOOST_CHECK_THROW(PoissonHybrid(make_grid(false), {}), InputError);
  BOOST_CHECK_THROW(PoissonHybrid(make_grid(true), {}), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
