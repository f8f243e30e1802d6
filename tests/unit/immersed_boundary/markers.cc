#include "ephyra/immersed_boundary/markers.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/splines/nurbs_patch.h"

#include <boost/test/unit_test.hpp>

#include "grids.h"

using namespace ephyra;
using namespace ephyra::immersed_boundary;

BOOST_AUTO_TEST_SUITE(markers)

namespace
{
  fluid::StaggeredGrid
  make_grid(const int n, const double amplitude = 0)
  {
    return {test::line(n, 0., 1., amplitude),
            test::line(2 * n, -1., 1., amplitude),
            false,
            MPI_COMM_SELF};
  }

  double
  area(const MarkerState &m)
  {
    double sum = 0;
    for (std::size_t l = 0; l < m.r.size(); ++l)
      sum += 2 * M_PI * m.r[l] * m.length[l];
    return sum;
  }
} // namespace

BOOST_AUTO_TEST_CASE(volumes_of_primitives)
{
  const auto volume = [](const Outline &o) {
    return enclosed(o.curves, control_vector(o, 0.3));
  };
  const Enclosed sphere = volume(test::spheroid(0.5, 0.5, "sphere"));
  BOOST_TEST(std::abs(sphere.volume - M_PI / 6) < 1e-13);
  BOOST_TEST(std::abs(sphere.centroid_y - 0.3) < 1e-13);
  BOOST_TEST(std::abs(volume(test::spheroid(0.2, 0.6, "s")).volume -
                      4. / 3. * M_PI * 0.04 * 0.6) < 1e-13);
  BOOST_TEST(std::abs(volume(test::torus(0.7, 0.2, "t")).volume -
                      2 * M_PI * 0.7 * M_PI * 0.04) < 1e-13);
  BOOST_TEST(std::abs(volume(test::disk(0.5, 0.2, "d")).volume -
                      M_PI * 0.25 * 0.2) < 1e-13);
}

BOOST_AUTO_TEST_CASE(area_of_a_sphere_converges_at_second_order)
{
  const Outline             o = test::spheroid(0.5, 0.5, "sphere");
  const std::vector<double> x = control_vector(o);
  double                    error[2];
  for (int level = 0; level < 2; ++level)
    {
      const Markers markers(o.curves, x, make_grid(level == 0 ? 16 : 32));
      error[level] = std::abs(area(markers.state()) - M_PI) / M_PI;
    }
  BOOST_TEST(error[0] < 1e-3);
  BOOST_TEST(std::log2(error[0] / error[1]) > 1.8);
}

BOOST_AUTO_TEST_CASE(spacing_follows_the_local_cells)
{
  for (const double amplitude : {0., 0.5})
    {
      const fluid::StaggeredGrid grid = make_grid(32, amplitude);
      const Outline              o    = test::torus(0.5, 0.3, "torus");
      const Markers              markers(o.curves, control_vector(o), grid);
      BOOST_TEST(markers.largest_spacing(grid) < 0.53);
      double smallest = 1;
      for (int l = 0; l < markers.size(); ++l)
        {
          const MarkerState &m = markers.state();
          smallest             = std::min(smallest,
                              length_in_cells(grid,
                                              m.r[l],
                                              m.y[l],
                                              m.length[l] * m.t_r[l],
                                              m.length[l] * m.t_y[l]));
        }
      BOOST_TEST(smallest > 0.4);
      BOOST_CHECK_NO_THROW(markers.check(grid));
    }
}

BOOST_AUTO_TEST_CASE(normals_point_into_the_fluid)
{
  const fluid::StaggeredGrid grid = make_grid(32);
  const Outline              o    = test::torus(0.5, 0.3, "torus");
  const Markers              markers(o.curves, control_vector(o), grid);
  const MarkerState         &m = markers.state();
  for (int l = 0; l < markers.size(); ++l)
    {
      BOOST_TEST(std::abs(m.n_r[l] - (m.r[l] - 0.5) / 0.3) < 1e-12);
      BOOST_TEST(std::abs(m.n_y[l] - m.y[l] / 0.3) < 1e-12);
    }

  // All sides of a patch, of either handedness.
  using splines::KnotVector;
  for (const bool swapped : {false, true})
    {
      std::vector<splines::Point> points{
        {.2, -.5}, {.2, .5}, {.6, -.5}, {.6, .5}};
      if (swapped)
        std::swap(points[1], points[2]);
      const splines::NurbsPatch<2> patch(
        {KnotVector::uniform(1, 1), KnotVector::uniform(1, 1)},
        points,
        std::vector<double>(4, 1.));
      using splines::Side;
      const Outline box = patch_outline(
        patch,
        {Side::theta1_0, Side::theta1_1, Side::theta2_0, Side::theta2_1},
        "box");
      const std::vector<double> x = control_vector(box);
      BOOST_TEST(std::abs(enclosed(box.curves, x).volume - M_PI * (.36 - .04)) <
                 1e-13);
      const Markers      on_box(box.curves, x, grid);
      const MarkerState &b = on_box.state();
      for (int l = 0; l < on_box.size(); ++l)
        BOOST_TEST(b.n_r[l] * (b.r[l] - 0.4) + b.n_y[l] * b.y[l] > 0.19);
    }
}

