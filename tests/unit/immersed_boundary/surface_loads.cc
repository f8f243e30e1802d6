#include "ephyra/immersed_boundary/surface_loads.h"
#include "ephyra/immersed_boundary/interior_momentum.h"

#include <boost/test/unit_test.hpp>

#include "grids.h"

using namespace ephyra;
using namespace ephyra::immersed_boundary;

BOOST_AUTO_TEST_SUITE(surface_loads)

namespace
{
  fluid::StaggeredGrid
  make_grid(const int n, const MPI_Comm comm = MPI_COMM_WORLD)
  {
    return {
      test::line(n, 0., 2., 0.2), test::line(2 * n, -2., 2.), false, comm};
  }

  constexpr double R = 0.5, U = 1., mu = 0.7;

  /// Stokes flow past a sphere at rest in a stream U along y; zero inside.
  struct StokesFlow
  {
    static double
    v_r(const double r, const double y)
    {
      const double s = std::hypot(r, y), a = R / s;
      return s < R ? 0. : -0.75 * U * (a - a * a * a) * r * y / (s * s);
    }
    static double
    v_y(const double r, const double y)
    {
      const double s = std::hypot(r, y), a = R / s;
      return s < R ? 0.
                   : U * (1 - 0.75 * a - 0.25 * a * a * a -
                          0.75 * (a - a * a * a) * y * y / (s * s));
    }
    static double
    p(const double r, const double y)
    {
      const double s = std::hypot(r, y);
      return s < R ? 0. : -1.5 * mu * U * R * y / (s * s * s);
    }
  };
} // namespace

BOOST_AUTO_TEST_CASE(linear_fields_give_the_exact_traction)
{
  // v = (-A r, 2 A y), p = c + b y around a body that moves with the flow.
  const double               A = 0.4, b = 3., c = -2.;
  const fluid::StaggeredGrid grid = make_grid(48);
  fluid::VelocityField       v(grid);
  fluid::DistributedArray    p(grid);
  test::fill(
    v,
    [&](const double r, double) { return -A * r; },
    [&](double, const double y) { return 2 * A * y; });
  test::fill_cells(p, [&](double, const double y) { return c + b * y; });
  const Outline             o = test::torus(1., 0.4, "torus");
  const std::vector<double> x = control_vector(o, 0.1);
  std::vector<double>       velocity(x), acceleration(x.size());
  for (std::size_t i = 0; i < x.size(); i += 2)
    {
      velocity[i]         = -A * x[i];
      velocity[i + 1]     = 2 * A * x[i + 1];
      acceleration[i]     = 0;
      acceleration[i + 1] = -b / 1.3; // rho a = -grad p
    }
  Markers markers(o.curves, x, grid);
  markers.move(x, velocity, acceleration);
  const MarkerState &m = markers.state();
  for (const bool two_points : {false, true})
    {
      Parameters parameters;
      parameters.friction =
        two_points ? FrictionFormula::quadratic : FrictionFormula::one_point;
      parameters.wall_pressure =
        two_points ? WallPressure::linear : WallPressure::acceleration;
      SurfaceLoads loads(grid, 1.3, mu, parameters);
      loads.update(markers);
      loads.evaluate(markers, p, v);
      BOOST_TEST(loads.n_shortened_probes() == 0);
      double error = 0;
      for (int l = 0; l < markers.size(); ++l)
        {
          const double pw = c + b * m.y[l];
          error           = std::max({error,
                                      std::abs(loads.traction()[l] + pw * m.n_r[l] +
                                     2 * mu * A * m.n_r[l]),
                                      std::abs(loads.traction()[markers.size() + l] +
                                     pw * m.n_y[l] - 4 * mu * A * m.n_y[l])});
        }
      BOOST_TEST(error < 1e-10);
    }
}

