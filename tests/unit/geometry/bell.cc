#include "ephyra/geometry/bell.h"

#include "ephyra/base/exceptions.h"
#include "measures.h"

#include <boost/test/unit_test.hpp>

using namespace ephyra;
using namespace ephyra::geometry;
using namespace ephyra::tests;

namespace
{
  const double pi = std::acos(-1.);

  double
  speed(const NurbsPatch<2> &patch, const double theta1, const double theta2)
  {
    const Point g = patch.tangents({{theta1, theta2}})[0];
    return std::hypot(g.r, g.y);
  }
} // namespace

BOOST_AUTO_TEST_SUITE(bell)

BOOST_AUTO_TEST_CASE(subumbrella_is_the_line_of_the_bell)
{
  const BellParameters p;
  const double         a      = p.radius;
  const double         center = 0.2 - p.outer_height * a;
  const BodyPatch      body   = make_bell(p, 0.2, {});
  const BodyCurve      line   = make_subumbrella(
    p.inner_radius * a, p.inner_height * a, p.flap_length * a, center, {});
  for (int k = 0; k <= 100; ++k)
    {
      const Point x = line.curve.point({{k / 100.}});
      const Point y = body.patch.point({{k / 100., 0.}});
      BOOST_TEST(std::abs(x.r - y.r) < 1e-14);
      BOOST_TEST(std::abs(x.y - y.y) < 1e-14);
    }
}

BOOST_AUTO_TEST_CASE(outlines_are_exact)
{
  const BellParameters p;
  const double         a = p.radius, joint = p.joint();
  const double         center = 0.2 - 0.8 * a;
  const BodyPatch      body   = make_bell(p, 0.2, {});
  BOOST_TEST(body.patch.n_control_points() == (35 + 3 + 2) * (6 + 3));
  BOOST_TEST(std::abs(joint - 0.89) < 1e-3);
  for (int k = 0; k <= 1000; ++k)
    {
      const double t     = k / 1000.;
      const Point  inner = body.patch.point({{t, 0.}});
      const Point  outer = body.patch.point({{t, 1.}});
      const auto   ellipse =
        [&](const Point &x, const double ar, const double b) {
          return std::pow(x.r / ar, 2) + std::pow((x.y - center) / b, 2) - 1.;
        };
      if (t <= joint)
        {
          BOOST_TEST(std::abs(ellipse(inner, 0.948 * a, 0.46 * a)) < 1e-13);
          BOOST_TEST(std::abs(ellipse(outer, a, 0.8 * a)) < 1e-13);
        }
      else
        {
          BOOST_TEST(std::abs(inner.r - 0.948 * a) < 1e-13 * a);
          BOOST_TEST(std::abs(outer.r - a) < 1e-13 * a);
        }
      const Point axis = body.patch.point({{0., t}});
      BOOST_TEST(axis.r == 0.);
      BOOST_TEST(std::abs(axis.y - (center + (0.46 + 0.34 * t) * a)) <
                 1e-13 * a);
      // Arc of radius 0.036 a through the ends of the flap.
      const Point  margin = body.patch.point({{1., t}});
      const double height =
        std::sqrt(0.036 * 0.036 - 0.026 * 0.026) * a - 0.14 * a + center;
      BOOST_TEST(std::abs(std::hypot(margin.r - 0.974 * a, margin.y - height) -
                          0.036 * a) < 1e-13 * a);
      BOOST_TEST(margin.y <= center - 0.14 * a + 1e-15);
    }
  BOOST_TEST(std::abs(body.patch.point({{0., 1.}}).y - 0.2) < 1e-16);
  BOOST_TEST(std::abs(body.patch.point({{1., 1.}}).y - (center - 0.14 * a)) <
             1e-15);
}

BOOST_AUTO_TEST_CASE(sides)
{
  const BodyPatch body = make_bell({}, 0., {});
  BOOST_REQUIRE(body.axis_sides.size() == 1);
  BOOST_CHECK(body.axis_sides[0] == Side::theta1_0);
  BOOST_REQUIRE(body.wet_sides.size() == 3);
  BOOST_CHECK(body.wet_sides[0].side == Side::theta2_0);
  BOOST_CHECK(body.wet_sides[1].side == Side::theta1_1);
  BOOST_CHECK(body.wet_sides[2].side == Side::theta2_1);
  BOOST_TEST(!body.wet_sides[0].reversed);
  BOOST_TEST(!body.wet_sides[1].reversed);
  BOOST_TEST(body.wet_sides[2].reversed);
  // Outwards: down into the cavity, down at the margin, up at the apex.
  for (const WetSide &wet : body.wet_sides)
    {
      const auto   side = body.patch.side(wet.side);
      const double t    = wet.side == Side::theta1_1 ? 0.5 : 0.1;
      const Point  n    = outward_normal(side.tangents({{t}})[0], wet.reversed);
      BOOST_TEST(std::abs(std::hypot(n.r, n.y) - 1.) < 1e-15);
      BOOST_TEST((wet.side == Side::theta2_1 ? n.y > 0.9 : n.y < -0.9));
    }
}

