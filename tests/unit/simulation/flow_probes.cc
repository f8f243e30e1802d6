#include "ephyra/simulation/flow_probes.h"

#include "ephyra/base/exceptions.h"

#include <boost/test/unit_test.hpp>

using namespace ephyra;
using namespace ephyra::simulation;

BOOST_AUTO_TEST_SUITE(flow_probes)

namespace
{
  /// Periodic, free slip at r = 1; v_y = r has no divergence.
  fluid::FlowParameters
  linear_flow()
  {
    fluid::FlowParameters p;
    p.density = p.viscosity  = 1.;
    p.grid.r.breakpoints     = {0., 1.};
    p.grid.r.spacings        = {0.1, 0.15};
    p.grid.y.breakpoints     = {0., 1.};
    p.grid.y.spacings        = {0.125};
    p.lower.kind             = fluid::SideKind::periodic;
    p.upper.kind             = fluid::SideKind::periodic;
    p.outer.kind             = fluid::SideKind::free_slip;
    p.initial_axial_velocity = "r";
    return p;
  }
} // namespace

BOOST_AUTO_TEST_CASE(linear_fields_are_interpolated_exactly)
{
  const fluid::FlowSolver flow(linear_flow(), MPI_COMM_WORLD);
  FlowSampling            sampling;
  for (const double r : {0.31, 0.5, 0.77})
    sampling.probes.push_back(
      {"at " + std::to_string(r), {{r, 0.4}}, {{r, 0.4}}, 0});
  FlowProbes probes(sampling, {}, flow.grid());
  Record     record;
  probes.add_results(flow, record);
  BOOST_REQUIRE(record.all().size() == 9u);
  for (std::size_t k = 0; k < sampling.probes.size(); ++k)
    {
      BOOST_TEST(std::abs(record.all()[3 * k].second) < 1e-12);
      BOOST_TEST(record.all()[3 * k + 1].second == sampling.probes[k].start[0],
                 boost::test_tools::tolerance(1e-12));
    }
  BOOST_TEST(record.all()[1].first == "at 0.310000 axial velocity [m/s]");
}

BOOST_AUTO_TEST_CASE(points_outside_of_the_grid_are_refused)
{
  const fluid::FlowSolver flow(linear_flow(), MPI_COMM_WORLD);
  FlowSampling            sampling;
  sampling.lines.push_back({"radius", {{0., 0.5}}, {{1.5, 0.5}}, 2});
  BOOST_CHECK_EXCEPTION(
    FlowProbes(sampling, {}, flow.grid()),
    InputError,
    [](const InputError &error) {
      return std::string(error.what()) ==
             "The point (r, y) = (1.5, 0.5) m of the flow probe or line "
             "'radius' is outside of the grid; move it or widen the grid.";
    });
}

BOOST_AUTO_TEST_SUITE_END()
