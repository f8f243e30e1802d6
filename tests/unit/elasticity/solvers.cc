// Newton's method, load steps and time stepping.
#include "elasticity_patches.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/memory_archive.h"
#include "ephyra/elasticity/elasticity_solver.h"
#include "ephyra/elasticity/statics.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra;
using namespace ephyra::elasticity;

namespace
{
  const auto &variables = SideCondition::variables;

  StaticsSolver::Parameters
  cantilever(const std::string &pressure)
  {
    StaticsSolver::Parameters prm;
    prm.body.sides[0].fixed    = {{true, true}};
    prm.body.sides[2].pressure = Expression(pressure, variables);
    return prm;
  }

  ElasticitySolver::Parameters
  free_body()
  {
    ElasticitySolver::Parameters prm;
    prm.body.density            = 1100.;
    prm.body.active_strain.form = ActiveStrain::Form::unit_directors;
    prm.body.active_strain.a3   = 0.3;
    return prm;
  }

  /// Norm of the residual that the solution leaves, over the scale of the forces.
  double
  relative_residual(StaticsSolver &solver)
  {
    std::vector<double> r;
    const auto evaluation = solver.body().residual(solver.displacement(), r);
    solver.body().get_constraints().condense(r);
    double square = 0.;
    for (const double x : r)
      square += x * x;
    return std::sqrt(square) / evaluation.scale;
  }

  const auto bell = test::hollow_ellipsoid({0.8, 0.5}, {1., 0.8}, 2, {4, 2});
} // namespace

BOOST_AUTO_TEST_SUITE(solvers)

BOOST_AUTO_TEST_CASE(newton_converges_quadratically)
{
  // Passive, and both forms of the active strain, with a follower pressure.
  using Form = ActiveStrain::Form;
  for (const auto form : {Form::none, Form::unit_directors, Form::paper_metric})
    {
      auto prm                      = cantilever("60");
      prm.body.active_strain.form   = form;
      prm.body.active_strain.a3     = 0.2;
      prm.body.active_strain.length = 0.5;
      prm.body.extra_points_across  = 0; // one rule for all three
      prm.newton.reuse              = 0.;
      prm.newton.tolerance          = 1e-12;
      // its tangents are those of a mixed form
      prm.newton.independent_pressure = false;
      StaticsSolver solver(
        prm, test::tube(.5, .8, 1., 3, {4, 2}), MPI_COMM_WORLD);
      const auto result = solver.run([](double, std::vector<double> &gamma) {
        gamma.assign(gamma.size(), 1.);
      });
      BOOST_TEST(result.success, result.reason);
      const auto        &r = result.last.residuals;
      std::ostringstream sequence;
      for (const double residual : r)
        sequence << ' ' << residual;
      BOOST_TEST_MESSAGE("residuals of Newton's method:" << sequence.str());
      BOOST_TEST(r.size() >= 4u);
      BOOST_TEST(result.last.factorizations == result.last.iterations);
      // r_{k+1} <= C r_k^2 with one C, down to round-off.
      int checked = 0;
      for (std::size_t k = 0; k + 1 < r.size(); ++k)
        if (r[k] < 3e-2)
          {
            BOOST_TEST(r[k + 1] < 10. * r[k] * r[k] + 1e-11);
            ++checked;
          }
      BOOST_TEST(checked >= 3);
    }
}

BOOST_AUTO_TEST_CASE(kept_factorisation_gives_the_same_solution)
{
  const auto patch = test::tube(.5, .8, 1., 3, {4, 2});
  auto       prm   = cantilever("60");
  prm.n_steps      = 5;
  StaticsSolver kept(prm, patch, MPI_COMM_WORLD);
  prm.newton.reuse = 0.;
  StaticsSolver fresh(prm, patch, MPI_COMM_WORLD);
  BOOST_TEST(kept.run().success);
  BOOST_TEST(fresh.run().success);
  for (std::size_t i = 0; i < kept.displacement().size(); ++i)
    BOOST_TEST(std::abs(kept.displacement()[i] - fresh.displacement()[i]) <
               1e-8);
}

BOOST_AUTO_TEST_CASE(solution_is_better_than_the_residual_that_was_accepted)
{
  // The residual that is reported is that before the last correction.
  auto prm             = cantilever("60");
  prm.n_steps          = 2;
  prm.newton.tolerance = 1e-5;
  StaticsSolver solver(prm, test::tube(.5, .8, 1., 3, {4, 2}), MPI_COMM_WORLD);
  const auto    result = solver.run();
  BOOST_TEST(result.success, result.reason);
  BOOST_TEST(result.last.residual > 1e-9);
  BOOST_TEST(relative_residual(solver) <
             prm.newton.reuse * result.last.residual);
}

