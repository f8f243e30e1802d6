#include "cases.h"

#include <cmath>

using namespace ephyra;
using namespace ephyra::test;

// Steady flow past a sphere at Re = 100: Cd = 1.089 (FreeFem++ P2-P1, body
// fitted, domain -20 ... 40 D by 30 D, free slip outside). Clift, Grace & Weber
// 1978 give the same to 1 %.
constexpr double reference = 1.089;

BOOST_AUTO_TEST_SUITE(sphere_drag)

namespace
{
  struct Drag
  {
    double                               by_forcing, by_probes;
    immersed_boundary::RigidFlow::NoSlip at_points, on_surface;
  };

  Drag
  run(const int    n,
      const double end,
      const double outer,
      const double upstream,
      const double downstream,
      const double reynolds = 100.)
  {
    RigidCase    c(stream(reynolds, n, outer, upstream, downstream),
                {unit_sphere()});
    const double dt = std::min(0.5 / n, 0.9 * c.flow.viscous_time_step_limit());
    while (c.time < end)
      c.step(dt);
    return {c.rigid->force_by_forcing(0) / unit_of_drag,
            c.force_by_probes() / unit_of_drag,
            c.rigid->no_slip_error(),
            c.rigid->no_slip_error_on_surface()};
  }
} // namespace

BOOST_AUTO_TEST_CASE(reynolds_100)
{
  const Drag drag = run(20, 20., 12., 8., 16.);
  BOOST_TEST_MESSAGE("Cd by forcing " << drag.by_forcing << ", by probes "
                                      << drag.by_probes);
  BOOST_TEST(std::abs(drag.by_forcing / reference - 1) < 0.02);
  BOOST_TEST(std::abs(drag.by_probes / reference - 1) < 0.05);
}

// No-slip errors and the distance of the two drags under refinement, in a small
// domain: the drag itself is not that of the reference.
BOOST_AUTO_TEST_CASE(refinement)
{
  const Drag coarse = run(12, 8., 4., 3., 6.), fine = run(36, 8., 4., 3., 6.);
  const auto order = [](const double a, const double b) {
    return std::log(a / b) / std::log(3.);
  };
  const double slip = order(coarse.at_points.slip, fine.at_points.slip);
  const double leakage =
    order(coarse.at_points.leakage, fine.at_points.leakage);
  const double slip_on_surface =
    order(coarse.on_surface.slip, fine.on_surface.slip);
  const double leakage_on_surface =
    order(coarse.on_surface.leakage, fine.on_surface.leakage);
  BOOST_TEST_MESSAGE(
    "12 and 36 cells: slip "
    << coarse.at_points.slip << ", " << fine.at_points.slip << ", order "
    << slip << "; leakage " << coarse.at_points.leakage << ", "
    << fine.at_points.leakage << ", order " << leakage
    << "; on the surface slip " << coarse.on_surface.slip << ", "
    << fine.on_surface.slip << ", order " << slip_on_surface << "; leakage "
    << coarse.on_surface.leakage << ", " << fine.on_surface.leakage
    << ", order " << leakage_on_surface << "; Cd by forcing "
    << coarse.by_forcing << ", " << fine.by_forcing << ", by probes "
    << coarse.by_probes << ", " << fine.by_probes);
  BOOST_TEST(slip > 0.8);
  BOOST_TEST(leakage > 0.7);
  BOOST_TEST(slip_on_surface > 1.);
  BOOST_TEST(leakage_on_surface > 1.);
  BOOST_TEST(std::abs(fine.by_forcing - fine.by_probes) <
             0.5 * std::abs(coarse.by_forcing - coarse.by_probes));
  BOOST_TEST(std::abs(fine.by_forcing / fine.by_probes - 1) < 0.02);
}

BOOST_AUTO_TEST_CASE(long_reynolds_100_on_the_domain_of_the_reference)
{
  for (const int n : {16, 24, 32, 48})
    {
      const Drag drag = run(n, 40., 30., 20., 40.);
      BOOST_TEST_MESSAGE(n << " cells: Cd by forcing " << drag.by_forcing
                           << ", by probes " << drag.by_probes << ", slip "
                           << drag.at_points.slip);
      BOOST_TEST(std::abs(drag.by_forcing / reference - 1) < 0.01);
      BOOST_TEST(std::abs(drag.by_probes / reference - 1) < 0.5 / n);
    }
}

// Cd = 2.722 at Re = 20 by the same program.
BOOST_AUTO_TEST_CASE(long_reynolds_20)
{
  const Drag drag = run(32, 40., 30., 20., 40., 20.);
  BOOST_TEST_MESSAGE("Cd by forcing " << drag.by_forcing << ", by probes "
                                      << drag.by_probes);
  BOOST_TEST(std::abs(drag.by_forcing / 2.722 - 1) < 0.02);
  BOOST_TEST(std::abs(drag.by_probes / 2.722 - 1) < 0.03);
}

BOOST_AUTO_TEST_SUITE_END()
