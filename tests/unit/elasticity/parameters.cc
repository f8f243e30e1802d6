#include "ephyra/base/exceptions.h"
#include "ephyra/base/parameter_handler.h"
#include "ephyra/elasticity/elasticity_solver.h"
#include "ephyra/elasticity/statics.h"

#include <boost/test/unit_test.hpp>

using namespace ephyra;
using namespace ephyra::elasticity;

namespace
{
  template <typename Parameters>
  Parameters
  parsed(const std::string &text)
  {
    ParameterHandler prm;
    Parameters::declare(prm);
    prm.read_text(text, "test.prm");
    prm.throw_errors();
    Parameters parameters;
    parameters.parse(prm);
    prm.throw_errors();
    return parameters;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(parameters)

BOOST_AUTO_TEST_CASE(defaults)
{
  const auto prm = parsed<ElasticitySolver::Parameters>("");
  BOOST_TEST(prm.body.material.c10 == 400.);
  BOOST_TEST(prm.body.material.K == 5e4);
  BOOST_TEST(prm.body.density == 1000.);
  BOOST_TEST(prm.body.active_strain.a3 == 0.096);
  BOOST_TEST(prm.body.active_strain.length == 0.03);
  BOOST_TEST(prm.body.active_strain.cut_end == 0.25);
  BOOST_TEST(!prm.body.sides[0].loaded());
  BOOST_TEST(prm.rho_infinity == 0.5);
  BOOST_TEST(prm.newton.max_iterations == 30);
}

BOOST_AUTO_TEST_CASE(entries_of_a_body)
{
  const auto prm = parsed<ElasticitySolver::Parameters>(R"(
    set Moduli = Young and Poisson
    set Young modulus = 100 MPa
    set Poisson ratio = 0.3
    set Small strain = true
    set Axial body force = 9.81*1000
    subsection Active strain
      set Form = paper metric
      set Coronal amplitude = 0.134
      set Pattern = theta2*(1 - theta1)
    end
    subsection Side theta1_0
      set Fixed components = both
      set Axial displacement = 0.1*t
    end
    subsection Side theta2_1
      set Pressure = 2 kPa
      set Pressure acts on = reference surface
      set Radial traction = r*sin(t)
    end
    )");
  BOOST_TEST(prm.body.material.shear_modulus() == 1e8 / 2.6,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(prm.body.material.small_strain);
  BOOST_TEST(prm.body.body_force[1]({1., 2., 3.}) == 9810.);
  BOOST_TEST((*prm.body.active_strain.pattern)({0.25, 0.5}) == 0.375);
  BOOST_TEST(prm.body.sides[0].fixed[0]);
  BOOST_TEST(prm.body.sides[0].displacement[1]({0., 0., 0., 2.}) == 0.2);
  BOOST_TEST(prm.body.sides[3].pressure({0., 0., 0., 0.}) == 2000.);
  BOOST_TEST(!prm.body.sides[3].follower);
}

BOOST_AUTO_TEST_CASE(entries_of_statics)
{
  const auto prm = parsed<StaticsSolver::Parameters>(
    "subsection Statics\nset Load steps = 7\nend");
  BOOST_TEST(prm.n_steps == 7);
  BOOST_TEST(prm.ramp);
}

BOOST_AUTO_TEST_CASE(contradictions_are_reported)
{
  const auto fails = [](const std::string &text, const std::string &message) {
    BOOST_CHECK_EXCEPTION(parsed<ElasticitySolver::Parameters>(text),
                          InputError,
                          [&](const InputError &e) {
                            return std::string(e.what()).find(message) !=
                                   std::string::npos;
                          });
  };
  fails("set Poisson ratio = 0.3", "not used");
  fails("set Moduli = Young and Poisson\nset Poisson ratio = 0.5",
        "Poisson ratio");
  fails("set c10 = -1", "c10");
  fails("subsection Side theta1_0\nset Radial displacement = 1\nend", "free");
  fails("subsection Side theta1_0\nset Fixed components = r\n"
        "set Radial traction = 1\nend",
        "no effect");
  fails("subsection Active strain\nset Pattern = theta3\nend", "theta3");
  fails("subsection Active strain\nset Axis cut = 0.3, 0.1\nend", "Axis cut");
}

BOOST_AUTO_TEST_SUITE_END()
