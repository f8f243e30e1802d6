#include "ephyra/coupling/acceleration.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra::coupling;

namespace
{
  // A linear fixed point x = A x + b whose plain iteration diverges by a
  // factor of three (eigenvalues of A from -3 to 0.5), with a drifting b.
  struct FixedPoint
  {
    static constexpr int n = 12;
    std::vector<double>
    operator()(const std::vector<double> &x, const double shift) const
    {
      std::vector<double> y(n);
      for (int i = 0; i < n; ++i)
        y[i] = (-3. + 3.5 * i / (n - 1)) * x[i] + 0.1 * x[(i + 1) % n] +
               std::sin(i + 1. + shift);
      return y;
    }
  };

  int
  iterations(Acceleration &acceleration, const double shift, const int limit)
  {
    const FixedPoint    map;
    std::vector<double> x(FixedPoint::n, 0.);
    acceleration.start_step();
    for (int k = 1; k <= limit; ++k)
      {
        const auto y        = map(x, shift);
        double     residual = 0;
        for (int i = 0; i < FixedPoint::n; ++i)
          residual += (y[i] - x[i]) * (y[i] - x[i]);
        if (std::sqrt(residual) < 1e-8)
          {
            acceleration.finish_step(true);
            return k;
          }
        x = acceleration.next(x, y);
      }
    acceleration.finish_step(false);
    return limit + 1;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(acceleration)

BOOST_AUTO_TEST_CASE(quasi_newton_solves_a_linear_fixed_point_in_n_steps)
{
  Acceleration::Parameters parameters;
  parameters.filter       = 1e-10;
  const auto acceleration = make_acceleration(parameters);
  BOOST_TEST(iterations(*acceleration, 0., 100) <= FixedPoint::n + 3);
  // What was learnt is used in the next step.
  BOOST_TEST(iterations(*acceleration, 0.1, 100) <= 4);
}

BOOST_AUTO_TEST_CASE(aitken_converges_where_plain_iteration_diverges)
{
  Acceleration::Parameters parameters;
  parameters.type         = "Aitken";
  const auto acceleration = make_acceleration(parameters);
  BOOST_TEST(iterations(*acceleration, 0., 300) <= 300);

  parameters.type               = "relaxation";
  parameters.initial_relaxation = 1.;
  const auto plain              = make_acceleration(parameters);
  BOOST_TEST(iterations(*plain, 0., 100) > 100);
}

BOOST_AUTO_TEST_SUITE_END()
