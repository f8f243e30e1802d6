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
    double by_forcing, by_probes, slip;
  };

  Drag
  run(const int                            n,
      const double                         end,
      const double                         outer,
      const double                         upstream,
      const double                         downstream,
      const immersed_boundary::Parameters &parameters = {})
  {
    RigidCase    c(stream(100., n, outer, upstream, downstream),
                {unit_sphere()},
                parameters);
    const double dt = 0.5 / n;
    while (c.time < end)
      c.step(dt);
    return {c.rigid->force_by_forcing(0) / unit_of_drag,
            c.force_by_probes() / unit_of_drag,
            c.rigid->no_slip_error().slip};
  }
} // namespace

BOOST_AUTO_TEST_CASE(reynolds_100)
{
  const Drag drag = run(20, 20., 12., 8., 16.);
  BOOST_TEST_MESSAGE("Cd by forcing " << drag.by_forcing << ", by probes "
                                      << drag.by_probes << ", slip "
                                      << drag.slip);
  BOOST_TEST(std::abs(drag.by_forcing / reference - 1) < 0.05);
  BOOST_TEST(std::abs(drag.by_probes / reference - 1) < 0.05);
}

BOOST_AUTO_TEST_SUITE_END()
