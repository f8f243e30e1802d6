// Stress and tangent against finite differences of the energy, against
// eqs. (15), (16) written out in three dimensions, and against the moduli.
#include "ephyra/elasticity/material.h"
#include "ephyra/elasticity/active_strain.h"

#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>

using namespace ephyra;
using namespace ephyra::elasticity;

namespace
{
  const AxisymmetricTensor some_F{1.2, 0.3, -0.2, 0.9, 0.8};

  AxisymmetricTensor
  product(const AxisymmetricTensor &A, const AxisymmetricTensor &B)
  {
    return {A[0] * B[0] + A[1] * B[2],
            A[0] * B[1] + A[1] * B[3],
            A[2] * B[0] + A[3] * B[2],
            A[2] * B[1] + A[3] * B[3],
            A[4] * B[4]};
  }

  AxisymmetricTensor
  transposed(const AxisymmetricTensor &A)
  {
    return {A[0], A[2], A[1], A[3], A[4]};
  }

  /// Central difference of fourth order of a function of one component of F.
  template <typename Function>
  double
  derivative(const Function &f, AxisymmetricTensor F, const int b)
  {
    const double h = 1e-3, x = F[b];
    const auto   at = [&](const double offset) {
      F[b] = x + offset;
      return f(F);
    };
    return (8. * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12. * h);
  }

  double
  entry(const AxisymmetricTensor &T, const int i, const int j)
  {
    return i < 2 && j < 2 ? T[2 * i + j] : i == 2 && j == 2 ? T[4] : 0.;
  }

  void
  check_derivatives(const Material &material)
  {
    const MaterialPoint point = evaluate(material, some_F);
    for (int b = 0; b < 5; ++b)
      {
        const double slope = derivative(
          [&](const AxisymmetricTensor &F) {
            return evaluate(material, F).energy;
          },
          some_F,
          b);
        BOOST_TEST(point.stress[b] == slope,
                   boost::test_tools::tolerance(1e-8));
        for (int a = 0; a < 5; ++a)
          {
            const double tangent = derivative(
              [&](const AxisymmetricTensor &F) {
                return evaluate(material, F).stress[a];
              },
              some_F,
              b);
            BOOST_TEST(std::abs(point.tangent[5 * a + b] - tangent) <
                       1e-8 * material.bulk_modulus());
          }
      }
  }
} // namespace

BOOST_AUTO_TEST_SUITE(material)

BOOST_AUTO_TEST_CASE(stress_and_tangent_are_derivatives_of_the_energy)
{
  check_derivatives(Material{400., 3000., false});
  check_derivatives(Material{400., 3000., true});
}

BOOST_AUTO_TEST_CASE(agrees_with_equations_15_and_16)
{
  const Material           m{400., 3000., false};
  const AxisymmetricTensor F = some_F;
  const AxisymmetricTensor C = product(transposed(F), F);
  const AxisymmetricTensor B = inverse(C);
  const double             J = determinant(F), I3 = J * J;
  const double             I1 = C[0] + C[3] + C[4];
  const double             i  = std::pow(I3, -1. / 3.);
  const auto G      = [](const int a, const int b) { return a == b ? 1. : 0.; };
  const auto stress = [&](const int a, const int b) {
    return 2. * m.c10 * i * (G(a, b) - I1 / 3. * entry(B, a, b)) +
           2. * m.K * entry(B, a, b) * (J * J - J);
  };
  const auto tangent = [&](int a, int b, int c, int d) {
    const double BB = entry(B, a, b) * entry(B, c, d);
    const double XX =
      entry(B, a, c) * entry(B, b, d) + entry(B, a, d) * entry(B, b, c);
    return -4. / 3. * m.c10 * i *
             (G(a, b) * entry(B, c, d) + G(c, d) * entry(B, a, b) -
              I1 / 3. * BB - 0.5 * I1 * XX) +
           2. * m.K * J * ((2. * J - 1.) * BB - (J - 1.) * XX);
  };

  const MaterialPoint      point = evaluate(m, F);
  const AxisymmetricTensor S     = product(inverse(F), point.stress);
  const int component[5][2]      = {{0, 0}, {0, 1}, {1, 0}, {1, 1}, {2, 2}};
  for (int a = 0; a < 5; ++a)
    {
      const int i1 = component[a][0], j1 = component[a][1];
      BOOST_TEST(std::abs(S[a] - stress(i1, j1)) < 1e-10 * m.K);
      for (int b = 0; b < 5; ++b)
        {
          const int k1 = component[b][0], l1 = component[b][1];
          double    expected = i1 == k1 ? stress(j1, l1) : 0.;
          for (int M = 0; M < 3; ++M)
            for (int N = 0; N < 3; ++N)
              expected +=
                entry(F, i1, M) * entry(F, k1, N) * tangent(M, j1, N, l1);
          BOOST_TEST(std::abs(point.tangent[5 * a + b] - expected) <
                     1e-10 * m.K);
        }
    }
}

BOOST_AUTO_TEST_CASE(small_strain_moduli)
{
  const Material m{400., 5e4, false};
  const double   E = 9. * m.bulk_modulus() * m.shear_modulus() /
                   (3. * m.bulk_modulus() + m.shear_modulus());
  const double nu = m.poisson_ratio();
  BOOST_TEST(nu == E / (2. * m.shear_modulus()) - 1.,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(E == 2393.6, boost::test_tools::tolerance(1e-4));
  BOOST_TEST(nu == 0.4960, boost::test_tools::tolerance(1e-4));
  const Material same = Material::from_young(E, nu);
  BOOST_TEST(same.c10 == m.c10, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(same.K == m.K, boost::test_tools::tolerance(1e-9));

  // Both laws have one tangent at rest.
  const AxisymmetricTensor rest{1., 0., 0., 1., 1.};
  const MaterialPoint      finite = evaluate(m, rest);
  const MaterialPoint      linear = evaluate(Material{400., 5e4, true}, rest);
  for (int k = 0; k < 25; ++k)
    BOOST_TEST(std::abs(finite.tangent[k] - linear.tangent[k]) < 1e-9 * m.K);
}

BOOST_AUTO_TEST_CASE(uniaxial_cauchy_stress)
{
  // Computed independently: lambda = 1.5, free to contract across.
  const Material           m{400., 5e4, false};
  const AxisymmetricTensor F{.8182035373, 0., 0., 1.5, .8182035373};
  const AxisymmetricTensor sigma = cauchy_stress(m, F);
  BOOST_TEST(sigma[3] == 1255.66278, boost::test_tools::tolerance(1e-8));
  BOOST_TEST(std::abs(sigma[0]) < 1e-4);
}

BOOST_AUTO_TEST_SUITE_END()
