#include "ephyra/geometry/patch_file.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"
#include "ephyra/geometry/shapes.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>

using namespace ephyra;
using namespace ephyra::geometry;

namespace
{
  /// A file that lives as long as the object, one for each rank.
  class TemporaryFile
  {
  public:
    explicit TemporaryFile(const std::string &text)
      : name("patch_file_test_" + std::to_string(mpi::rank(MPI_COMM_WORLD)) +
             ".txt")
    {
      std::ofstream(name) << text;
    }
    ~TemporaryFile()
    {
      std::remove(name.c_str());
    }
    const std::string name;
  };

  const std::string quarter_ring = "# a quarter of a ring\n"
                                   "dimension 2\n"
                                   "unit mm\n"
                                   "degree 2 1\n"
                                   "knots 0 0 0 1 1 1\n"
                                   "knots 0 0 1 1\n"
                                   "dry theta1_1\n"
                                   "control_points\n"
                                   "0 10 1   # on the axis\n"
                                   "0 20 1\n"
                                   "\n"
                                   "10 10 0.70710678118654752\n"
                                   "20 20 0.70710678118654752\n"
                                   "10 0 1\n"
                                   "20 0 1\n";

  void
  refuse(const std::string &from,
         const std::string &to,
         const std::string &text)
  {
    std::string       changed = quarter_ring;
    const std::size_t at      = changed.find(from);
    BOOST_REQUIRE(at != std::string::npos);
    changed.replace(at, from.size(), to);
    const TemporaryFile file(changed);
    BOOST_CHECK_EXCEPTION(
      read_patch_file(file.name), InputError, [&](const InputError &e) {
        return std::string(e.what()).find(text) != std::string::npos;
      });
  }
} // namespace

BOOST_AUTO_TEST_SUITE(patch_file)

BOOST_AUTO_TEST_CASE(body_from_a_file)
{
  const TemporaryFile file(quarter_ring);
  BodyParameters      p;
  p.shape                     = "file";
  p.file_name                 = file.name;
  p.axial_position            = 1.;
  p.discretization.n_elements = {{4, 2}};
  const BodyPatch body        = create_body(p);
  BOOST_TEST(body.wet_sides.size() == 2);
  BOOST_TEST(body.axis_sides.size() == 1);
  for (int k = 0; k <= 10; ++k)
    {
      const Point x = body.patch.point({{k / 10., 0.5}});
      BOOST_TEST(std::abs(std::hypot(x.r, x.y - 1.) - 0.015) < 1e-15);
    }
  CurveParameters c;
  c.shape     = "file";
  c.file_name = file.name;
  BOOST_CHECK_THROW(create_curve(c), InputError);
}

BOOST_AUTO_TEST_CASE(curve_from_a_file)
{
  const TemporaryFile file("dimension 1\ndegree 1\nknots 0 0 1 1\nreversed\n"
                           "control_points\n1 0 1\n3 4 1\n");
  CurveParameters     c;
  c.shape           = "file";
  c.file_name       = file.name;
  const BodyCurve x = create_curve(c);
  BOOST_TEST(x.reversed);
  BOOST_TEST(!x.closed);
  BOOST_TEST(std::abs(x.curve.point({{0.5}}).r - 2.) < 1e-14);
}

BOOST_AUTO_TEST_CASE(bad_files_are_refused)
{
  refuse("dimension 2", "dimension 3", ":2: the dimension must be 1 or 2");
  refuse("unit mm", "unit inch", ":3: the unit must be m, cm or mm");
  refuse("degree", "degre", ":4: 'degre' is none of");
  refuse("knots 0 0 1 1\n", "knots 0 1 1\n", ":6: A knot vector of degree 1");
  refuse("knots 0 0 1 1\n", "", "one line 'knots' is needed");
  refuse("theta1_1", "theta3_1", ":7: 'theta3_1' is no side");
  refuse("10 0 1\n", "", "ask for 6 control points, but the file holds 5");
  refuse("10 0 1\n", "10 0\n", "a control point is a line 'r y weight'");
  refuse("10 0 1\n", "10 O 1\n", "a number was expected");
  refuse("10 0 1\n", "10 0 -1\n", "weight of a control point must be positive");
  BOOST_CHECK_THROW(read_patch_file("no/such/file"), InputError);

  // Folded: two corners exchanged.
  const TemporaryFile file("dimension 2\ndegree 1 1\nknots 0 0 1 1\n"
                           "knots 0 0 1 1\ncontrol_points\n"
                           "1 1 1\n1 2 1\n2 2 1\n2 1 1\n");
  BodyParameters      p;
  p.shape     = "file";
  p.file_name = file.name;
  BOOST_CHECK_EXCEPTION(create_body(p), InputError, [](const InputError &e) {
    return std::string(e.what()).find("folded") != std::string::npos;
  });
}

BOOST_AUTO_TEST_SUITE_END()
