#include "cases.h"

#include <array>
#include <cmath>

using namespace ephyra;
using namespace ephyra::test;
using namespace ephyra::immersed_boundary;

// Drag by the probes against drag by the forcing in the same steady flow past a
// sphere, for all formulas and some probe lengths, under refinement. Small
// domain: the drag itself is not that of the reference.

BOOST_AUTO_TEST_SUITE(load_convergence)

namespace
{
  struct Formula
  {
    FrictionFormula friction;
    WallPressure    pressure;
    const char     *name;
  };
  const std::array<Formula, 5> formulas{
    {{FrictionFormula::one_point, WallPressure::acceleration, "one-point"},
     {FrictionFormula::quadratic, WallPressure::acceleration, "quadratic"},
     {FrictionFormula::extrapolated,
      WallPressure::acceleration,
      "extrapolated"},
     {FrictionFormula::quadratic, WallPressure::linear, "quadratic, linear"},
     {FrictionFormula::extrapolated,
      WallPressure::linear,
      "extrapolated, linear"}}};
  constexpr int               recommended = 3; ///< the automatic choice
  const std::array<double, 3> lengths{{1., 1.5, 2.}};

  /// By the probes over by the forcing, less one: [formula][length].
  using Table = std::array<std::array<double, 3>, 5>;

  Table
  differences(const int n, const double reynolds)
  {
    RigidCase    c(stream(reynolds, n, 4., 3., 6.), {unit_sphere()});
    const double dt = std::min(0.5 / n, 0.9 * c.flow.viscous_time_step_limit());
    while (c.time < 8.)
      c.step(dt);
    Table table;
    for (std::size_t f = 0; f < formulas.size(); ++f)
      for (std::size_t k = 0; k < lengths.size(); ++k)
        {
          Parameters p    = rigid_defaults();
          p.probe_length  = lengths[k];
          p.friction      = formulas[f].friction;
          p.wall_pressure = formulas[f].pressure;
          SurfaceLoads loads(
            c.flow.grid(), c.flow.density(), c.flow.viscosity(), p);
          loads.update(c.rigid->markers());
          loads.evaluate(
            c.rigid->markers(), c.flow.pressure(), c.flow.velocity());
          table[f][k] = loads.axial_force(c.rigid->markers(), 0, 1).total() /
                          c.rigid->force_by_forcing(0) -
                        1;
        }
    for (std::size_t f = 0; f < formulas.size(); ++f)
      BOOST_TEST_MESSAGE("Re " << reynolds << ", " << n << " cells, "
                               << formulas[f].name
                               << ": difference with probes of 1, 1.5, 2 cells "
                               << 100 * table[f][0] << ", " << 100 * table[f][1]
                               << ", " << 100 * table[f][2] << " %");
    return table;
  }
} // namespace

BOOST_AUTO_TEST_CASE(long_probes_against_forcing)
{
  for (const double reynolds : {20., 100.})
    {
      const Table coarse = differences(16, reynolds),
                  fine   = differences(64, reynolds);
      differences(32, reynolds);
      for (int k = 0; k < 3; ++k)
        {
          BOOST_TEST(std::abs(fine[recommended][k]) < 0.01);
          BOOST_TEST(
            std::log(std::abs(coarse[recommended][k] / fine[recommended][k])) /
              std::log(4.) >
            1.);
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()
