#include "ephyra/geometry/shapes.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/geometry/periodic_tie.h"
#include "measures.h"

#include <boost/test/unit_test.hpp>

using namespace ephyra;
using namespace ephyra::geometry;
using namespace ephyra::tests;

namespace
{
  const double pi = std::acos(-1.);

  BodyParameters
  body(const std::string &shape)
  {
    BodyParameters p;
    p.shape                     = shape;
    p.discretization.n_elements = {{5, 3}};
    return p;
  }

  CurveParameters
  curve(const std::string &shape)
  {
    CurveParameters p;
    p.shape                     = shape;
    p.discretization.n_elements = {{8, 1}};
    return p;
  }

  /// The outward normals of all wet sides, integrated round the body with the
  /// position: 2 pi int x.n r ds = 3 V if the normals point outwards and the
  /// sides close the volume (together with the axis).
  double
  volume_by_normals(const BodyPatch &shape, const double y0)
  {
    double sum = 0.;
    for (const WetSide &wet : shape.wet_sides)
      {
        const auto                        side = shape.patch.side(wet.side);
        const splines::PatchQuadrature<1> rule(side, {{10}});
        for (int e = 0; e < rule.n_elements(); ++e)
          for (int q = 0; q < rule.n_points(); ++q)
            {
              const Point x = side.point(rule.theta(e, q));
              const Point g = side.tangents(rule.theta(e, q))[0];
              const Point n = outward_normal(g, wet.reversed);
              sum += rule.weight(e, q) * std::hypot(g.r, g.y) * x.r *
                     (x.r * n.r + (x.y - y0) * n.y);
            }
      }
    return 2. * pi * sum / 3.;
  }

  bool
  same(const double a, const double b, const double relative = 1e-10)
  {
    return std::abs(a - b) <= relative * std::abs(b);
  }
} // namespace

BOOST_AUTO_TEST_SUITE(shapes)

BOOST_AUTO_TEST_CASE(bodies_have_their_volume_and_normals)
{
  const auto sphere   = [](const double r) { return 4. / 3. * pi * r * r * r; };
  BodyParameters tube = body("tube"), rod = body("rod"), disk = body("disk"),
                 shell = body("hollow sphere"), bell = body("bell");
  const std::pair<BodyParameters, double> expected[] = {
    {tube, pi * (1e-4 - 0.25e-4) * 0.02},
    {rod, pi * 1e-4 * 0.02},
    {disk, pi * 1e-4 * 0.001},
    {shell, sphere(0.01) - sphere(0.005)},
    {bell, volume_of_revolution(create_body(bell).patch, 10)}};
  for (const auto &[p, volume] : expected)
    {
      const BodyPatch b = create_body(p);
      BOOST_TEST_CONTEXT(p.shape)
      {
        BOOST_TEST(b.patch.degree(0) == 3);
        BOOST_TEST(b.patch.degree(1) == 3);
        BOOST_TEST(b.patch.knot_vector(0).n_elements() == 5);
        BOOST_TEST(b.patch.knot_vector(1).n_elements() == 3);
        BOOST_TEST(same(volume_of_revolution(b.patch, 10), volume));
        BOOST_TEST(same(volume_by_normals(b, 0.3), volume));
      }
    }
}

BOOST_AUTO_TEST_CASE(wet_sides_follow_one_another)
{
  for (const std::string shape : {"tube", "rod", "disk", "bell"})
    {
      const BodyPatch b = create_body(body(shape));
      BOOST_TEST(b.wet_sides.size() == (shape == "tube" ? 4u : 3u));
      Point previous;
      for (std::size_t s = 0; s < b.wet_sides.size(); ++s)
        {
          const auto  side = b.patch.side(b.wet_sides[s].side);
          const Point from = side.point({{b.wet_sides[s].reversed ? 1. : 0.}});
          const Point to   = side.point({{b.wet_sides[s].reversed ? 0. : 1.}});
          if (s > 0)
            BOOST_TEST(std::hypot(from.r - previous.r, from.y - previous.y) <
                       1e-16);
          else if (shape != "tube")
            BOOST_TEST(from.r == 0.);
          previous = to;
        }
      if (shape != "tube")
        BOOST_TEST(previous.r == 0.);
    }
}

