#include "ephyra/immersed_boundary/interior_fluid.h"

#include "ephyra/geometry/simple_bodies.h"
#include "ephyra/splines/control_vector.h"

#include <boost/test/unit_test.hpp>

#include "grids.h"

using namespace ephyra;
using namespace ephyra::immersed_boundary;

BOOST_AUTO_TEST_SUITE(interior_fluid)

BOOST_AUTO_TEST_CASE(virtual_work_in_a_linear_flow_is_exact)
{
  // v = (-A r, 2 A y), that gains g dt along y in the step, p = c + b y, in a
  // cylinder of radius R and length L at rest.
  const double A = 0.4, g = 0.9, dt = 0.01, b = 3., c = -2., rho = 1.3,
               mu              = 0.7;
  const double               R = 0.5, L = 0.6;
  const fluid::StaggeredGrid grid(test::line(48, 0., 2., 0.2),
                                  test::line(96, -2., 2.),
                                  false,
                                  MPI_COMM_WORLD);
  fluid::VelocityField       before(grid), after(grid);
  fluid::DistributedArray    p(grid);
  const auto v_r = [&](const double r, double) { return -A * r; };
  test::fill(before, v_r, [&](double, const double y) { return 2 * A * y; });
  test::fill(
    after, v_r, [&](double, const double y) { return 2 * A * y + g * dt; });
  test::fill_cells(p, [&](double, const double y) { return c + b * y; });

  geometry::Discretization mesh;
  mesh.degree                   = {{3, 3}};
  mesh.n_elements               = {{2, 4}};
  const auto patch              = geometry::make_tube(0., R, L, 0., mesh).patch;
  const std::vector<double> x   = splines::control_vector(patch);
  double                    y_0 = 1e9;
  for (std::size_t i = 1; i < x.size(); i += 2)
    y_0 = std::min(y_0, x[i]);
  InteriorFluid inside(patch, grid, rho, mu, Parameters());
  inside.update(x);
  inside.start(before);
  std::vector<double> load(x.size(), 0.);
  inside.add_load(dt, p, after, load);

  // Work on w = (0, 1), (0, y), (r, 0); the basis has all of them.
  double work[3] = {0, 0, 0};
  for (std::size_t i = 0; i < x.size(); i += 2)
    {
      work[0] += load[i + 1];
      work[1] += load[i + 1] * x[i + 1];
      work[2] += load[i] * x[i];
    }
  // Means over the cylinder.
  const double volume = M_PI * R * R * L;
  const double y      = y_0 + 0.5 * L;
  const double yy = y * y + L * L / 12, rr = R * R / 2;
  // Du/Dt = (A^2 r, g + 2 A (2 A y + g dt / 2)).
  const double a_0 = g + A * g * dt, a_1 = 4 * A * A;
  const double exact[3] = {
    volume * rho * (a_0 + a_1 * y),
    volume * (rho * (a_0 * y + a_1 * yy) - c - b * y + 4 * mu * A),
    volume * (rho * A * A * rr - 2 * (c + b * y) - 4 * mu * A)};
  for (int k = 0; k < 3; ++k)
    BOOST_TEST(work[k] == exact[k], boost::test_tools::tolerance(1e-3));
}

BOOST_AUTO_TEST_SUITE_END()
