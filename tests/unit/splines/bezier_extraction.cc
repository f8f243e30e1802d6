#include "ephyra/splines/bezier_extraction.h"

#include "ephyra/base/exceptions.h"
#include "test_patches.h"

#include <boost/test/unit_test.hpp>

using namespace ephyra;
using namespace ephyra::splines;
using namespace ephyra::tests;

namespace
{
  /// Value of a rational Bézier cell at local coordinates, by Bernstein
  /// polynomials written out.
  double
  bezier_value(const std::vector<double> &coefficients,
               const std::vector<double> &weights,
               const int                  element,
               const int                  p0,
               const int                  p1,
               const double               x,
               const double               y)
  {
    const auto bernstein = [](const int b, const int p, const double t) {
      double result = std::pow(t, b) * std::pow(1 - t, p - b);
      for (int k = 1; k <= b; ++k)
        result *= (p - b + k) / static_cast<double>(k);
      return result;
    };
    double above = 0, below = 0;
    int    k = element * (p0 + 1) * (p1 + 1);
    for (int b1 = 0; b1 <= p1; ++b1)
      for (int b0 = 0; b0 <= p0; ++b0, ++k)
        {
          const double value =
            bernstein(b0, p0, x) * bernstein(b1, p1, y) * weights[k];
          above += value * coefficients[k];
          below += value;
        }
    return above / below;
  }

  std::vector<double>
  coordinates(const std::vector<Point> &points)
  {
    std::vector<double> x;
    for (const Point &point : points)
      x.insert(x.end(), {point.r, point.y});
    return x;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(bezier_extraction)

BOOST_AUTO_TEST_CASE(cells_are_the_patch)
{
  const NurbsPatch<2> patch =
    annulus().with_elevated_degree(0, 1).with_split_elements(0, 3);
  const BezierExtraction<2> extraction(patch);
  BezierOutput              out;
  extraction.write_cells(out, coordinates(patch.control_points()));
  BOOST_TEST(out.parametric_dimension == 2);
  BOOST_TEST(out.degree[0] == 3);
  BOOST_TEST(out.degree[1] == 2);
  BOOST_TEST(extraction.n_points() == 6 * 12);
  const auto &b0 = patch.knot_vector(0).breaks();
  const auto &b1 = patch.knot_vector(1).breaks();
  for (int e0 = 0; e0 < 3; ++e0)
    for (int e1 = 0; e1 < 2; ++e1)
      for (const double x : {0., 0.3, 1.})
        for (const double y : {0., 0.8})
          {
            const Point expected =
              patch.point({{b0[e0] + x * (b0[e0 + 1] - b0[e0]),
                            b1[e1] + y * (b1[e1 + 1] - b1[e1])}});
            const int e = 2 * e0 + e1;
            BOOST_TEST(std::abs(bezier_value(out.r, out.weight, e, 3, 2, x, y) -
                                expected.r) < 1e-14);
            BOOST_TEST(std::abs(bezier_value(out.y, out.weight, e, 3, 2, x, y) -
                                expected.y) < 1e-14);
          }
}

BOOST_AUTO_TEST_CASE(curves)
{
  const NurbsPatch<1>       curve = wavy_curve();
  const BezierExtraction<1> extraction(curve);
  const std::vector<double> x =
    extraction.extract(coordinates(curve.control_points()), 2);
  BOOST_TEST(extraction.n_points() == 12);
  std::vector<double> r;
  for (std::size_t b = 0; b < x.size(); b += 2)
    r.push_back(x[b]);
  const auto &breaks = curve.knot_vector(0).breaks();
  for (int e = 0; e < 3; ++e)
    for (const double t : {0., 0.4, 1.})
      {
        const double theta = breaks[e] + t * (breaks[e + 1] - breaks[e]);
        BOOST_TEST(
          std::abs(bezier_value(r, extraction.weights(), e, 3, 0, t, 0.) -
                   curve.point({{theta}}).r) < 1e-14);
      }
  BOOST_CHECK_THROW(extraction.extract(x, 1), InputError);
}

BOOST_AUTO_TEST_CASE(samples_are_interpolated)
{
  // The samples of the coordinates give back their Bézier coefficients.
  const NurbsPatch<2>       patch = annulus().with_split_elements(0, 2);
  const BezierExtraction<2> extraction(patch);
  std::vector<double>       samples;
  for (const auto &theta : extraction.sample_points())
    {
      const Point x = patch.point(theta);
      samples.insert(samples.end(), {x.r, x.y});
    }
  const auto expected =
    extraction.extract(coordinates(patch.control_points()), 2);
  const auto found = extraction.interpolate(samples, 2);
  BOOST_REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    BOOST_TEST(std::abs(found[i] - expected[i]) < 1e-12);
}

BOOST_AUTO_TEST_CASE(fields_of_an_output)
{
  const NurbsPatch<1>       arc = quarter_circle();
  const BezierExtraction<1> extraction(arc);
  BezierOutput              out;
  extraction.write_field(out, "v [V]", {1, 2, 3}, 1);
  const std::vector<double> expected{1, 2, 3};
  BOOST_REQUIRE(out.point_fields.size() == 1);
  BOOST_TEST(out.point_fields[0].name == "v [V]");
  BOOST_TEST(out.point_fields[0].values == expected);
}

BOOST_AUTO_TEST_SUITE_END()