BOOST_AUTO_TEST_CASE(orientation)
{
  BodyParameters p     = body("tube");
  p.axial_position     = 1.;
  const BodyPatch tube = create_body(p);
  BOOST_TEST(same(tube.patch.point({{0., 0.}}).y, 1.02));
  BOOST_TEST(same(tube.patch.point({{1., 0.}}).y, 1.));
  BOOST_TEST(same(tube.patch.point({{0., 0.}}).r, 0.005));
  BOOST_TEST(tube.axis_sides.empty());

  const BodyPatch rod = create_body(body("rod"));
  BOOST_REQUIRE(rod.axis_sides.size() == 1);
  BOOST_CHECK(rod.axis_sides[0] == Side::theta2_0);

  p                       = body("hollow sphere");
  p.section               = "quarter";
  const BodyPatch quarter = create_body(p);
  BOOST_TEST(quarter.wet_sides.size() == 2);
  BOOST_TEST(quarter.axis_sides.size() == 1);
  for (int k = 0; k <= 20; ++k)
    {
      const Point x = quarter.patch.point({{k / 20., 0.3}});
      BOOST_TEST(same(std::hypot(x.r, x.y), 0.0065, 1e-14));
      BOOST_TEST(x.y >= -1e-17);
    }
  BOOST_TEST(create_body(body("hollow sphere")).axis_sides.size() == 2);
}

BOOST_AUTO_TEST_CASE(curves_have_their_area_and_normals)
{
  CurveParameters spheroid = curve("spheroid");
  spheroid.half_height     = 0.004;
  const double e           = std::sqrt(1. - 0.16); // oblate
  const double oblate =
    2. * pi * 1e-4 * (1. + (1. - e * e) / e * std::atanh(e));
  CurveParameters half                                = spheroid;
  half.shape                                          = "hemi-ellipsoid";
  const std::pair<CurveParameters, double> expected[] = {
    {curve("disk"), pi * 1e-4},
    {curve("cylinder"), 2. * pi * 0.01 * 0.02},
    {curve("sphere"), 4. * pi * 1e-4},
    {spheroid, oblate},
    {half, oblate / 2.},
    {curve("torus"), 4. * pi * pi * 0.02 * 0.005}};
  for (const auto &[p, area] : expected)
    BOOST_TEST_CONTEXT(p.shape)
    {
      const BodyCurve c = create_curve(p);
      BOOST_TEST(c.curve.knot_vector(0).n_elements() == 8);
      BOOST_TEST(same(area_of_revolution(c.curve, 15), area, 1e-9));
      BOOST_TEST(c.closed == (p.shape == "torus"));
      // Normals point away from the middle of the body.
      const Point middle{p.shape == "torus" ? 0.02 : 0.,
                         p.shape == "disk" ? -1. : 0.};
      for (int k = 0; k <= 10; ++k)
        {
          const Point x = c.curve.point({{k / 10.}});
          const Point n =
            outward_normal(c.curve.tangents({{k / 10.}})[0], c.reversed);
          BOOST_TEST((x.r - middle.r) * n.r + (x.y - middle.y) * n.y > 0.);
        }
    }
}

