#include "ephyra/electrophysiology/prescribed_activation.h"

#include "ephyra/base/exceptions.h"

#include <boost/test/unit_test.hpp>

using ephyra::electrophysiology::PrescribedActivation;

BOOST_AUTO_TEST_SUITE(prescribed_activation)

BOOST_AUTO_TEST_CASE(formula_in_place_and_time_with_a_period)
{
  PrescribedActivation::Parameters prm;
  prm.formula = "s + 10*t";
  prm.period  = 2;
  const PrescribedActivation activation(prm);
  std::vector<double>        gamma;
  activation.evaluate({0.25, 0.5}, 4.1, gamma);
  BOOST_TEST(gamma[0] == 1.25, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(gamma[1] == 1.5, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(table_is_linear_between_and_constant_outside)
{
  PrescribedActivation::Parameters prm;
  prm.times  = {1., 2., 4.};
  prm.values = {0., 1., 0.5};
  const PrescribedActivation activation(prm);
  BOOST_TEST(activation.value(0., 0.) == 0.);
  BOOST_TEST(activation.value(0., 1.25) == 0.25);
  BOOST_TEST(activation.value(0., 3.) == 0.75);
  BOOST_TEST(activation.value(0., 9.) == 0.5);
}

BOOST_AUTO_TEST_CASE(bad_tables_are_refused)
{
  PrescribedActivation::Parameters prm;
  prm.times  = {1., 1.};
  prm.values = {0., 1.};
  BOOST_CHECK_THROW(PrescribedActivation{prm}, ephyra::InputError);
  prm.times = {1.};
  BOOST_CHECK_THROW(PrescribedActivation{prm}, ephyra::InputError);
}

BOOST_AUTO_TEST_SUITE_END()
