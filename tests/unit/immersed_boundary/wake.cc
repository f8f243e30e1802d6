#include "ephyra/immersed_boundary/wake.h"

#include <boost/test/unit_test.hpp>

#include "grids.h"

using namespace ephyra;
using namespace ephyra::immersed_boundary;

BOOST_AUTO_TEST_SUITE(wake)

BOOST_AUTO_TEST_CASE(velocity_on_the_axis_is_that_of_an_even_parabola)
{
  const fluid::StaggeredGrid grid{test::line(24, 0., 2., 0.2),
                                  test::line(48, -2., 2.),
                                  false,
                                  MPI_COMM_WORLD};
  fluid::VelocityField       v(grid);
  test::fill(
    v,
    [](double, double) { return 0.; },
    [](const double r, const double y) { return 3 - 2 * r * r + y; });
  const std::vector<double> axis  = velocity_on_axis(v);
  double                    error = 0;
  for (int j = 0; j <= grid.y.n_cells; ++j)
    error = std::max(error, std::abs(axis[j] - 3 - grid.y.face[j]));
  BOOST_TEST(error < 1e-13);
}

BOOST_AUTO_TEST_CASE(reversed_flow_begins_and_ends_where_the_velocity_vanishes)
{
  const fluid::GridLine y     = test::line(400, -2., 2.);
  const auto            along = [&](const auto &velocity) {
    std::vector<double> v;
    for (const double x : y.face)
      v.push_back(velocity(x));
    return v;
  };
  // Attached to the rear y = 0.3 and 0.7 long, the wake above.
  ReversedFlow found =
    reversed_flow(y, along([](const double x) { return x - 1.; }), 0.3, 1., 0.);
  BOOST_TEST(found.begin == 0.);
  BOOST_TEST(std::abs(found.end - 0.7) < 1e-12);
  // The same for a body that moves at 0.25.
  found = reversed_flow(
    y, along([](const double x) { return x - 1.; }), 0.3, 1., 0.25);
  BOOST_TEST(std::abs(found.end - 0.95) < 1e-12);
  // Apart from the rear y = -0.2, below it, from -0.5 to -1.25.
  found =
    reversed_flow(y,
                  along([](const double x) { return -(x + 0.5) * (x + 1.25); }),
                  -0.2,
                  -1.,
                  0.);
  BOOST_TEST(std::abs(found.begin - 0.3) < 1e-4);
  BOOST_TEST(std::abs(found.end - 1.05) < 1e-4);
  found = reversed_flow(y, along([](double) { return 1.; }), 0., 1., 0.);
  BOOST_TEST(found.begin == 0.);
  BOOST_TEST(found.end == 0.);
}

BOOST_AUTO_TEST_CASE(separation_where_the_friction_changes_sign)
{
  // Around a sphere, at the distance d from its surface and the angle alpha from
  // the front, the velocity d (cos(alpha) - cos(alpha_0)) downstream.
  constexpr double           R = 0.5, alpha_0 = 2.1;
  const fluid::StaggeredGrid grid{
    test::line(64, 0., 2.), test::line(128, -2., 2.), false, MPI_COMM_WORLD};
  RigidBody::Parameters parameters;
  parameters.radius = R;
  const RigidBody body(parameters);
  for (const double direction : {1., -1.}) // the stream runs up or down
    {
      fluid::VelocityField    v(grid);
      fluid::DistributedArray p(grid);
      const auto              downstream = [&](const double r, const double y) {
        const double s = std::hypot(r, y);
        return (s - R) * (-direction * y / s - std::cos(alpha_0));
      };
      test::fill(
        v,
        [&](const double r, const double y) {
          return -direction * downstream(r, y) * y / std::hypot(r, y);
        },
        [&](const double r, const double y) {
          return direction * downstream(r, y) * r / std::hypot(r, y);
        });
      test::fill_cells(p, [](double, double) { return 0.; });
      const Markers markers(
        body.outline.curves, control_vector(body.outline), grid);
      SurfaceLoads loads(grid, 1., 1.);
      loads.update(markers);
      loads.evaluate(markers, p, v);
      const auto found = separation(body, 0, markers, loads, direction);
      BOOST_REQUIRE(found.size() == 1);
      BOOST_TEST(std::abs(found[0].angle - alpha_0 * 180 / M_PI) < 0.5);

      const SurfaceProfile profile = surface_profile(markers, loads, 0, 1);
      BOOST_TEST(static_cast<int>(profile.arc.size()) == markers.size());
      BOOST_TEST(std::abs(profile.arc.back() +
                          0.5 * markers.state().length.back() - M_PI * R) <
                 1e-3);
    }
}

BOOST_AUTO_TEST_SUITE_END()
