// Tubes and spheres under pressure: formulas of Lamé for small strain, and
// solutions for finite strain that were computed with another program.
#include "elasticity_patches.h"

#include "ephyra/elasticity/statics.h"
#include "ephyra/splines/patch_quadrature.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <functional>

using namespace ephyra;
using namespace ephyra::elasticity;
using splines::Side;

namespace
{
  Expression
  formula(const double value)
  {
    std::ostringstream text;
    text.precision(17);
    text << value;
    return Expression(text.str(), SideCondition::variables);
  }

  SideCondition &
  side(StaticsSolver::Parameters &prm, const Side s)
  {
    return prm.body.sides[static_cast<int>(s)];
  }

  /// Ends that do not move along the axis: plane strain.
  void
  hold_ends(StaticsSolver::Parameters &prm)
  {
    side(prm, Side::theta1_0).fixed = {{false, true}};
    side(prm, Side::theta1_1).fixed = {{false, true}};
  }

  splines::Point
  value(const splines::NurbsPatch<2> &patch,
        const std::vector<double>    &u,
        const double                  theta1,
        const double                  theta2)
  {
    splines::BasisValues<2> basis;
    patch.evaluate_basis({theta1, theta2}, basis);
    splines::Point x;
    for (std::size_t a = 0; a < basis.index.size(); ++a)
      {
        x.r += basis.value[a] * u[2 * basis.index[a]];
        x.y += basis.value[a] * u[2 * basis.index[a] + 1];
      }
    return x;
  }

  /// Error of a displacement in L2 of the body, relative.
  double
  l2_error(const splines::NurbsPatch<2>                        &patch,
           const std::vector<double>                           &u,
           const std::function<splines::Point(splines::Point)> &exact)
  {
    const int                         n = patch.degree(0) + 4;
    const splines::PatchQuadrature<2> quadrature(patch, {{n, n}});
    double                            error = 0., norm = 0.;
    for (int e = 0; e < quadrature.n_elements(); ++e)
      for (int q = 0; q < quadrature.n_points(); ++q)
        {
          const auto           theta = quadrature.theta(e, q);
          const splines::Point x     = patch.point(theta);
          const auto           g     = patch.tangents(theta);
          const double         w     = quadrature.weight(e, q) * x.r *
                           std::abs(g[0].r * g[1].y - g[0].y * g[1].r);
          const splines::Point computed = value(patch, u, theta[0], theta[1]);
          const splines::Point wanted   = exact(x);
          error += w * (std::pow(computed.r - wanted.r, 2) +
                        std::pow(computed.y - wanted.y, 2));
          norm += w * (wanted.r * wanted.r + wanted.y * wanted.y);
        }
    return std::sqrt(error / norm);
  }

  // Appendix A.2 of Nitti et al. 2023: E = 100 MPa, nu = 0.3, p = 0.1 MPa.
  const double E = 1e8, nu = 0.3, p = 1e5, Ri = 0.5, Ro = 1.;

  splines::Point
  lame_tube(const splines::Point &x)
  {
    return {p * Ri * Ri * (1. + nu) * (Ro * Ro + x.r * x.r * (1. - 2. * nu)) /
              (E * (Ro * Ro - Ri * Ri) * x.r),
            0.};
  }

  splines::Point
  lame_sphere(const splines::Point &x)
  {
    const double R = std::hypot(x.r, x.y), d = Ro * Ro * Ro - Ri * Ri * Ri;
    const double u =
      -p * Ro * Ro * Ro * (1. - 2. * nu) * R / (E * d) -
      p * Ri * Ri * Ri * Ro * Ro * Ro * (1. + nu) / (2. * E * d * R * R);
    return {u * x.r / R, u * x.y / R};
  }

  /// Errors on meshes of n, 2n elements and the order between them.
  void
  check_order(const std::function<double(int)> &error,
              const int                         n,
              const int                         degree,
              const std::string                &what)
  {
    const double coarse = error(n), fine = error(2 * n);
    const double order = std::log2(coarse / fine);
    BOOST_TEST_MESSAGE(what << ", degree " << degree << ": L2 errors " << coarse
                            << ", " << fine << ", order " << order);
    BOOST_TEST(order > degree + 0.85);
  }
} // namespace

BOOST_AUTO_TEST_SUITE(pressure_vessels)

BOOST_AUTO_TEST_CASE(thick_tube_small_strain)
{
  for (int degree = 2; degree <= 4; ++degree)
    check_order(
      [&](const int n) {
        StaticsSolver::Parameters prm;
        prm.body.material              = Material::from_young(E, nu);
        prm.body.material.small_strain = true;
        hold_ends(prm);
        side(prm, Side::theta2_0).pressure = formula(p);
        const auto    patch = test::tube(Ri, Ro, 1., degree, {1, n});
        StaticsSolver solver(prm, patch, MPI_COMM_WORLD);
        const auto    result = solver.run();
        BOOST_TEST(result.success);
        if (n == 16 && degree == 4)
          {
            const double expected[] = {9.53333e-4, 7.07778e-4, 6.06667e-4};
            for (int k = 0; k < 3; ++k)
              BOOST_TEST(value(patch, solver.displacement(), 0.3, 0.5 * k).r ==
                           expected[k],
                         boost::test_tools::tolerance(1e-6));
          }
        return l2_error(patch, solver.displacement(), lame_tube);
      },
      degree == 2 ? 4 : 16,
      degree,
      "thick tube");
}