BOOST_AUTO_TEST_CASE(parametrisation)
{
  const BellParameters p;
  const BodyPatch      body   = make_bell(p, 0., {});
  double               low_in = 1, high_in = 0, low_out = 1, high_out = 0;
  for (int k = 0; k <= 2000; ++k)
    {
      const double in  = speed(body.patch, k / 2000., 0.);
      const double out = speed(body.patch, k / 2000., 1.);
      low_in           = std::min(low_in, in);
      high_in          = std::max(high_in, in);
      low_out          = std::min(low_out, out);
      high_out         = std::max(high_out, out);
    }
  BOOST_TEST_MESSAGE("|g1| inner " << low_in << " to " << high_in << ", outer "
                                   << low_out << " to " << high_out);
  // The numbers of the documentation, to their last digit.
  BOOST_TEST(std::abs(low_in - 15.7e-3) < 5e-5);
  BOOST_TEST(std::abs(high_in - 21.8e-3) < 5e-5);
  BOOST_TEST(std::abs(low_out - 19.2e-3) < 5e-5);
  BOOST_TEST(std::abs(high_out - 25.5e-3) < 5e-5);
  BOOST_TEST(std::abs(speed(body.patch, 0.97, 0.) - 19.2e-3) < 5e-5);

  double low_angle = 180, high_angle = 0, skew = 0;
  for (int k = 0; k <= 400; ++k)
    for (int l = 0; l <= 20; ++l)
      {
        const std::array<double, 2> theta{{k / 400., l / 20.}};
        const auto                  g = body.patch.tangents(theta);
        const double                j = g[0].r * g[1].y - g[0].y * g[1].r;
        BOOST_TEST(j > 0.);
        const double angle =
          std::atan2(j, g[0].r * g[1].r + g[0].y * g[1].y) * 180. / pi;
        if (theta[0] < p.joint())
          {
            low_angle  = std::min(low_angle, angle);
            high_angle = std::max(high_angle, angle);
            // How far the map across the body is from linear.
            const Point a = body.patch.point({{theta[0], 0.}}),
                        b = body.patch.point({{theta[0], 1.}}),
                        x = body.patch.point(theta);
            skew          = std::max(skew,
                            std::hypot(x.r - a.r - theta[1] * (b.r - a.r),
                                       x.y - a.y - theta[1] * (b.y - a.y)) /
                              std::hypot(b.r - a.r, b.y - a.y));
          }
      }
  BOOST_TEST_MESSAGE("angle of g1 and g2 " << low_angle << " to " << high_angle
                                           << ", deviation across " << skew);
  BOOST_TEST(low_angle > 85.5);
  BOOST_TEST(high_angle < 109.5);
  BOOST_TEST(skew < 0.065);
}

BOOST_AUTO_TEST_CASE(swept_volume)
{
  const double a = 0.015;
  // Half ellipsoids, flap, and the circular segment by Pappus' theorem.
  const double ellipsoids =
    2. / 3. * pi * a * a * a * (0.8 - 0.948 * 0.948 * 0.46);
  const double flap       = pi * a * a * a * (1. - 0.948 * 0.948) * 0.14;
  const double half_angle = std::asin(0.026 / 0.036);
  const double segment =
    0.036 * 0.036 * (half_angle - std::sin(half_angle) * std::cos(half_angle));
  const double exact =
    ellipsoids + flap + 2. * pi * 0.974 * segment * a * a * a;
  for (const auto &[p, n] : {std::pair(2, 4), std::pair(3, 20)})
    {
      const BodyPatch body = make_bell({}, 0., {{{p, p}}, {{n, 6}}});
      const double    v    = volume_of_revolution(body.patch, 10);
      BOOST_TEST(std::abs(v / exact - 1.) < 1e-9);
    }
}

BOOST_AUTO_TEST_CASE(refinement_keeps_the_bell)
{
  const BodyPatch coarse = make_bell({}, 0., {{{2, 2}}, {{2, 1}}});
  const BodyPatch fine   = make_bell({}, 0., {{{5, 4}}, {{35, 6}}});
  double          worst  = 0;
  for (int k = 0; k <= 200; ++k)
    for (int l = 0; l <= 10; ++l)
      {
        const Point a = coarse.patch.point({{k / 200., l / 10.}}),
                    b = fine.patch.point({{k / 200., l / 10.}});
        worst         = std::max(worst, std::hypot(a.r - b.r, a.y - b.y));
      }
  BOOST_TEST(worst < 1e-14 * 0.03);
}

BOOST_AUTO_TEST_CASE(elements_on_both_sides_of_the_joint)
{
  const BodyPatch body    = make_bell({}, 0., {});
  const auto     &breaks  = body.patch.knot_vector(0).breaks();
  const double    joint   = BellParameters().joint();
  int             on_flap = 0;
  for (std::size_t e = 0; e + 1 < breaks.size(); ++e)
    on_flap += breaks[e] >= joint;
  BOOST_TEST(body.patch.knot_vector(0).n_elements() == 35);
  BOOST_TEST(body.patch.knot_vector(1).n_elements() == 6);
  BOOST_TEST(on_flap == 4);
}

BOOST_AUTO_TEST_CASE(bad_bells_are_refused)
{
  const auto refuse = [](const auto change, const std::string &text) {
    BellParameters p;
    change(p);
    BOOST_CHECK_EXCEPTION(
      make_bell(p, 0., {}), InputError, [&](const InputError &e) {
        return std::string(e.what()).find(text) != std::string::npos;
      });
  };
  refuse([](BellParameters &p) { p.inner_height = 0.9; }, "not inside");
  refuse([](BellParameters &p) { p.inner_radius = 1.; }, "not inside");
  refuse([](BellParameters &p) { p.flap_length = -0.1; },
         "flap length of the bell is -0.1");
  refuse([](BellParameters &p) { p.margin_radius = 0.02; }, "at least 0.02652");
  refuse([](BellParameters &p) { p.radius = std::nan(""); }, "positive");
  BOOST_CHECK_THROW(make_bell({}, 0., {{{1, 2}}, {{4, 2}}}), InputError);
  BOOST_CHECK_THROW(make_bell({}, 0., {{{2, 2}}, {{1, 2}}}), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
