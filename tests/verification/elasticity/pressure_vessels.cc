// Tubes and spheres under pressure: formulas of Lamé for small strain, and
// solutions for finite strain that were computed with another program.
#include "elasticity_patches.h"
#include "field_errors.h"

#include "ephyra/elasticity/statics.h"

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

  // Appendix A.2 of Nitti et al. 2023: E = 100 MPa, nu = 0.3, p = 0.1 MPa.
  const double E = 1e8, nu = 0.3, p = 1e5, Ri = 0.5, Ro = 1.;

  /// u_r = A r + B/r.
  test::FieldValue
  lame_tube(const splines::Point &x)
  {
    const double f = p * Ri * Ri * (1. + nu) / (E * (Ro * Ro - Ri * Ri));
    const double A = f * (1. - 2. * nu), B = f * Ro * Ro;
    const double h = A + B / (x.r * x.r);
    return {{h * x.r, 0.}, {{A - B / (x.r * x.r), 0., 0., 0., h}}};
  }

  /// u_R = A R + B/R^2.
  test::FieldValue
  lame_sphere(const splines::Point &x)
  {
    const double f = -p * Ro * Ro * Ro / (E * (Ro * Ro * Ro - Ri * Ri * Ri));
    const double A = f * (1. - 2. * nu), B = f * Ri * Ri * Ri * (1. + nu) / 2.;
    const double R = std::hypot(x.r, x.y), h = A + B / (R * R * R);
    const double n[2] = {x.r / R, x.y / R};
    const auto   H    = [&](const int i, const int j) {
      return (i == j ? h : 0.) - 3. * B / (R * R * R) * n[i] * n[j];
    };
    return {{h * x.r, h * x.y}, {{H(0, 0), H(0, 1), H(1, 0), H(1, 1), h}}};
  }

  /// Errors on meshes of n, 2n elements and the orders between them.
  void
  check_orders(const std::function<test::FieldErrors(int)> &errors,
               const int                                    n,
               const int                                    degree,
               const std::string                           &what)
  {
    const auto   coarse = errors(n), fine = errors(2 * n);
    const double order  = std::log2(coarse.l2 / fine.l2);
    const double energy = std::log2(coarse.energy / fine.energy);
    BOOST_TEST_MESSAGE(what << ", degree " << degree << ", " << n << " and "
                            << 2 * n << " elements: L2 errors " << coarse.l2
                            << ", " << fine.l2 << ", order " << order
                            << "; energy " << coarse.energy << ", "
                            << fine.energy << ", order " << energy);
    BOOST_TEST(order > degree + 0.85);
    BOOST_TEST(energy > degree - 0.15);
  }

  /// A plane-strain tube .5 < R < .8 m with a known result.
  struct Tube
  {
    std::string               name;
    StaticsSolver::Parameters prm;
    double                    inner, outer;  ///< final radii, m
    bool                      displacements; ///< are compared, or the radii
  };

  Tube
  inflated(const Material &material,
           const double    pressure,
           const bool      follower,
           const double    inner,
           const double    outer)
  {
    Tube tube{follower ? "inflated tube, follower" : "inflated tube, dead load",
              {},
              .5 + inner,
              .8 + outer,
              true};
    tube.prm.body.material = material;
    auto &condition        = side(tube.prm, Side::theta2_0);
    condition.pressure     = formula(pressure);
    condition.follower     = follower;
    return tube;
  }

  /// Hoop 1 - g and radial 1/(1 - g) in the whole wall, free surfaces.
  Tube
  active(const Material &material,
         const double    g,
         const double    inner,
         const double    outer)
  {
    Tube tube{"active tube", {}, inner, outer, false};
    tube.prm.body.material           = material;
    tube.prm.body.active_strain.form = ActiveStrain::Form::unit_directors;
    tube.prm.body.active_strain.a3   = g;
    tube.prm.body.active_strain.pattern.emplace(
      "1", std::vector<std::string>{"theta1", "theta2"});
    return tube;
  }

  /// Final radii of both surfaces, m.
  std::array<double, 2>
  radii(Tube tube, const int degree, const int n)
  {
    tube.prm.newton.tolerance = 1e-11;
    tube.prm.n_steps          = 4;
    hold_ends(tube.prm);
    const auto    patch = test::tube(.5, .8, .1, degree, {1, n});
    StaticsSolver solver(tube.prm, patch, MPI_COMM_WORLD);
    const auto    result = solver.run([](double, std::vector<double> &gamma) {
      gamma.assign(gamma.size(), 1.);
    });
    BOOST_TEST(result.success, result.reason);
    return {{.5 + value(patch, solver.displacement(), .5, 0.).r,
             .8 + value(patch, solver.displacement(), .5, 1.).r}};
  }

  /// Largest relative error of the displacements or radii.
  double
  error_of(const Tube &tube, const std::array<double, 2> &found)
  {
    const double inner = tube.inner - (tube.displacements ? .5 : 0.);
    const double outer = tube.outer - (tube.displacements ? .8 : 0.);
    return std::max(std::abs(found[0] - tube.inner) / inner,
                    std::abs(found[1] - tube.outer) / outer);
  }

  double
  largest_error(const Tube &tube, const int degree, const int n)
  {
    return error_of(tube, radii(tube, degree, n));
  }
} // namespace

BOOST_AUTO_TEST_SUITE(pressure_vessels)

BOOST_AUTO_TEST_CASE(thick_tube_small_strain)
{
  for (int degree = 2; degree <= 4; ++degree)
    check_orders(
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
        return test::field_errors(
          patch, solver.displacement(), lame_tube, prm.body.material);
      },
      degree == 2 ? 4 : 16,
      degree,
      "thick tube");
}

