#include "ephyra/elasticity/active_strain.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra;
using namespace ephyra::elasticity;

namespace
{
  const ReferenceFrame skewed{{0.004, 0.018}, {0.002, -0.003}, 0.012};

  ActiveStrain::Parameters
  parameters(const ActiveStrain::Form form, const double a1, const double a3)
  {
    ActiveStrain::Parameters prm;
    prm.form = form;
    prm.a1   = a1;
    prm.a3   = a3;
    return prm;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(active_strain)

BOOST_AUTO_TEST_CASE(keeps_the_volume)
{
  using Form = ActiveStrain::Form;
  for (const auto &prm : {parameters(Form::unit_directors, 0.3, 0.2),
                          parameters(Form::paper_metric, 0.05, 0.08)})
    {
      const AxisymmetricTensor F = ActiveStrain(prm).deformation(skewed, 0.7);
      BOOST_TEST(determinant(F) == 1., boost::test_tools::tolerance(1e-13));
      BOOST_TEST(F[1] == F[2]);
    }
}

BOOST_AUTO_TEST_CASE(unit_directors_shorten_by_the_amplitudes)
{
  const ActiveStrain active(
    parameters(ActiveStrain::Form::unit_directors, 0.3, 0.2));
  const AxisymmetricTensor F = active.deformation(skewed, 0.5);
  // The fibre g1 keeps its direction and shrinks by 0.15, the hoop by 0.1.
  BOOST_TEST(F[0] * 0.004 + F[1] * 0.018 == 0.85 * 0.004,
             boost::test_tools::tolerance(1e-13));
  BOOST_TEST(F[2] * 0.004 + F[3] * 0.018 == 0.85 * 0.018,
             boost::test_tools::tolerance(1e-13));
  BOOST_TEST(F[4] == 0.9, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(active.shortening(skewed, 0.5) == 0.15,
             boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(paper_metric_follows_equations_25_to_27)
{
  auto prm   = parameters(ActiveStrain::Form::paper_metric, 0.05, 0.08);
  prm.length = 0.03;
  const ActiveStrain       active(prm);
  const double             gamma = 0.7, L = 0.03;
  const AxisymmetricTensor F = active.deformation(skewed, gamma);

  // Metric in units of L; theta^3 is an angle.
  const double g11 =
    (skewed.g1.r * skewed.g1.r + skewed.g1.y * skewed.g1.y) / L / L;
  const double g22 =
    (skewed.g2.r * skewed.g2.r + skewed.g2.y * skewed.g2.y) / L / L;
  const double g12 =
    (skewed.g1.r * skewed.g2.r + skewed.g1.y * skewed.g2.y) / L / L;
  const double det = g11 * g22 - g12 * g12;
  const double G11 = g22 / det, G22 = g11 / det, G12 = -g12 / det;
  const double G33 = L * L / (skewed.r * skewed.r);
  const double a1 = 0.05, a3 = 0.08;
  const double gamma2 =
    -gamma * (a1 * G11 + a3 * G33 - gamma * a1 * a3 * G11 * G33) /
    ((gamma * a3 * G33 - 1.) *
     (gamma * a1 * G12 * G12 + G22 - gamma * a1 * G11 * G22));
  // F^ij = G^ij - gamma a1 G^1i G^1j + gamma2 G^2i G^2j, in base vectors.
  const double Fc[2][2] = {{G11 - gamma * a1 * G11 * G11 + gamma2 * G12 * G12,
                            G12 - gamma * a1 * G11 * G12 + gamma2 * G12 * G22},
                           {G12 - gamma * a1 * G11 * G12 + gamma2 * G12 * G22,
                            G22 - gamma * a1 * G12 * G12 + gamma2 * G22 * G22}};
  const double g[2][2]  = {{skewed.g1.r / L, skewed.g1.y / L},
                           {skewed.g2.r / L, skewed.g2.y / L}};
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      {
        double expected = 0.;
        for (int k = 0; k < 2; ++k)
          for (int l = 0; l < 2; ++l)
            expected += Fc[k][l] * g[k][i] * g[l][j];
        BOOST_TEST(std::abs(F[2 * i + j] - expected) < 1e-12);
      }
  BOOST_TEST(F[4] == 1. - gamma * a3 * G33,
             boost::test_tools::tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(both_forms_agree_without_radial_muscles)
{
  auto paper   = parameters(ActiveStrain::Form::paper_metric, 0., 0.08);
  paper.length = 0.03;
  const double         hoop = 0.08 * 0.03 * 0.03 / (skewed.r * skewed.r);
  const ActiveStrain   literal(paper);
  const ReferenceFrame straight{{0.004, 0.018}, {0.0018, -0.0004}, 0.012};
  const auto           F = literal.deformation(straight, 1.);
  const auto           U =
    ActiveStrain(parameters(ActiveStrain::Form::unit_directors, 0., hoop))
      .deformation(straight, 1.);
  for (int i = 0; i < 5; ++i)
    BOOST_TEST(std::abs(F[i] - U[i]) < 1e-13);
}

BOOST_AUTO_TEST_CASE(pattern_of_equation_30)
{
  const ActiveStrain active(
    parameters(ActiveStrain::Form::unit_directors, 0., 0.1));
  BOOST_TEST(active.pattern(0.55, 0.2) == 0.25);
  BOOST_TEST(active.pattern(0.9, 0.05) ==
               0.25 * (1. + std::tanh(6.)) * (1. + std::tanh(3.5)),
             boost::test_tools::tolerance(1e-13));

  auto cut = parameters(ActiveStrain::Form::paper_metric, 0., 0.1);
  BOOST_TEST(ActiveStrain(cut).pattern(0.1, 0.) == 0.);
  BOOST_TEST(ActiveStrain(cut).pattern(0.25, 0.) == active.pattern(0.25, 0.),
             boost::test_tools::tolerance(1e-13));
  cut.pattern.emplace("theta1*theta2",
                      std::vector<std::string>{"theta1", "theta2"});
  cut.cut_start = cut.cut_end = 0.;
  BOOST_TEST(ActiveStrain(cut).pattern(0.5, 0.5) == 0.25);
}

BOOST_AUTO_TEST_SUITE_END()
