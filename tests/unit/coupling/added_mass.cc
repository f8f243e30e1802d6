#include "ephyra/coupling/added_mass.h"
#include "ephyra/coupling/fixed_point.h"
#include "ephyra/geometry/simple_bodies.h"
#include "ephyra/splines/control_vector.h"

#include "coupled_body.h"
#include "record_value.h"

#include <Eigen/Eigenvalues>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra;
using Kind = coupling::CouplingParameters::SchemeKind;

namespace
{
  /// An elastic hollow sphere, 0.3 to 0.5 m, lighter than the fluid that falls
  /// by it in a closed cylinder.
  struct Case : test::CoupledBody
  {
    static constexpr double R  = 0.5;
    static constexpr double dt = 5e-3;

    Case(
      const Kind                    kind,
      const fluid::TimeScheme       time_scheme,
      const double                  tolerance,
      const immersed_boundary::Load load = immersed_boundary::Load::automatic,
      const coupling::AddedMassKind added_mass = coupling::AddedMassKind::full)
    {
      geometry::Discretization mesh;
      mesh.degree                     = {{2, 2}};
      mesh.n_elements                 = {{8, 2}};
      const geometry::BodyPatch shape = geometry::make_hollow_sphere(
        0.3, R, geometry::SphereSection::half, 0., mesh);
      elasticity::ElasticitySolver::Parameters mechanics;
      mechanics.body.material = elasticity::Material{20., 400., false};
      mechanics.body.density  = 0.2;
      mechanics.body.body_force[1] =
        Expression("20*sin(20*t)", {"r", "y", "t"});

      fluid::FlowParameters p;
      p.density            = 1.;
      p.viscosity          = 0.01;
      p.scheme             = time_scheme;
      p.grid.r.breakpoints = {0., 2.};
      p.grid.r.spacings    = {0.0625};
      p.grid.y.breakpoints = {-2., 2.};
      p.grid.y.spacings    = {0.0625};
      p.lower.kind = p.upper.kind = p.outer.kind = fluid::SideKind::no_slip;
      immersed_boundary::Parameters immersed_boundary;
      immersed_boundary.load = load;
      coupling::CouplingParameters coupling;
      coupling.scheme     = kind;
      coupling.tolerance  = tolerance;
      coupling.added_mass = added_mass;
      couple(mechanics, shape.patch, p, immersed_boundary, coupling);
    }

    StepStatus
    step()
    {
      const StepStatus status = scheme->advance(n_steps * dt, dt);
      BOOST_REQUIRE_MESSAGE(status.success, status.reason);
      ++n_steps;
      return status;
    }

    int n_steps = 0;
  };

  Eigen::MatrixXd
  measured(const Case &c)
  {
    const auto &scheme = dynamic_cast<coupling::FixedPoint &>(*c.scheme);
    return scheme.added_mass_operator()->at(c.surface->markers());
  }
} // namespace

BOOST_AUTO_TEST_SUITE(added_mass)

BOOST_AUTO_TEST_CASE(of_a_sphere)
{
  Case c(Kind::added_mass,
         fluid::TimeScheme::ab2,
         1e-3,
         immersed_boundary::Load::probes);
  c.step();
  const Eigen::MatrixXd A = measured(c), S = 0.5 * (A + A.transpose());
  // It resists, nearly symmetrically.
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(S);
  BOOST_TEST((A - A.transpose()).norm() < 0.3 * A.norm());
  BOOST_TEST(eigen.eigenvalues().maxCoeff() <
             -5e-3 * eigen.eigenvalues().minCoeff());
  // A single step leaves slip, so that the whole sphere meets somewhat less
  // than the rho V/2 of potential flow.
  Eigen::VectorXd axial = Eigen::VectorXd::Zero(A.rows());
  for (Eigen::Index i = 1; i < A.rows(); i += 2)
    axial[i] = 1.;
  const double volume = 4. / 3. * std::acos(-1.) * std::pow(Case::R, 3);
  const double ratio  = -axial.dot(A * axial) / volume;
  BOOST_TEST_MESSAGE("added mass over rho V: " << ratio);
  BOOST_TEST(ratio > 0.25);
  BOOST_TEST(ratio < 0.5);
}

