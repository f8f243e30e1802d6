// Accounts of energy: the works of a body sum to its energy, with order 2 in
// the time step or the load step, and exactly where the body is linear.
#include "elasticity_patches.h"

#include "ephyra/base/memory_archive.h"
#include "ephyra/elasticity/elasticity_solver.h"
#include "ephyra/elasticity/statics.h"
#include "ephyra/geometry/bell.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <functional>

using namespace ephyra;
using namespace ephyra::elasticity;

namespace
{
  const auto tube = test::tube(.5, .8, .1, 3, {1, 3});

  Expression
  on_side(const std::string &formula)
  {
    return Expression(formula, SideCondition::variables);
  }

  ElasticityParameters
  tube_parameters()
  {
    ElasticityParameters prm;
    prm.material       = {400., 4000., false};
    prm.density        = 1100.;
    prm.sides[0].fixed = prm.sides[1].fixed = {{false, true}};
    return prm;
  }

  struct Case
  {
    std::string                   name;
    splines::NurbsPatch<2>        patch;
    ElasticityParameters          body;
    std::function<double(double)> activation;        ///< may be empty
    double                        surroundings = 0.; ///< radial, N/s
    double                        end          = 1.; ///< s
  };

  std::vector<Case>
  cases()
  {
    std::vector<Case> all;
    all.push_back({"follower pressure and body force",
                   tube,
                   tube_parameters(),
                   {},
                   0.,
                   1.});
    all.back().body.sides[2].pressure = on_side("60*sin(3*t)^4");
    all.back().body.body_force[0] =
      Expression("200*r*sin(2*t)^4", {"r", "y", "t"});
    all.push_back({"dead pressure, traction and surroundings",
                   tube,
                   tube_parameters(),
                   {},
                   0.1,
                   1.});
    all.back().body.sides[2].pressure    = on_side("60*sin(3*t)^4");
    all.back().body.sides[2].follower    = false;
    all.back().body.sides[3].traction[0] = on_side("20*t^3");
    all.push_back({"moving side", tube, tube_parameters(), {}, 0., 1.});
    all.back().body.sides[2].fixed[0]        = true;
    all.back().body.sides[2].displacement[0] = on_side("0.1*sin(2*t)^4");
    all.push_back({"muscle",
                   tube,
                   tube_parameters(),
                   [](const double t) { return std::pow(std::sin(2. * t), 4); },
                   0.,
                   1.});
    all.back().body.active_strain.form   = ActiveStrain::Form::unit_directors;
    all.back().body.active_strain.a3     = 0.2;
    all.back().body.active_strain.delta1 = 0.;
    return all;
  }

  struct Outcome
  {
    EnergyAccounts energy;
    double         imbalance, turnover;
  };

  Outcome
  outcome(const EnergyAccounts &energy, const BodyMeasures &measures)
  {
    return {energy,
            energy.imbalance(measures),
            std::abs(energy.loads) + std::abs(energy.prescribed) +
              std::abs(energy.surroundings) + std::abs(energy.muscle)};
  }

  Outcome
  move(const Case &scene, const double rho, const int steps)
  {
    ElasticitySolver::Parameters prm;
    prm.body             = scene.body;
    prm.rho_infinity     = rho;
    prm.newton.tolerance = 1e-12;
    ElasticitySolver solver(prm, scene.patch, MPI_COMM_WORLD);
    const double     dt = scene.end / steps;
    InterfaceLoad    load;
    for (int step = 0; step < steps; ++step)
      {
        const double t = (step + 1) * dt;
        if (scene.activation)
          solver.set_activation(std::vector<double>(
            solver.body().activation_points().size(), scene.activation(t)));
        if (scene.surroundings != 0.)
          {
            load.constant.assign(solver.body().n_unknowns(), 0.);
            for (std::size_t i = 0; i < load.constant.size(); i += 2)
              load.constant[i] = scene.surroundings * t * t * t;
          }
        const auto status = solver.advance(step * dt, dt, load);
        BOOST_REQUIRE_MESSAGE(status.success, status.reason);
        solver.accept();
      }
    return outcome(solver.energy(), solver.measures());
  }

  Outcome
  load(const Case &scene, const int steps)
  {
    StaticsSolver::Parameters prm;
    prm.body             = scene.body;
    prm.n_steps          = steps;
    prm.ramp             = false;
    prm.newton.tolerance = 1e-12;
    prm.end_time         = 0.5;
    StaticsSolver solver(prm, scene.patch, MPI_COMM_WORLD);
    const auto    result =
      solver.run([&](const double t, std::vector<double> &gamma) {
        if (scene.activation)
          gamma.assign(gamma.size(), scene.activation(t));
      });
    BOOST_REQUIRE_MESSAGE(result.success, result.reason);
    return outcome(solver.energy(), solver.measures());
  }
} // namespace

BOOST_AUTO_TEST_SUITE(energy)