BOOST_AUTO_TEST_CASE(statics_ends_with_the_last_converged_level)
{
  // A pressure that no equilibrium exists for.
  auto prm          = cantilever("5000");
  prm.n_steps       = 4;
  prm.smallest_step = 1e-2;
  StaticsSolver solver(prm, test::tube(.5, .8, 1., 2, {4, 2}), MPI_COMM_WORLD);
  const auto    result = solver.run();
  BOOST_TEST(!result.success);
  BOOST_TEST(result.level > 0.);
  BOOST_TEST(result.level < 1.);
  BOOST_TEST(result.cut_backs > 0);
  BOOST_TEST(result.reason.find("of the load") != std::string::npos);
  // What it leaves is in equilibrium with the loads of that level.
  BOOST_TEST(relative_residual(solver) <= 2. * prm.newton.tolerance);
}

BOOST_AUTO_TEST_CASE(prescribed_displacements_do_not_fold_elements)
{
  // One step that moves the end by many element lengths.
  StaticsSolver::Parameters prm;
  prm.body.sides[0].fixed = prm.body.sides[1].fixed = {{false, true}};
  prm.body.sides[1].displacement[1] = Expression("-0.2", variables);
  const auto    patch               = test::tube(0., .3, 1., 2, {40, 3});
  StaticsSolver solver(prm, patch, MPI_COMM_WORLD);
  const auto    result = solver.run();
  BOOST_TEST(result.success, result.reason);
  BOOST_TEST(result.cut_backs == 0);
  BOOST_TEST(solver.fields(.3, .5).displacement.y == -0.06,
             boost::test_tools::tolerance(1e-8));
}