BOOST_AUTO_TEST_CASE(turns_with_the_body)
{
  Case                       c(Kind::added_mass, fluid::TimeScheme::ab2, 1e-3);
  const int                  n       = c.body->n_unknowns();
  immersed_boundary::Markers markers = c.surface->markers();
  coupling::AddedMass        added(markers, n / 2);
  const auto      m = static_cast<Eigen::Index>(added.unknowns().size());
  Eigen::MatrixXd columns(m, m);
  for (Eigen::Index k = 0; k < m; ++k)
    for (Eigen::Index l = 0; l < m; ++l)
      columns(k, l) = std::sin(1. + 3. * k + 7. * l);
  added.set(columns, markers);
  const Eigen::MatrixXd before = added.at(markers);

  // The whole section turned by 0.3 rad: the load turns with the acceleration.
  const double        cosine = std::cos(0.3), sine = std::sin(0.3);
  std::vector<double> x    = c.body->motion().position, rest(n, 0.);
  Eigen::MatrixXd     turn = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; i += 2)
    {
      const double r = x[i], y = x[i + 1];
      x[i]     = cosine * r - sine * y;
      x[i + 1] = sine * r + cosine * y;
      turn.block<2, 2>(i, i) << cosine, -sine, sine, cosine;
    }
  markers.move(x, rest, rest);
  const Eigen::MatrixXd after = added.at(markers);
  BOOST_TEST((after - turn * before * turn.transpose()).norm() <
             1e-12 * before.norm());
  BOOST_TEST((after - before).norm() > 0.1 * before.norm());
}

BOOST_AUTO_TEST_CASE(local_parts)
{
  Case      c(Kind::fixed_point, fluid::TimeScheme::ab2, 1e-3);
  const int n_points                        = c.body->n_unknowns() / 2;
  const immersed_boundary::Markers &markers = c.surface->markers();
  const auto                        matrix  = [&](const auto kind) {
    coupling::AddedMass added(markers, n_points, kind);
    const auto          m = static_cast<Eigen::Index>(added.unknowns().size());
    Eigen::MatrixXd     columns(m, m);
    for (Eigen::Index k = 0; k < m; ++k)
      for (Eigen::Index l = 0; l < m; ++l)
        columns(k, l) = std::sin(1. + 3. * k + 7. * l);
    added.set(columns, markers);
    return Eigen::MatrixXd(added.at(markers));
  };
  using coupling::AddedMassKind;
  const Eigen::MatrixXd full     = matrix(AddedMassKind::full);
  const Eigen::MatrixXd lumped   = matrix(AddedMassKind::lumped);
  const Eigen::MatrixXd diagonal = matrix(AddedMassKind::diagonal);
  Eigen::VectorXd       axial    = Eigen::VectorXd::Zero(full.rows());
  for (Eigen::Index i = 1; i < full.rows(); i += 2)
    axial[i] = 1.;
  BOOST_TEST((full * axial).norm() > 0.1);
  BOOST_TEST((lumped * axial - full * axial).norm() < 1e-12);
  for (Eigen::Index i = 0; i < full.rows(); ++i)
    for (Eigen::Index j = 0; j < full.rows(); ++j)
      {
        const bool same = i / 2 == j / 2;
        BOOST_TEST(diagonal(i, j) == (same ? full(i, j) : 0.));
        BOOST_TEST((same || lumped(i, j) == 0.));
      }
}

