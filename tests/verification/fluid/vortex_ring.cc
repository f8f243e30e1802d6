// Vortex ring of an impulsively started jet, eqs. (A.4) and (A.5) of
// 10.1016/j.apm.2023.08.003: Re = 3100, stroke 6, delta_w = 0.04, 15 D x 6 D.
// Circulation (all vorticity, units U D) computed with an independent MAC
// program at D/60 and D/120, which agree to 0.3 %: t = 1: .823, 2: 1.249,
// 4: 2.236, 6: 3.239, 8: 3.142; mean slope over 2 < t < 5: .497 +- .005.
#include "ephyra/fluid/flow_diagnostics.h"
#include "ephyra/fluid/flow_output.h"
#include "exact_flows.h"

#include <boost/test/unit_test.hpp>

using namespace exact_flows;

namespace
{
  FlowParameters
  ring(const int cells_per_diameter)
  {
    FlowParameters parameters;
    parameters.density            = 1.;
    parameters.viscosity          = 1. / 3100.;
    parameters.grid.r.breakpoints = {0., 6.};
    parameters.grid.y.breakpoints = {0., 15.};
    parameters.grid.r.spacings =
      parameters.grid.y.spacings    = {1. / cells_per_diameter};
    parameters.lower.kind           = SideKind::velocity;
    parameters.lower.axial_velocity = "0.5*(1 - tanh(2/0.04*(s - 0.5)))*"
                                      "(t < 0.3 ? 0.5*(1 - cos(pi*t/0.3)) : "
                                      "(t < 6 ? 1 : (t < 6.3 ? "
                                      "0.5*(1 + cos(pi*(t - 6)/0.3)) : 0)))";
    parameters.upper.kind           = SideKind::outflow;
    parameters.outer.kind           = SideKind::free_slip;
    return parameters;
  }

  /// int v_y (-d v_y/dr) dr over the inlet, the flux of vorticity that the
  /// jet carries: half the square of its largest velocity.
  double
  inlet_vorticity_flux(const FlowSolver &flow)
  {
    const StaggeredGrid &grid = flow.grid();
    double               flux = 0;
    for (int i = std::max(1, grid.first_row); i < grid.end_row(); ++i)
      flux += 0.5 * (flow.velocity().y(i - 1, 0) + flow.velocity().y(i, 0)) *
              (flow.velocity().y(i - 1, 0) - flow.velocity().y(i, 0));
    return mpi::sum(flux, MPI_COMM_WORLD);
  }
} // namespace

BOOST_AUTO_TEST_SUITE(vortex_ring)

BOOST_AUTO_TEST_CASE(start_of_the_jet)
{
  FlowSolver flow(ring(30), MPI_COMM_WORLD);
  flow.keep_predicted(false);
  run(flow, 1., 100);
  BOOST_TEST(circulation(flow.velocity()) == 0.823,
             boost::test_tools::tolerance(0.01));
  BOOST_TEST(inlet_vorticity_flux(flow) == 0.5,
             boost::test_tools::tolerance(0.004));
  BOOST_TEST(relative_divergence(flow.velocity()) < 1e-12);
}

BOOST_AUTO_TEST_CASE(long_stroke_six)
{
  const double dt = 0.005;
  FlowSolver   flow(ring(60), MPI_COMM_WORLD);
  flow.keep_predicted(false);
  std::vector<double> gamma(9, 0.);
  for (int step = 0; step < 1600; ++step)
    {
      flow.advance(step * dt, dt);
      if ((step + 1) % 200 == 0)
        gamma[(step + 1) / 200] = circulation(flow.velocity());
    }
  for (const auto &[time, expected] :
       {std::pair(1, 0.823), {2, 1.249}, {4, 2.236}, {6, 3.239}, {8, 3.142}})
    {
      BOOST_TEST_MESSAGE("t = " << time << ": circulation " << gamma[time]);
      BOOST_TEST(gamma[time] == expected, boost::test_tools::tolerance(0.005));
    }
  BOOST_TEST((gamma[5] - gamma[2]) / 3 == 0.497,
             boost::test_tools::tolerance(0.01));
}

BOOST_AUTO_TEST_SUITE_END()