BOOST_AUTO_TEST_CASE(motion_and_loads_are_those_of_the_control_points)
{
  const fluid::StaggeredGrid grid = make_grid(32);
  const Outline              o    = test::spheroid(0.5, 0.5, "sphere");
  std::vector<double>        x    = control_vector(o);
  Markers                    markers(o.curves, x, grid);
  std::vector<double>        v(x.size()), a(x.size(), -3.);
  for (std::size_t i = 0; i < x.size(); i += 2)
    {
      v[i]     = 0.1 * x[i]; // stretches by 10 % along r
      v[i + 1] = 2.;
    }
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += 0.05 * v[i];
  markers.move(x, v, a);
  const MarkerState  &m = markers.state();
  std::vector<double> force(2 * markers.size()), control(x.size());
  double              power = 0, power_at_control = 0;
  for (int l = 0; l < markers.size(); ++l)
    {
      BOOST_TEST(std::abs(m.v_r[l] - 0.1 * m.r[l] / 1.005) < 1e-13);
      BOOST_TEST(std::abs(m.v_y[l] - 2.) < 1e-13);
      BOOST_TEST(std::abs(m.a_r[l] + 3.) < 1e-12);
      BOOST_TEST(std::abs(m.dv_r_ds[l] - 0.1 / 1.005 * m.t_r[l]) < 1e-12);
      BOOST_TEST(std::abs(m.dv_y_ds[l]) < 1e-11);
      force[l]                  = std::sin(l);
      force[markers.size() + l] = std::cos(l);
      power += force[l] * m.v_r[l] + force[markers.size() + l] * m.v_y[l];
    }
  markers.to_control_points(force, control);
  for (std::size_t i = 0; i < x.size(); ++i)
    power_at_control += control[i] * v[i];
  BOOST_TEST(std::abs(power - power_at_control) < 1e-12);
}

BOOST_AUTO_TEST_CASE(bad_surfaces_are_refused)
{
  const fluid::StaggeredGrid grid = make_grid(32);
  const Outline              o    = test::spheroid(0.5, 0.5, "ball");
  BOOST_CHECK_EXCEPTION(Markers(o.curves, control_vector(o, 0.7), grid),
                        InputError,
                        [](const InputError &e) {
                          return std::string(e.what()).find("Body 'ball'") == 0;
                        });

  Markers                   markers(o.curves, control_vector(o), grid);
  const std::vector<double> rest(2 * o.control_points.size(), 0.);
  const auto                says = [](const std::string &text) {
    return [text](const DivergedError &e) {
      return std::string(e.what()).find(text) != std::string::npos;
    };
  };
  markers.move(control_vector(o, 0.51), rest, rest);
  BOOST_CHECK_EXCEPTION(
    markers.check(grid), DivergedError, says("left the flow"));

  std::vector<double> x = control_vector(o);
  for (double &value : x)
    value *= 2.1;
  markers.move(x, rest, rest);
  const fluid::StaggeredGrid large{
    test::line(48, 0., 1.5), test::line(96, -1.5, 1.5), false, MPI_COMM_SELF};
  BOOST_CHECK_EXCEPTION(
    markers.check(large), DivergedError, says("cells apart"));
  markers.distribute({x}, large);
  BOOST_CHECK_NO_THROW(markers.check(large));

  x[3] = std::nan("");
  BOOST_CHECK_THROW(markers.move(x, rest, rest), DivergedError);
}

BOOST_AUTO_TEST_SUITE_END()
