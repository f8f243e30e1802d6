#include "cases.h"

#include "reference_table.h"

#include <cmath>

using namespace ephyra;
using namespace ephyra::test;

// The sphere of ten Cate et al. 2002 (10.1063/1.1512918) in a closed cylinder of
// radius 50 mm, against a body-fitted program (see the reference files).

BOOST_AUTO_TEST_SUITE(settling_sphere)

namespace
{
  constexpr double D = 0.015; ///< m

  struct Fluid
  {
    double density, viscosity;
  };

  RigidCase
  make(const Fluid &fluid, const int n)
  {
    const double          h = D / n;
    fluid::FlowParameters flow;
    flow.density            = fluid.density;
    flow.viscosity          = fluid.viscosity;
    flow.grid.r.breakpoints = {0., 0.0125, 0.05};
    flow.grid.r.spacings    = {h, h, h + 0.05 * 0.0375};
    flow.grid.y.breakpoints = {0., 0.16};
    flow.grid.y.spacings    = {h};
    immersed_boundary::RigidBody::Parameters sphere;
    sphere.name     = "sphere";
    sphere.radius   = 0.5 * D;
    sphere.position = 8.5 * D;
    sphere.density  = 1120.;
    sphere.gravity  = -9.81;
    sphere.motion   = immersed_boundary::RigidBody::Motion::free;
    return RigidCase(flow, {sphere});
  }

  double
  gap(const RigidCase &c)
  {
    return c.rigid->body(0).position / D - 0.5;
  }

  /// Settles down to a gap of 0.2 D; errors relative to the largest speed and
  /// to the height of the fall.
  void
  compare_history(const std::string &file, const Fluid &fluid, const int n)
  {
    const auto reference = read_reference("sphere_settling/" + file);
    double     largest   = 0;
    for (const auto &row : reference)
      largest = std::max(largest, -row[2]);

    RigidCase    c = make(fluid, n);
    const double dt =
      std::min(0.9 * c.flow.viscous_time_step_limit(), 0.15 * D / n / largest);
    double speed = 0, gap_error = 0, speed_error = 0;
    for (const auto &row : reference)
      {
        if (row[1] < 0.2)
          break;
        double before_gap = gap(c), before = c.rigid->body(0).velocity;
        while (c.time < row[0])
          {
            before_gap = gap(c);
            before     = c.rigid->body(0).velocity;
            c.step(dt);
            speed = std::max(speed, -c.rigid->body(0).velocity);
          }
        const double s = (c.time - row[0]) / dt;
        gap_error      = std::max(
          gap_error, std::abs(s * before_gap + (1 - s) * gap(c) - row[1]));
        speed_error = std::max(
          speed_error,
          std::abs(s * before + (1 - s) * c.rigid->body(0).velocity - row[2]));
      }
    BOOST_TEST_MESSAGE(file << ", " << n << " cells: largest speed "
                            << 100 * (speed / largest - 1)
                            << " %, history of the speed "
                            << 100 * speed_error / largest << " %, of the gap "
                            << 100 * gap_error / 8 << " %");
    BOOST_TEST(std::abs(speed / largest - 1) < 0.01);
    BOOST_TEST(gap_error / 8 < 0.01);
    BOOST_TEST(speed_error / largest < 0.05);
  }
} // namespace

BOOST_AUTO_TEST_CASE(largest_speed_at_reynolds_32)
{
  RigidCase c       = make({960., 0.058}, 16);
  double    largest = 0;
  while (c.time < 0.75)
    {
      c.step(2e-3);
      largest = std::max(largest, -c.rigid->body(0).velocity);
    }
  BOOST_TEST_MESSAGE("largest speed " << largest << " m/s");
  BOOST_TEST(std::abs(largest / 0.12092 - 1) < 0.02);
}

BOOST_AUTO_TEST_CASE(long_histories)
{
  compare_history("Re31.9.csv", {960., 0.058}, 32);
  compare_history("Re11.6.csv", {962., 0.113}, 32);
  compare_history("Re4.1.csv", {965., 0.212}, 24);
}

BOOST_AUTO_TEST_SUITE_END()