BOOST_AUTO_TEST_CASE(hollow_sphere_small_strain)
{
  for (int degree = 2; degree <= 4; ++degree)
    check_order(
      [&](const int n) {
        StaticsSolver::Parameters prm;
        prm.body.material                  = Material::from_young(E, nu);
        prm.body.material.small_strain     = true;
        side(prm, Side::theta1_1).fixed    = {{false, true}};
        side(prm, Side::theta2_1).pressure = formula(p);
        const auto    patch = test::hollow_sphere(Ri, Ro, degree, {n, n});
        StaticsSolver solver(prm, patch, MPI_COMM_WORLD);
        const auto    result = solver.run();
        BOOST_TEST(result.success);
        if (n == 16 && degree == 4)
          {
            // At R = 0.5, 0.75 and 1, on the axis and on the equator.
            const double expected[] = {-6.0e-4, -5.07937e-4, -5.5e-4};
            for (int k = 0; k < 3; ++k)
              {
                BOOST_TEST(value(patch, solver.displacement(), 0., 0.5 * k).y ==
                             expected[k],
                           boost::test_tools::tolerance(1e-5));
                BOOST_TEST(value(patch, solver.displacement(), 1., 0.5 * k).r ==
                             expected[k],
                           boost::test_tools::tolerance(1e-5));
              }
          }
        return l2_error(patch, solver.displacement(), lame_sphere);
      },
      degree == 2 ? 4 : 16,
      degree,
      "hollow sphere");
}

BOOST_AUTO_TEST_CASE(inflated_tube_finite_strain)
{
  struct Case
  {
    Material material;
    double   pressure;
    bool     follower;
    double   inner, outer;
  };
  const Case cases[] = {
    {{.5, 1000., false}, .2, true, .113615663, .075533786},
    {{.5, 1000., false}, .2, false, .090508816, .059493237},
    {{400., 5e4, false}, 100., true, .061943516, .040287704}};
  for (const Case &c : cases)
    {
      StaticsSolver::Parameters prm;
      prm.body.material    = c.material;
      prm.newton.tolerance = 1e-11;
      prm.n_steps          = 2;
      hold_ends(prm);
      auto &inner         = side(prm, Side::theta2_0);
      inner.pressure      = formula(c.pressure);
      inner.follower      = c.follower;
      const auto    patch = test::tube(.5, .8, .1, 4, {1, 16});
      StaticsSolver solver(prm, patch, MPI_COMM_WORLD);
      BOOST_TEST(solver.run().success);
      BOOST_TEST(value(patch, solver.displacement(), .5, 0.).r == c.inner,
                 boost::test_tools::tolerance(1e-6));
      BOOST_TEST(value(patch, solver.displacement(), .5, 1.).r == c.outer,
                 boost::test_tools::tolerance(1e-6));
    }
}

BOOST_AUTO_TEST_CASE(active_tube)
{
  // Hoop 1 - g and radial 1/(1 - g) in the whole wall, free surfaces.
  struct Case
  {
    Material material;
    double   g, a, b, tolerance;
  };
  const Case cases[] = {{{400., 5e4, false}, .1, .422546728, .754018360, 1e-6},
                        // incompressible limit, approached as 1/K
                        {{400., 4e8, false}, .1, .422551595, .754022447, 1e-6},
                        {{400., 4e8, false}, .2, .345088370, .713502616, 1e-6}};
  for (const Case &c : cases)
    {
      StaticsSolver::Parameters prm;
      prm.body.material           = c.material;
      prm.body.active_strain.form = ActiveStrain::Form::unit_directors;
      prm.body.active_strain.a3   = c.g;
      prm.body.active_strain.pattern.emplace(
        "1", std::vector<std::string>{"theta1", "theta2"});
      prm.newton.tolerance = 1e-11;
      prm.n_steps          = 4;
      hold_ends(prm);
      const auto    patch = test::tube(.5, .8, .1, 4, {1, 16});
      StaticsSolver solver(prm, patch, MPI_COMM_WORLD);
      const auto    result = solver.run([](double, std::vector<double> &gamma) {
        gamma.assign(gamma.size(), 1.);
      });
      BOOST_TEST(result.success, result.reason);
      BOOST_TEST(.5 + value(patch, solver.displacement(), .5, 0.).r == c.a,
                 boost::test_tools::tolerance(c.tolerance));
      BOOST_TEST(.8 + value(patch, solver.displacement(), .5, 1.).r == c.b,
                 boost::test_tools::tolerance(c.tolerance));
    }
}

BOOST_AUTO_TEST_CASE(uniaxial_tension_of_a_rod)
{
  // c10 = 400, K = 5e4 Pa stretched to 1.5; the rod touches the axis.
  StaticsSolver::Parameters prm;
  prm.newton.tolerance                      = 1e-12;
  prm.n_steps                               = 4;
  side(prm, Side::theta1_0).fixed           = {{false, true}};
  side(prm, Side::theta1_1).fixed           = {{false, true}};
  side(prm, Side::theta1_1).displacement[1] = formula(.5);
  const auto    patch                       = test::tube(0., .3, 1., 2, {2, 2});
  StaticsSolver solver(prm, patch, MPI_COMM_WORLD);
  const auto    result = solver.run();
  BOOST_TEST(result.success, result.reason);
  const auto radius = value(patch, solver.displacement(), .4, 1.);
  BOOST_TEST(1. + radius.r / .3 == .8182035373,
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(solver.fields(.4, .6).cauchy[3] == 1255.66278,
             boost::test_tools::tolerance(1e-8));
}

BOOST_AUTO_TEST_SUITE_END()
