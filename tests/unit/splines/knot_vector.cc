#include "ephyra/splines/knot_vector.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/splines/quadrature.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra;
using namespace ephyra::splines;

BOOST_AUTO_TEST_SUITE(knot_vector)

BOOST_AUTO_TEST_CASE(partition_of_unity_and_support)
{
  for (int p = 1; p <= 6; ++p)
    {
      const KnotVector    kv = KnotVector::uniform(p, 5);
      std::vector<double> values(3 * (p + 1));
      BOOST_TEST(kv.n_basis() == p + 5);
      BOOST_TEST(kv.n_elements() == 5);
      for (int k = 0; k <= 50; ++k)
        {
          const double x     = k / 50.;
          const int    first = kv.evaluate(x, 2, values.data());
          BOOST_TEST(first == kv.first_basis(kv.element_of(x)));
          double sum[3] = {0, 0, 0};
          for (int d = 0; d < 3; ++d)
            for (int a = 0; a <= p; ++a)
              sum[d] += values[d * (p + 1) + a];
          BOOST_TEST(std::abs(sum[0] - 1.) < 1e-14);
          BOOST_TEST(std::abs(sum[1]) < 1e-12);
          BOOST_TEST(std::abs(sum[2]) < 1e-10);
          for (int a = 0; a <= p; ++a)
            BOOST_TEST(values[a] >= 0.);
        }
    }
}

BOOST_AUTO_TEST_CASE(bernstein_values)
{
  // One element: Bernstein polynomials, with known values and derivatives.
  const KnotVector    kv(3, {0, 0, 0, 0, 1, 1, 1, 1});
  std::vector<double> v(4 * 5);
  const double        x = 0.3, y = 1 - x;
  kv.evaluate(x, 4, v.data());
  const double expected[] = {y * y * y,
                             3 * x * y * y,
                             3 * x * x * y,
                             x * x * x,
                             -3 * y * y,
                             3 * y * y - 6 * x * y,
                             6 * x * y - 3 * x * x,
                             3 * x * x,
                             6 * y,
                             -12 * y + 6 * x,
                             6 * y - 12 * x,
                             6 * x,
                             -6,
                             18,
                             -18,
                             6};
  for (int i = 0; i < 16; ++i)
    BOOST_TEST(std::abs(v[i] - expected[i]) < 1e-14);
  for (int i = 16; i < 20; ++i)
    BOOST_TEST(v[i] == 0.); // derivative above the degree
}

BOOST_AUTO_TEST_CASE(derivatives_by_finite_differences)
{
  const KnotVector kv(3, {0, 0, 0, 0, 0.2, 0.5, 0.5, 0.9, 1, 1, 1, 1});
  const double     h = 1e-5;
  for (const double x : {0.07, 0.33, 0.6, 0.97})
    {
      double v[12], lower[12], upper[12];
      kv.evaluate(x, 2, v);
      kv.evaluate(x - h, 2, lower);
      kv.evaluate(x + h, 2, upper);
      for (int i = 0; i < 8; ++i)
        BOOST_TEST(std::abs((upper[i] - lower[i]) / (2 * h) - v[4 + i]) <
                   2e-5 * (1 + std::abs(v[4 + i])));
    }
}

BOOST_AUTO_TEST_CASE(greville_reproduces_the_parameter)
{
  const KnotVector    kv(2, {0, 0, 0, 0.3, 0.4, 0.4, 1, 1, 1});
  const auto          greville = kv.greville();
  std::vector<double> v(3);
  for (int k = 0; k <= 20; ++k)
    {
      const int first = kv.evaluate(k / 20., 0, v.data());
      double    sum   = 0;
      for (int a = 0; a < 3; ++a)
        sum += v[a] * greville[first + a];
      BOOST_TEST(std::abs(sum - k / 20.) < 1e-15);
    }
}

BOOST_AUTO_TEST_CASE(elements)
{
  const KnotVector kv(2, {0, 0, 0, 0.3, 0.4, 0.4, 1, 1, 1});
  BOOST_TEST(kv.n_elements() == 3);
  BOOST_TEST(kv.element_of(0.) == 0);
  BOOST_TEST(kv.element_of(0.3) == 1);
  BOOST_TEST(kv.element_of(0.4) == 2);
  BOOST_TEST(kv.element_of(1.) == 2);
  BOOST_TEST(kv.first_basis(2) == 3);
  BOOST_CHECK_THROW(kv.element_of(1.1), InputError);
  BOOST_CHECK_THROW(kv.element_of(std::nan("")), InputError);
}

BOOST_AUTO_TEST_CASE(bad_knots_are_refused)
{
  BOOST_CHECK_THROW(KnotVector(2, {0, 0, 0, 1, 1}), InputError);
  BOOST_CHECK_THROW(KnotVector(2, {0, 0, 0.1, 0.5, 1, 1, 1}), InputError);
  BOOST_CHECK_THROW(KnotVector(2, {0, 0, 0, 0.6, 0.5, 1, 1, 1}), InputError);
  BOOST_CHECK_THROW(KnotVector(2, {0, 0, 0, .5, .5, .5, 1, 1, 1}), InputError);
  BOOST_CHECK_THROW(KnotVector(1, {0, 0, std::nan(""), 1, 1}), InputError);
  BOOST_CHECK_THROW(KnotVector(0, {0, 1}), InputError);
  BOOST_CHECK_THROW(KnotVector::uniform(2, 0), InputError);
}

BOOST_AUTO_TEST_CASE(gauss_rules_are_exact)
{
  for (int n = 1; n <= 40; ++n)
    {
      const Quadrature rule = gauss_legendre(n);
      for (int k = 0; k < 2 * n; ++k)
        {
          double sum = 0;
          for (int q = 0; q < n; ++q)
            sum += rule.weights[q] * std::pow(rule.points[q], k);
          BOOST_TEST(std::abs(sum - 1. / (k + 1)) < 2e-15);
        }
      double beyond = 0;
      for (int q = 0; q < n; ++q)
        beyond += rule.weights[q] * std::pow(rule.points[q], 2 * n);
      if (n < 5)
        BOOST_TEST(std::abs(beyond - 1. / (2 * n + 1)) > 1e-6);
    }
  BOOST_CHECK_THROW(gauss_legendre(0), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