BOOST_AUTO_TEST_CASE(ranks_share_the_work)
{
  // The same on one rank as on all.
  auto prm                    = cantilever("60");
  prm.body.active_strain.form = ActiveStrain::Form::unit_directors;
  const auto patch            = test::tube(.5, .8, 1., 3, {4, 2});
  const auto gamma            = [](double, std::vector<double> &values) {
    values.assign(values.size(), 1.);
  };
  StaticsSolver shared(prm, patch, MPI_COMM_WORLD);
  StaticsSolver alone(prm, patch, MPI_COMM_SELF);
  BOOST_TEST(shared.run(gamma).success);
  BOOST_TEST(alone.run(gamma).success);
  for (std::size_t i = 0; i < alone.displacement().size(); ++i)
    BOOST_TEST(std::abs(shared.displacement()[i] - alone.displacement()[i]) <
               1e-10);
  BOOST_TEST(shared.measures().elastic_energy ==
               alone.measures().elastic_energy,
             boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(body_without_support_is_refused)
{
  StaticsSolver::Parameters prm;
  prm.body.sides[0].fixed = {{true, false}};
  BOOST_CHECK_EXCEPTION(StaticsSolver(prm, bell, MPI_COMM_WORLD),
                        InputError,
                        [](const InputError &e) {
                          return std::string(e.what()).find("Nothing holds") !=
                                 std::string::npos;
                        });
}

BOOST_AUTO_TEST_CASE(rigid_translation_keeps_the_momentum)
{
  ElasticitySolver    solver(free_body(), bell, MPI_COMM_WORLD);
  std::vector<double> v(bell.n_control_points() * 2, 0.);
  for (std::size_t i = 1; i < v.size(); i += 2)
    v[i] = 0.3;
  solver.initialize(0., {}, v);
  const double start = solver.measures().momentum;
  for (int step = 0; step < 50; ++step)
    {
      BOOST_TEST(solver.advance(0.02 * step, 0.02).success);
      solver.accept();
    }
  BOOST_TEST(solver.measures().momentum == start,
             boost::test_tools::tolerance(1e-14));
  for (std::size_t i = 0; i < v.size(); ++i)
    BOOST_TEST(std::abs(solver.displacement()[i] - (i % 2 ? 0.3 : 0.)) < 1e-12);
}

BOOST_AUTO_TEST_CASE(muscle_does_not_push_a_free_body)
{
  ElasticitySolver solver(free_body(), bell, MPI_COMM_WORLD);
  solver.initialize(0.);
  const auto n = solver.body().activation_points().size();
  for (int step = 0; step < 20; ++step)
    {
      solver.set_activation(
        std::vector<double>(n, std::pow(std::sin(0.1 * (step + 1)), 2)));
      const auto status = solver.advance(0.05 * step, 0.05);
      BOOST_TEST(status.success, status.reason);
      solver.accept();
    }
  const auto m = solver.measures();
  BOOST_TEST(std::sqrt(2. * m.mass * m.kinetic_energy) > 1.);
  BOOST_TEST(std::abs(m.momentum) <
             1e-8 * std::sqrt(2. * m.mass * m.kinetic_energy));
}

BOOST_AUTO_TEST_CASE(step_can_be_repeated)
{
  auto prm         = free_body();
  prm.warm_start   = false;
  prm.newton.reuse = 0.;
  ElasticitySolver solver(prm, bell, MPI_COMM_WORLD);
  solver.initialize(0.);
  const auto n    = solver.body().activation_points().size();
  const auto take = [&](const double gamma, const double dt) {
    solver.set_activation(std::vector<double>(n, gamma));
    solver.forget();
    BOOST_TEST(solver.advance(0., dt).success);
    return solver.displacement();
  };
  const auto first = take(0.1, 0.1);
  take(0.5, 0.2);
  BOOST_TEST(take(0.1, 0.1) == first);
  solver.accept();

  MemoryArchive memory;
  memory.begin_writing();
  solver.serialize(memory);
  const auto second = take(0.2, 0.1);
  solver.accept();
  take(0.7, 0.1);
  solver.accept();
  memory.begin_reading();
  solver.serialize(memory);
  BOOST_TEST(solver.displacement() == first);
  BOOST_TEST(take(0.2, 0.1) == second);
}

BOOST_AUTO_TEST_CASE(added_mass_of_the_surroundings)
{
  // A uniform force per mass and an added mass kappa M: the body is pushed as
  // a whole; with rho_infinity = 1 from rest, a^1 = g / (1 + kappa).
  auto prm         = free_body();
  prm.rho_infinity = 1.;
  ElasticitySolver                solver(prm, bell, MPI_COMM_WORLD);
  linear_algebra::SparsityPattern coupled(solver.body().n_unknowns());
  std::vector<int>                wet;
  for (const auto s : {splines::Side::theta2_0, splines::Side::theta2_1})
    for (const int point : bell.side_control_points(s))
      for (int i = 0; i < 2; ++i)
        wet.push_back(2 * point + i);
  coupled.add_element(wet);
  solver.allow_coupling(coupled);
  solver.initialize(0.);
  const int    n = solver.body().n_unknowns();
  const double g = 2., kappa = 20.;

  Eigen::SparseMatrix<double, Eigen::RowMajor> added(n, n);
  InterfaceLoad                                load;
  load.constant.assign(n, 0.);
  std::vector<double> unit(n, 0.), column;
  for (int j = 0; j < n; ++j)
    {
      unit[j] = 1.;
      column.assign(n, 0.);
      solver.body().add_inertia(unit, column);
      unit[j] = 0.;
      for (int i = 0; i < n; ++i)
        {
          if (column[i] != 0.)
            added.insert(i, j) = -kappa * column[i];
          if (j % 2 == 1)
            load.constant[i] += g * column[i];
        }
    }
  load.added        = &added;
  const auto status = solver.advance(0., 0.01, load);
  BOOST_TEST(status.success, status.reason);
  for (int i = 0; i < n; ++i)
    BOOST_TEST(std::abs(solver.acceleration()[i] -
                        (i % 2 == 1 ? g / (1. + kappa) : 0.)) < 1e-8);
  const double force = solver.interface_force()[1];
  BOOST_TEST(force == load.constant[1] / (1. + kappa),
             boost::test_tools::tolerance(1e-8));
}

BOOST_AUTO_TEST_CASE(tied_ends_move_alike)
{
  // A rod under gravity whose outer surface is held, periodic along the axis:
  // u_y = g rho (R^2 - r^2) / (4 mu), the same all along.
  StaticsSolver::Parameters prm;
  prm.body.material              = Material::from_moduli(2., 50.);
  prm.body.material.small_strain = true;
  prm.body.tie                   = Tie::theta1;
  prm.body.sides[3].fixed        = {{true, true}};
  prm.body.body_force[1]         = Expression("3", {"r", "y", "t"});
  const auto    patch            = test::tube(0., 1., 1., 2, {3, 2});
  StaticsSolver solver(prm, patch, MPI_COMM_WORLD);
  const auto    result = solver.run();
  BOOST_TEST(result.success, result.reason);
  for (const double s : {0., 0.4, 1.})
    for (const double r : {0., 0.3, 0.9})
      {
        const auto at = solver.fields(s, r);
        BOOST_TEST(std::abs(at.displacement.y - 3. * (1. - r * r) / 8.) < 1e-9);
        BOOST_TEST(std::abs(at.displacement.r) < 1e-9);
      }
}

BOOST_AUTO_TEST_SUITE_END()