BOOST_AUTO_TEST_CASE(hollow_sphere_small_strain)
{
  for (int degree = 2; degree <= 4; ++degree)
    check_orders(
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
        return test::field_errors(
          patch, solver.displacement(), lame_sphere, prm.body.material);
      },
      degree == 2 ? 4 : 16,
      degree,
      "hollow sphere");
}

BOOST_AUTO_TEST_CASE(offset_of_finite_strain)
{
  // The full load of appendix A.2 at finite strain, follower and dead: relative
  // difference to the formulas of small strain. It vanishes with the load.
  const auto patch  = test::tube(Ri, Ro, 1., 4, {1, 8});
  const auto offset = [&](const double load, const bool follower) {
    StaticsSolver::Parameters prm;
    prm.body.material    = Material::from_young(E, nu);
    prm.newton.tolerance = 1e-13;
    hold_ends(prm);
    side(prm, Side::theta2_0).pressure = formula(load * p);
    side(prm, Side::theta2_0).follower = follower;
    StaticsSolver solver(prm, patch, MPI_COMM_WORLD);
    BOOST_TEST(solver.run().success);
    std::array<double, 2> result;
    for (int k = 0; k < 2; ++k)
      result[k] = 100. * (value(patch, solver.displacement(), 0.5, k).r /
                            (load * lame_tube({k == 0 ? Ri : Ro, 0.}).u.r) -
                          1.);
    BOOST_TEST_MESSAGE("offset of finite strain, load "
                       << load << (follower ? ", follower" : ", dead") << ": "
                       << result[0] << " % inside, " << result[1]
                       << " % outside");
    return result;
  };
  const auto full = offset(1., true), tenth = offset(0.1, true);
  offset(1., false);
  const double expected[] = {0.28, 0.33};
  for (int k = 0; k < 2; ++k)
    {
      BOOST_TEST(std::abs(full[k] - expected[k]) < 0.005);
      BOOST_TEST(tenth[k] == 0.1 * full[k], boost::test_tools::tolerance(0.02));
    }
}

BOOST_AUTO_TEST_CASE(inflated_tube_finite_strain)
{
  const Material stiff{.5, 1000., false}, soft{400., 5e4, false};
  for (const Tube &tube : {inflated(stiff, .2, true, .113615663, .075533786),
                           inflated(stiff, .2, false, .090508816, .059493237),
                           inflated(soft, 100., true, .061943516, .040287704)})
    BOOST_TEST(largest_error(tube, 4, 16) < 1e-6);
}

BOOST_AUTO_TEST_CASE(active_tube)
{
  const Material soft{400., 5e4, false}, stiff{400., 4e8, false};
  for (const Tube &tube : {active(soft, .1, .422546728, .754018360),
                           // incompressible limit, approached as 1/K
                           active(stiff, .1, .422551595, .754022447),
                           active(stiff, .2, .345088370, .713502616)})
    BOOST_TEST(largest_error(tube, 4, 16) < 1e-6);
}

BOOST_AUTO_TEST_CASE(tubes_refined)
{
  // 1e-6 with each degree; the reference has nine digits.
  const Material stiff{.5, 1000., false}, soft{400., 5e4, false};
  for (const Tube &tube : {inflated(stiff, .2, true, .113615663, .075533786),
                           inflated(stiff, .2, false, .090508816, .059493237),
                           active(soft, .1, .422546728, .754018360)})
    for (int degree = 2; degree <= 4; ++degree)
      {
        std::ostringstream errors;
        double             error = 1.;
        for (int n = 2; n <= 32; n *= 2)
          {
            const double before = error;
            error               = largest_error(tube, degree, n);
            errors << ' ' << error;
            BOOST_TEST((error < 0.3 * before || error < 2e-8));
          }
        BOOST_TEST_MESSAGE(tube.name << ", degree " << degree
                                     << ", relative errors with 2, 4, ... 32 "
                                        "elements:"
                                     << errors.str());
        BOOST_TEST(error < 1e-6);
      }
}

BOOST_AUTO_TEST_CASE(incompressible_tube)
{
  // The limit of p = 0.4 c10 and of the active tube is approached as 1/K.
  const auto inflation = [](const double K) {
    return inflated({.5, .5 * K, false}, .2, true, .113578217, .075487423);
  };
  const auto contraction = [](const double K) {
    return active({400., 400. * K, false}, .1, .422551595, .754022447);
  };
  const auto check = [](const std::function<Tube(double)> &tube,
                        const double                       softest) {
    std::array<double, 2> before{}, found{}, limit{};
    for (double K = softest; K < 200. * softest; K *= 10.)
      {
        before = found;
        found  = radii(tube(K), 4, 16);
        BOOST_TEST_MESSAGE(tube(K).name
                           << ", K/c10 " << K
                           << ": relative distance to the incompressible one "
                           << error_of(tube(K), found));
        if (K > softest)
          BOOST_TEST(error_of(tube(K), before) / error_of(tube(K), found) ==
                       10.,
                     boost::test_tools::tolerance(0.02));
      }
    for (int k = 0; k < 2; ++k)
      limit[k] = (10. * found[k] - before[k]) / 9.;
    BOOST_TEST_MESSAGE("extrapolated: " << error_of(tube(softest), limit));
    BOOST_TEST(error_of(tube(softest), limit) < 1e-7);
  };
  check(inflation, 1e3);
  check(contraction, 1e2);
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
