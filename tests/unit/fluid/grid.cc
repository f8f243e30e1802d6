#include "ephyra/base/exceptions.h"
#include "ephyra/fluid/grid_generation.h"
#include "ephyra/fluid/velocity_field.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstdint>

using namespace ephyra;
using namespace ephyra::fluid;

BOOST_AUTO_TEST_SUITE(grid)

BOOST_AUTO_TEST_CASE(uniform_line)
{
  GridDirection direction;
  direction.breakpoints = {0., 3.};
  direction.spacings    = {0.1};
  const GridLine line   = direction.generate("axial");
  BOOST_TEST(line.n_cells == 30);
  BOOST_TEST(line.uniform);
  BOOST_TEST(line.cell_of(-1e-9) == -1);
  BOOST_TEST(line.cell_of(3.) == 30);
  for (int i = 0; i < line.n_cells; ++i)
    {
      BOOST_TEST(line.cell_of(line.face[i]) == i);
      BOOST_TEST(line.cell_of(line.centre[i]) == i);
      BOOST_TEST(line.cell_of(std::nextafter(line.face[i + 1], 0.)) == i);
    }
}

BOOST_AUTO_TEST_CASE(stretched_line)
{
  GridDirection direction;
  direction.breakpoints = {0., 1., 4.};
  direction.spacings    = {0.05, 0.05, 0.3};
  for (const Stretching kind : {Stretching::geometric, Stretching::smooth})
    {
      direction.stretching = kind;
      const GridLine line  = direction.generate("radial");
      BOOST_TEST(!line.uniform);
      BOOST_TEST(line.face[20] == 1.);
      BOOST_TEST(line.face.back() == 4.);
      BOOST_TEST(line.largest_ratio() < 1.2);
      BOOST_TEST(std::abs(line.width.back() - 0.3) < 0.03);
      for (int i = 0; i < line.n_cells; ++i)
        BOOST_TEST(line.cell_of(line.centre[i]) == i);
    }
  // Geometric: one factor throughout the stretched part.
  direction.stretching = Stretching::geometric;
  const GridLine line  = direction.generate("radial");
  const double   ratio = line.width[22] / line.width[21];
  for (int i = 22; i < line.n_cells; ++i)
    BOOST_TEST(line.width[i] / line.width[i - 1] == ratio,
               boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(bad_grids_are_refused)
{
  GridParameters parameters;
  parameters.r.breakpoints = {0., 1.};
  parameters.r.spacings    = {0.01, 0.4};
  BOOST_CHECK_THROW(parameters.make_grid(false, MPI_COMM_WORLD), InputError);
  parameters.r.spacings = {0.01, 0.02, 0.03};
  BOOST_CHECK_THROW(parameters.make_grid(false, MPI_COMM_WORLD), InputError);
  parameters.r.breakpoints = {0., 1., 0.5};
  BOOST_CHECK_THROW(parameters.make_grid(false, MPI_COMM_WORLD), InputError);
  parameters.r.breakpoints = {0.5, 1.};
  parameters.r.spacings    = {0.01};
  BOOST_CHECK_THROW(parameters.make_grid(false, MPI_COMM_WORLD), InputError);
}

BOOST_AUTO_TEST_CASE(halos)
{
  GridParameters parameters;
  parameters.r.spacings    = {0.05};
  parameters.y.spacings    = {0.1};
  const StaggeredGrid grid = parameters.make_grid(false, MPI_COMM_WORLD);
  const auto value = [](const int i, const int j) { return 100. * i + j; };

  VelocityField field(grid);
  for (int i = grid.first_row; i < grid.end_row(); ++i)
    {
      BOOST_TEST(reinterpret_cast<std::uintptr_t>(field.r.row(i)) % 64 == 0u);
      for (int j = -2; j < grid.y.n_cells + 2; ++j)
        {
          field.r(i, j) = value(i, j);
          field.y(i, j) = -value(i, j);
        }
    }
  DistributedArray::exchange_halos({&field.r, &field.y});
  const int first = grid.is_first_rank() ? 0 : grid.first_row - 2;
  const int last  = grid.is_last_rank() ? grid.end_row() : grid.end_row() + 2;
  for (int i = first; i < last; ++i)
    for (int j = -2; j < grid.y.n_cells + 2; ++j)
      {
        BOOST_TEST(field.r(i, j) == value(i, j));
        BOOST_TEST(field.y(i, j) == -value(i, j));
      }

  // Adding halos to their owners doubles the rows that neighbours hold too.
  field.r.add_halo_to_owner();
  for (int i = grid.first_row; i < grid.end_row(); ++i)
    {
      const bool shared = (!grid.is_first_rank() && i < grid.first_row + 2) ||
                          (!grid.is_last_rank() && i >= grid.end_row() - 2);
      for (int j = 0; j < grid.y.n_cells; ++j)
        BOOST_TEST(field.r(i, j) == (shared ? 2 : 1) * value(i, j));
    }
}

BOOST_AUTO_TEST_SUITE_END()