BOOST_AUTO_TEST_CASE(drag_of_a_sphere_in_stokes_flow)
{
  const double exact = 6 * M_PI * mu * R * U;
  double       one_point[2], quadratic[2], linear[2];
  for (int level = 0; level < 2; ++level)
    {
      const fluid::StaggeredGrid grid = make_grid(level == 0 ? 48 : 96);
      fluid::VelocityField       v(grid);
      fluid::DistributedArray    p(grid);
      test::fill(v, StokesFlow::v_r, StokesFlow::v_y);
      test::fill_cells(p, StokesFlow::p);
      const Outline o = test::spheroid(R, R, "sphere");
      const Markers markers(o.curves, control_vector(o), grid);
      const auto    error = [&](const FrictionFormula friction,
                             const WallPressure    pressure) {
        Parameters parameters;
        parameters.friction      = friction;
        parameters.wall_pressure = pressure;
        SurfaceLoads loads(grid, 1., mu, parameters);
        loads.update(markers);
        loads.evaluate(markers, p, v);
        return std::abs(loads.axial_force(markers, 0, 1).total() / exact - 1);
      };
      one_point[level] =
        error(FrictionFormula::one_point, WallPressure::acceleration);
      quadratic[level] =
        error(FrictionFormula::quadratic, WallPressure::acceleration);
      linear[level] = error(FrictionFormula::quadratic, WallPressure::linear);
    }
  BOOST_TEST_MESSAGE("error of the drag: one-point "
                     << one_point[0] << ", " << one_point[1] << "; quadratic "
                     << quadratic[0] << ", " << quadratic[1]
                     << "; and linear pressure " << linear[0] << ", "
                     << linear[1]);
  BOOST_TEST(std::log2(one_point[0] / one_point[1]) > 0.85);
  BOOST_TEST(std::log2(quadratic[0] / quadratic[1]) > 0.85);
  BOOST_TEST(std::log2(linear[0] / linear[1]) > 1.6);
  BOOST_TEST(linear[1] < 0.01);
}

BOOST_AUTO_TEST_CASE(probes_stop_at_the_opposite_surface)
{
  // Two coaxial disks, one and a half cells apart: the probes between them
  // would reach into the other one.
  const fluid::StaggeredGrid grid = make_grid(48, MPI_COMM_SELF);
  const double               gap  = 1.2 * grid.y.width[0];
  Outline                    a    = test::disk(0.8, 0.4, "lower");
  Outline                    b    = test::disk(0.8, 0.4, "upper");
  std::vector<double> x = control_vector(a), x_b = control_vector(b, 0.4 + gap);
  for (BoundaryCurve &curve : b.curves)
    {
      for (int &i : curve.control_points)
        i += static_cast<int>(a.control_points.size());
      a.curves.push_back(curve);
    }
  x.insert(x.end(), x_b.begin(), x_b.end());
  const Markers markers(a.curves, x, grid);
  SurfaceLoads  loads(grid, 1., mu);
  loads.update(markers);
  int facing = 0;
  for (int l = 0; l < markers.size(); ++l)
    {
      const MarkerState &m = markers.state();
      facing += m.r[l] < 0.6 && std::abs(m.y[l] - 0.4 - 0.5 * gap) < gap;
    }
  BOOST_TEST(facing > 20);
  BOOST_TEST(loads.n_shortened_probes() >= facing);
}

BOOST_AUTO_TEST_CASE(momentum_inside)
{
  double error[2], seam = 0;
  for (int level = 0; level < 2; ++level)
    {
      const fluid::StaggeredGrid grid = make_grid(level == 0 ? 24 : 48);
      fluid::VelocityField       v(grid);
      test::fill(
        v,
        [](double, double) { return 0.; },
        [](const double r, const double y) { return 1. + r * r + 3 * y; });
      const Outline o = test::spheroid(R, R, "sphere");
      const Markers markers(o.curves, control_vector(o, 0.1), grid);
      // int (1 + r^2 + 3 y) dV = V (1 + 2 R^2 / 5 + 0.3)
      const double exact = M_PI / 6 * (1 + 0.4 * R * R + 0.3);
      error[level] =
        std::abs(interior_axial_momentum(markers, 0, 1, v.y, 0.1) / exact - 1);
    }
  BOOST_TEST(error[0] < 5e-3);
  BOOST_TEST(std::log2(error[0] / error[1]) > 1.7);

  // The same across the seam of a periodic grid.
  for (const double centre : {0., 1.9})
    {
      const fluid::StaggeredGrid grid{
        test::line(24, 0., 2.), test::line(48, -2., 2.), true, MPI_COMM_WORLD};
      fluid::VelocityField v(grid);
      test::fill(
        v,
        [](double, double) { return 0.; },
        [&](const double r, const double y) {
          return r + std::cos(M_PI / 2 * (y - centre));
        });
      const Outline o = test::spheroid(R, R, "sphere");
      const Markers markers(o.curves, control_vector(o, centre), grid);
      const double  momentum =
        interior_axial_momentum(markers, 0, 1, v.y, centre);
      if (centre == 0.)
        seam = momentum;
      else
        BOOST_TEST(std::abs(momentum - seam) < 2e-3 * seam);
    }
}

BOOST_AUTO_TEST_SUITE_END()
