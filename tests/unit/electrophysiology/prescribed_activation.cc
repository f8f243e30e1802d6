#include "ephyra/electrophysiology/prescribed_activation.h"

#include "ephyra/base/exceptions.h"

#include <boost/test/unit_test.hpp>

using ephyra::electrophysiology::PrescribedActivation;

BOOST_AUTO_TEST_SUITE(prescribed_activation)

BOOST_AUTO_TEST_CASE(profile_times_course)
{
  PrescribedActivation::Parameters prm;
  prm.profile = "s + t";
  prm.course  = "2*t";
  const PrescribedActivation activation(prm);
  std::vector<double>        gamma;
  activation.evaluate({0.25, 0.5}, 3., gamma);
  BOOST_TEST(gamma[0] == 3.25 * 6., boost::test_tools::tolerance(1e-12));
  BOOST_TEST(gamma[1] == 3.5 * 6., boost::test_tools::tolerance(1e-12));
  BOOST_TEST(activation.value(0.5, 3.) == gamma[1]);
}

BOOST_AUTO_TEST_CASE(bad_formulas_are_refused)
{
  PrescribedActivation::Parameters prm;
  prm.profile = "s + u";
  BOOST_CHECK_THROW(PrescribedActivation{prm}, ephyra::InputError);
}

BOOST_AUTO_TEST_SUITE_END()
