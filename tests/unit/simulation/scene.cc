#include "ephyra/simulation/scene.h"

#include <boost/test/unit_test.hpp>

using namespace ephyra;
using namespace ephyra::simulation;

BOOST_AUTO_TEST_SUITE(scene)

namespace
{
  Scene
  parsed(const std::vector<std::string> &overrides)
  {
    ParameterHandler prm;
    Scene::declare(prm);
    for (const std::string &assignment : overrides)
      prm.set_override(assignment);
    Scene scene;
    scene.parse(prm);
    prm.throw_errors();
    return scene;
  }
} // namespace

BOOST_AUTO_TEST_CASE(refinement_divides_cells_and_time_steps)
{
  const Scene flow  = parsed({"Scene/Refinement = 4",
                              "Time/Time step = 8 ms",
                              "Fluid/Grid/Radial spacings = 0.1",
                              "Fluid/Grid/Axial spacings = 0.2"});
  const auto  exact = boost::test_tools::tolerance(1e-14);
  BOOST_TEST(flow.time.time_step == 2e-3, exact);
  BOOST_TEST(flow.fluid.grid.r.spacings.at(0) == 0.025, exact);
  BOOST_TEST(flow.fluid.grid.y.spacings.at(0) == 0.05, exact);
}

BOOST_AUTO_TEST_CASE(refinement_multiplies_elements)
{
  const Scene body = parsed({"Scene/Physics = elasticity",
                             "Scene/Refinement = 0.5",
                             "Body/Elements = 10, 3"});
  BOOST_TEST(body.body.discretization.n_elements[0] == 5);
  BOOST_TEST(body.body.discretization.n_elements[1] == 2);
  const Scene line = parsed({"Scene/Physics = electrophysiology",
                             "Scene/Refinement = 2",
                             "Tissue/Elements = 30",
                             "Electrophysiology/Time step = 5 us"});
  BOOST_TEST(line.tissue_line.discretization.n_elements[0] == 60);
  BOOST_TEST(line.tissue.time_step == 2.5e-6,
             boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_SUITE_END()