BOOST_AUTO_TEST_CASE(motion_closes_with_order_two)
{
  for (const Case &scene : cases())
    for (const double rho : {1., 0.5, 0.})
      {
        const Outcome coarse = move(scene, rho, 200);
        const Outcome fine   = move(scene, rho, 400);
        const double  order =
          std::log2(std::abs(coarse.imbalance / fine.imbalance));
        BOOST_TEST_MESSAGE(scene.name
                           << ", rho " << rho << ": imbalance over work "
                           << coarse.imbalance / coarse.turnover << ", "
                           << fine.imbalance / fine.turnover << " (order "
                           << order << "), dissipated "
                           << fine.energy.dissipation / fine.turnover);
        BOOST_TEST(fine.turnover > 0.);
        BOOST_TEST(std::abs(fine.imbalance) < 2e-5 * fine.turnover);
        BOOST_TEST(order > 1.8);
      }
}

BOOST_AUTO_TEST_CASE(linear_bodies_close_exactly)
{
  // A load of constant size hits a body at rest, with steps that do not resolve
  // its fast modes: what these lose is counted as dissipation.
  Case scene{"", tube, tube_parameters(), {}, 0., 1.};
  scene.body.material.small_strain = true;
  scene.body.sides[2].pressure     = on_side("60");
  for (const double rho : {1., 0.5, 0.})
    {
      const Outcome out = move(scene, rho, 20);
      BOOST_TEST_MESSAGE("rho " << rho << ": dissipated "
                                << out.energy.dissipation / out.turnover
                                << " of the work, imbalance "
                                << out.imbalance / out.turnover);
      BOOST_TEST(std::abs(out.imbalance) < 1e-10 * out.turnover);
      if (rho == 1.)
        BOOST_TEST(out.energy.dissipation == 0.);
      else
        BOOST_TEST(out.energy.dissipation > 1e-3 * out.turnover);
    }
}

BOOST_AUTO_TEST_CASE(equilibrium_closes_with_order_two)
{
  for (Case &scene : cases())
    {
      const Outcome coarse = load(scene, 8), fine = load(scene, 16);
      const double  order =
        std::log2(std::abs(coarse.imbalance / fine.imbalance));
      BOOST_TEST_MESSAGE(scene.name << ": imbalance over work "
                                    << coarse.imbalance / coarse.turnover
                                    << ", " << fine.imbalance / fine.turnover
                                    << " (order " << order << ")");
      BOOST_TEST(std::abs(fine.imbalance) < 3e-3 * fine.turnover);
      BOOST_TEST(order > 1.8);
      if (scene.activation)
        continue;
      // Without a muscle, a linear body closes with any step.
      scene.body.material.small_strain = true;
      const Outcome linear             = load(scene, 2);
      BOOST_TEST(std::abs(linear.imbalance) < 1e-11 * linear.turnover);
    }
}

BOOST_AUTO_TEST_CASE(active_bell)
{
  geometry::Discretization mesh;
  mesh.n_elements = {{10, 2}};
  Case scene{"bell",
             geometry::make_bell(geometry::BellParameters(), 0., mesh).patch,
             ElasticityParameters(),
             [](const double t) { return std::pow(std::sin(M_PI * t), 2); },
             0.,
             0.5};
  scene.body.active_strain.form = ActiveStrain::Form::paper_metric;
  scene.body.active_strain.a3   = 0.134;
  scene.body.sides[0].fixed     = {{true, true}};
  for (const double rho : {1., 0.5, 0.})
    {
      const Outcome coarse = move(scene, rho, 50), fine = move(scene, rho, 100);
      const double  order =
        std::log2(std::abs(coarse.imbalance / fine.imbalance));
      BOOST_TEST_MESSAGE("bell, rho "
                         << rho << ": imbalance over work "
                         << coarse.imbalance / coarse.turnover << ", "
                         << fine.imbalance / fine.turnover << " (order "
                         << order << "), dissipated "
                         << fine.energy.dissipation / fine.turnover);
      BOOST_TEST(std::abs(fine.imbalance) < 1e-3 * fine.turnover);
      BOOST_TEST(order > 1.8);
    }
}

BOOST_AUTO_TEST_CASE(goes_on_after_saving)
{
  Case scene = cases()[2]; // has reactions and, with 1/2, dissipation
  ElasticitySolver::Parameters prm;
  prm.body = scene.body;
  ElasticitySolver whole(prm, scene.patch, MPI_COMM_WORLD);
  ElasticitySolver part(prm, scene.patch, MPI_COMM_WORLD);
  MemoryArchive    archive;
  const double     dt = 0.02;
  for (int step = 0; step < 20; ++step)
    {
      BOOST_TEST(whole.advance(step * dt, dt).success);
      whole.accept();
      if (step == 9)
        {
          whole.forget();
          archive.begin_writing();
          whole.serialize(archive);
          archive.begin_reading();
          part.serialize(archive);
        }
      if (step > 9)
        {
          BOOST_TEST(part.advance(step * dt, dt).success);
          part.accept();
        }
    }
  BOOST_TEST(whole.energy().prescribed > 0.);
  BOOST_TEST(part.energy().prescribed == whole.energy().prescribed);
  BOOST_TEST(part.energy().dissipation == whole.energy().dissipation);
}

BOOST_AUTO_TEST_SUITE_END()
