// Exact solutions that depend on r (and t) alone, in a pipe of radius 1.
#include "exact_flows.h"

#include <boost/test/unit_test.hpp>

#include <complex>

using namespace exact_flows;

namespace
{
  const Component zero = [](double, double) { return 0.; };

  /// First zero of J0: J0(2.404826 r) decays at the rate 5.783186 nu.
  constexpr double bessel_root = 2.404825557695773;

  double
  bessel_mode_error(const int              n,
                    const int              n_steps,
                    const TimeScheme       scheme,
                    const ViscousTreatment viscous)
  {
    constexpr double nu = 0.2, end_time = 0.5;
    FlowParameters   parameters = unit_pipe(n, 4. / n, nu);
    parameters.scheme           = scheme;
    parameters.viscous          = viscous;
    FlowSolver flow(parameters, MPI_COMM_WORLD);
    const auto exact = [](const double t) {
      return [t](const double r, double) {
        return std::cyl_bessel_j(0, bessel_root * r) *
               std::exp(-bessel_root * bessel_root * nu * t);
      };
    };
    flow.set_initial_velocity(zero, exact(0));
    run(flow, end_time, n_steps);
    return relative_error(flow, zero, exact(end_time));
  }
} // namespace

BOOST_AUTO_TEST_SUITE(pipe_flows)

BOOST_AUTO_TEST_CASE(bessel_mode)
{
  double previous = 0;
  for (const int n : {8, 16, 32})
    {
      const double error =
        bessel_mode_error(n, n, TimeScheme::rk3, ViscousTreatment::implicit);
      BOOST_TEST_MESSAGE("n = " << n << ": error " << error << ", order "
                                << std::log2(previous / error));
      if (previous > 0)
        BOOST_TEST(std::log2(previous / error) > 1.9);
      previous = error;
    }
  BOOST_TEST(previous < 1e-3);
}

BOOST_AUTO_TEST_SUITE_END()