BOOST_AUTO_TEST_CASE(outlines_are_exact)
{
  CurveParameters p     = curve("torus");
  p.axial_position      = 2.;
  const BodyCurve torus = create_curve(p);
  for (int k = 0; k <= 100; ++k)
    {
      const Point x = torus.curve.point({{k / 100.}});
      BOOST_TEST(same(std::hypot(x.r - 0.02, x.y - 2.), 0.005, 1e-12));
      const Point s = create_curve(curve("sphere")).curve.point({{k / 100.}});
      BOOST_TEST(same(std::hypot(s.r, s.y), 0.01, 1e-14));
      BOOST_TEST(s.r >= 0.);
    }
  const Point a = torus.curve.point({{0.}}), b = torus.curve.point({{1.}});
  BOOST_TEST(a.r == b.r);
  BOOST_TEST(a.y == b.y);
}

BOOST_AUTO_TEST_CASE(bad_shapes_are_refused)
{
  const auto refuse_body = [](const BodyParameters &p,
                              const std::string    &text) {
    BOOST_CHECK_EXCEPTION(create_body(p), InputError, [&](const InputError &e) {
      return std::string(e.what()).find(text) != std::string::npos;
    });
  };
  BodyParameters p = body("tube");
  p.inner_radius   = 0.02;
  refuse_body(p, "not less than the outer one");
  p        = body("tube");
  p.length = -1;
  refuse_body(p, "length of the tube is -1 m");
  p              = body("tube");
  p.inner_radius = -0.001;
  refuse_body(p, "inner radius of the tube is -0.001 m");
  p                       = body("hollow sphere");
  p.discretization.degree = {{1, 1}};
  refuse_body(p, "exactly from degree 2 on");
  refuse_body(body("cube"), "no body of the shape 'cube'");
  CurveParameters c = curve("torus");
  c.core_radius     = 0.03;
  BOOST_CHECK_THROW(create_curve(c), InputError);
  c        = curve("sphere");
  c.radius = 0.;
  BOOST_CHECK_THROW(create_curve(c), InputError);
}

BOOST_AUTO_TEST_CASE(ties)
{
  const NurbsPatch<2>    tube = create_body(body("tube")).patch;
  const std::vector<int> map =
    tied_control_points(tube, Side::theta1_1, Side::theta1_0);
  const int across = tube.n_basis(1), along = tube.n_basis(0);
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j)
      BOOST_TEST(map[i * across + j] == (i == along - 1 ? j : i * across + j));
  BOOST_CHECK_THROW(tied_control_points(create_body(body("bell")).patch,
                                        Side::theta1_1,
                                        Side::theta1_0),
                    InputError);
  BOOST_CHECK_THROW(tied_control_points(tube, Side::theta1_1, Side::theta2_0),
                    InputError);
}

BOOST_AUTO_TEST_CASE(parameters_from_a_file)
{
  ParameterHandler prm;
  BodyParameters::declare(prm);
  prm.read_text("set Shape = bell\n"
                "set Axial position = 0.1 m\n"
                "set Degree = 2, 3\n"
                "set Elements = 12, 4\n"
                "subsection Bell\n"
                "  set Radius = 2 cm\n"
                "  set Flap length = 0.2\n"
                "end\n",
                "test");
  prm.throw_errors();
  BodyParameters p;
  p.parse(prm);
  BOOST_TEST(p.shape == "bell");
  BOOST_TEST(p.axial_position == 0.1);
  BOOST_TEST(p.discretization.degree[0] == 2);
  BOOST_TEST(p.discretization.n_elements[1] == 4);
  BOOST_TEST(same(p.bell.radius, 0.02));
  BOOST_TEST(p.bell.flap_length == 0.2);
  BOOST_TEST(p.bell.inner_height == BellParameters().inner_height);

  ParameterHandler of_curve;
  CurveParameters::declare(of_curve);
  of_curve.read_text("set Shape = torus\nset Ring radius = 3 cm\n", "test");
  of_curve.throw_errors();
  CurveParameters c;
  c.parse(of_curve);
  BOOST_TEST(c.shape == "torus");
  BOOST_TEST(same(c.ring_radius, 0.03));
  BOOST_TEST(c.core_radius == CurveParameters().core_radius);
}

BOOST_AUTO_TEST_SUITE_END()