BOOST_AUTO_TEST_CASE(the_matrix_does_not_change_the_motion)
{
  using coupling::AddedMassKind;
  std::vector<std::vector<double>> u;
  std::vector<int>                 evaluations;
  for (const auto kind : {AddedMassKind::full,
                          AddedMassKind::lumped,
                          AddedMassKind::diagonal,
                          AddedMassKind::forcing})
    {
      Case c(Kind::added_mass,
             fluid::TimeScheme::ab2,
             1e-7,
             immersed_boundary::Load::automatic,
             kind);
      int  sum = 0;
      for (int k = 0; k < 12; ++k)
        sum += c.step().iterations;
      BOOST_TEST_MESSAGE("evaluations " << sum);
      evaluations.push_back(sum);
      u.push_back(c.body->mechanics().displacement());
      double difference = 0, size = 0;
      for (std::size_t i = 0; i < u[0].size(); ++i)
        {
          difference =
            std::max(difference, std::abs(u.back()[i] - u.front()[i]));
          size = std::max(size, std::abs(u.front()[i]));
        }
      BOOST_TEST(difference < 1e-5 * size);
      BOOST_TEST(size > 1e-3);
    }
  BOOST_TEST(evaluations[0] < evaluations[1]);
  BOOST_TEST(evaluations[0] < evaluations[2]);
}

BOOST_AUTO_TEST_CASE(measured_again_when_it_has_aged)
{
  // So strict a tolerance and so poor a matrix take many evaluations: as soon as
  // those beyond two a step are more than a measurement takes, it is repeated.
  Case       c(Kind::added_mass,
         fluid::TimeScheme::ab2,
         1e-7,
         immersed_boundary::Load::automatic,
         coupling::AddedMassKind::lumped);
  const auto enough =
    static_cast<int>(dynamic_cast<coupling::FixedPoint &>(*c.scheme)
                       .added_mass_operator()
                       ->unknowns()
                       .size());
  int excess = 0, n_measured = 0;
  for (int k = 0; k < 12; ++k)
    {
      const int iterations = c.step().iterations;
      Record    record;
      c.scheme->evaluate_iterations(record);
      const bool measured = test::value(record, "flow solves [-]") > iterations;
      BOOST_TEST(measured == (k == 0 || excess > enough));
      n_measured += measured ? 1 : 0;
      excess = (measured ? 0 : excess) + std::max(0, iterations - 2);
    }
  BOOST_TEST(n_measured == 2);
}

BOOST_AUTO_TEST_CASE(explains_the_load_of_the_step_where_it_was_measured)
{
  // Load and acceleration are related linearly, so that the second evaluation
  // has nothing left to correct. (With several stages convection is in between.)
  for (const auto load :
       {immersed_boundary::Load::probes, immersed_boundary::Load::forcing})
    {
      Case c(Kind::added_mass, fluid::TimeScheme::ab2, 1e-7, load);
      BOOST_TEST(c.step().iterations <= 2);
    }
}

BOOST_AUTO_TEST_CASE(agrees_with_the_fixed_point)
{
  for (const auto time_scheme :
       {fluid::TimeScheme::ab2, fluid::TimeScheme::rk3})
    {
      std::vector<std::vector<double>> u;
      std::vector<int>                 evaluations;
      for (const Kind kind : {Kind::fixed_point, Kind::added_mass})
        {
          Case c(kind, time_scheme, 1e-7);
          int  sum = 0;
          for (int k = 0; k < 12; ++k)
            sum += c.step().iterations;
          evaluations.push_back(sum);
          u.push_back(c.body->mechanics().displacement());
        }
      double difference = 0, size = 0;
      for (std::size_t i = 0; i < u[0].size(); ++i)
        {
          difference = std::max(difference, std::abs(u[0][i] - u[1][i]));
          size       = std::max(size, std::abs(u[0][i]));
        }
      BOOST_TEST_MESSAGE("displacement " << size << " m, difference "
                                         << difference << " m, evaluations "
                                         << evaluations[0] << " and "
                                         << evaluations[1]);
      BOOST_TEST(size > 1e-3);
      BOOST_TEST(difference < 1e-5 * size);
      BOOST_TEST(evaluations[1] < evaluations[0]);
    }
}

BOOST_AUTO_TEST_SUITE_END()
