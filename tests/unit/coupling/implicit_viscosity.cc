#include "ephyra/geometry/simple_bodies.h"
#include "ephyra/immersed_boundary/direct_forcing.h"

#include "coupled_body.h"

#include <Eigen/LU>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra;
using immersed_boundary::ForcingSolver;
using Kind = coupling::CouplingParameters::SchemeKind;

// Deformable bodies in a flow whose time step is above the limit of explicit
// viscosity.

namespace
{
  constexpr double h = 1. / 12., nu = 1.;

  /// A stiff hollow sphere of diameter 1 in a closed cylinder of fluid, which it
  /// sinks through.
  struct Case : test::CoupledBody
  {
    Case(const Kind kind, const ForcingSolver solver)
    {
      geometry::Discretization mesh;
      mesh.degree                     = {{2, 2}};
      mesh.n_elements                 = {{8, 1}};
      const geometry::BodyPatch shape = geometry::make_hollow_sphere(
        0.25, 0.5, geometry::SphereSection::half, 0., mesh);
      elasticity::ElasticitySolver::Parameters mechanics;
      mechanics.body.material      = elasticity::Material{200., 2000., false};
      mechanics.body.density       = 2.;
      mechanics.body.body_force[1] = Expression("-5", {"r", "y", "t"});

      fluid::FlowParameters p;
      p.density            = 1.;
      p.viscosity          = nu;
      p.scheme             = fluid::TimeScheme::ab2;
      p.grid.r.breakpoints = {0., 1.25};
      p.grid.y.breakpoints = {-1.5, 1.5};
      p.grid.r.spacings = p.grid.y.spacings = {h};
      p.lower.kind = p.upper.kind = p.outer.kind = fluid::SideKind::no_slip;
      immersed_boundary.forcing_solver           = solver;
      coupling::CouplingParameters coupling;
      coupling.scheme = kind;
      couple(mechanics, shape.patch, p, immersed_boundary, coupling);
    }

    /// Mean velocity of the control points after @p n_steps.
    double
    speed(const int n_steps, const double dt)
    {
      for (int k = 0; k < n_steps; ++k)
        {
          const StepStatus status = scheme->advance(k * dt, dt);
          BOOST_REQUIRE_MESSAGE(status.success, status.reason);
        }
      const std::vector<double> v   = body->motion().velocity;
      double                    sum = 0;
      for (std::size_t i = 1; i < v.size(); i += 2)
        sum += v[i];
      return -2. * sum / static_cast<double>(v.size());
    }

    immersed_boundary::Parameters immersed_boundary;
  };
} // namespace

BOOST_AUTO_TEST_SUITE(implicit_viscosity)

BOOST_AUTO_TEST_CASE(settling_does_not_depend_on_the_step)
{
  using Pair = std::pair<Kind, ForcingSolver>;
  for (const auto &[kind, solver] :
       {Pair{Kind::forcing_as_load, ForcingSolver::scaled_sweeps},
        Pair{Kind::added_mass, ForcingSolver::sweeps}})
    {
      // nu dt / Delta^2 = 0.11, explicit, and 7.2.
      constexpr double end = 0.5;
      Case             fine(kind, solver), coarse(kind, solver);
      const double     exact = fine.speed(640, end / 640);
      const double     speed = coarse.speed(10, end / 10);
      BOOST_TEST(!fine.flow->implicit_directions().any());
      BOOST_TEST(coarse.flow->implicit_directions().any());
      BOOST_TEST_MESSAGE("speed " << exact << " m/s, with large steps "
                                  << speed / exact - 1. << " more");
      BOOST_TEST(exact > 0.05);
      BOOST_TEST(std::abs(speed / exact - 1.) < 0.01);
    }
}

BOOST_AUTO_TEST_CASE(resistance_is_the_derivative_of_the_load)
{
  for (const double dt : {1.25e-3, 0.05})
    {
      Case c(Kind::forcing_as_load, ForcingSolver::scaled_sweeps);
      c.flow->begin_step(0., dt);
      c.flow->predict(0);
      c.surface->sample(*c.flow, 0);
      const int            n      = c.body->n_unknowns();
      coupling::BodyMotion motion = c.body->motion();
      const auto           load   = [&]() {
        std::vector<double> f(n, 0.);
        c.surface->set_motion(motion);
        c.surface->solve_forcing();
        c.surface->add_forcing_load(dt, f);
        return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(f.data(), n));
      };
      const Eigen::VectorXd before = load();
      Eigen::VectorXd       v(n);
      for (int i = 0; i < n; ++i)
        motion.velocity[i] += v[i] = std::sin(1. + 3. * i);
      const Eigen::VectorXd change = load() - before;
      const auto            K      = c.surface->forcing_resistance(dt);
      BOOST_TEST(change.norm() > 0.);
      BOOST_TEST((change + K * v).norm() < 1e-10 * change.norm());
      // All that it couples fits into the pattern.
      auto pattern =
        c.surface->coupling_pattern(c.flow->implicit_directions().any());
      int n_missing = 0;
      for (int row = 0; row < n; ++row)
        for (coupling::WetSurface::Matrix::InnerIterator entry(K, row); entry;
             ++entry)
          if (entry.value() != 0. &&
              !pattern.contains(row, static_cast<int>(entry.col())))
            ++n_missing;
      BOOST_TEST(n_missing == 0);
    }
}

BOOST_AUTO_TEST_CASE(forcing_leaves_the_slip_of_the_explicit_limit)
{
  // J A^-1 S F = V - J u* - theta (T^-1 - M) F, whatever T is.
  constexpr double dt    = 0.05;
  constexpr double theta = 0.2 / (nu * dt * 2. / (h * h));
  for (const ForcingSolver solver : {ForcingSolver::sweeps,
                                     ForcingSolver::scaled_sweeps,
                                     ForcingSolver::exact})
    {
      Case                             c(Kind::added_mass, solver);
      immersed_boundary::DirectForcing forcing(c.flow->grid(),
                                               c.immersed_boundary);
      forcing.update(c.surface->markers());
      c.flow->begin_step(0., dt);
      c.flow->predict(0);
      forcing.prepare(*c.flow, 0);
      const int           n = forcing.n_markers();
      std::vector<double> residual(2 * n), F, before, after;
      for (int l = 0; l < n; ++l)
        residual[l] = residual[n + l] = 1. + 0.1 * std::sin(0.3 * l);
      forcing.solve(residual, F);
      forcing.interpolate(c.flow->velocity(), before);
      forcing.add(F, *c.flow, 0);
      forcing.interpolate(c.flow->velocity(), after);
      for (int k = 0; k < 2; ++k)
        {
          const auto part = [&](const std::vector<double> &x) {
            return Eigen::VectorXd(
              Eigen::Map<const Eigen::VectorXd>(x.data() + k * n, n));
          };
          const Eigen::VectorXd f = part(F), r = part(residual);
          const Eigen::VectorXd slip = r - (part(after) - part(before));
          const Eigen::MatrixXd T    = forcing.transfer(k);
          const Eigen::VectorXd left =
            theta * (T.partialPivLu().solve(f) - forcing.marker_matrix(k) * f);
          BOOST_TEST((slip - left).norm() < 1e-6 * r.norm());
          BOOST_TEST_MESSAGE("slip " << slip.norm() / r.norm());
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()
