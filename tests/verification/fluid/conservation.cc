// What the discretisation keeps: mass, kinetic energy, circulation, impulse.
#include "ephyra/fluid/flow_diagnostics.h"
#include "ephyra/fluid/flow_output.h"
#include "ephyra/fluid/momentum.h"
#include "exact_flows.h"

#include <boost/test/unit_test.hpp>

#include <optional>
#include <random>

using namespace exact_flows;

namespace
{
  /// A closed inviscid box with slip walls, stretched in both directions.
  FlowParameters
  closed_box(const bool uniform_y, const int n = 16)
  {
    FlowParameters parameters;
    parameters.density            = 2.;
    parameters.viscosity          = 0.;
    parameters.grid.r.breakpoints = {0., 0.4, 1.};
    parameters.grid.r.spacings    = {0.7 / n, 0.7 / n, 1.8 / n};
    parameters.grid.y.breakpoints = {0., 0.5, 1.};
    parameters.grid.y.spacings    = {1. / n};
    if (!uniform_y)
      parameters.grid.y.spacings = {1.6 / n, 0.7 / n, 1.4 / n};
    for (SideParameters *side :
         {&parameters.lower, &parameters.upper, &parameters.outer})
      side->kind = SideKind::free_slip;
    return parameters;
  }

  /// A smooth flow with several vortices; divergence is removed by the solver.
  void
  set_vortices(FlowSolver &flow)
  {
    flow.set_initial_velocity(
      [](const double r, const double y) {
        return 5 * r * (1 - r) * (std::sin(5 * y + 2 * r) + 0.4);
      },
      [](const double r, const double y) {
        return 5 * y * (1 - y) * (std::cos(4 * r) + std::sin(7 * y));
      });
  }
} // namespace

BOOST_AUTO_TEST_SUITE(conservation)

BOOST_AUTO_TEST_CASE(convection_does_no_work)
{
  for (const bool uniform_y : {true, false})
    {
      const FlowParameters parameters = closed_box(uniform_y);
      FlowSolver           flow(parameters, MPI_COMM_WORLD);
      set_vortices(flow);
      const StaggeredGrid &grid = flow.grid();
      const Boundary       boundary(parameters, grid);
      const Momentum       momentum(parameters, grid, boundary);
      VelocityField        convection(grid), unused(grid);
      DistributedArray     no_pressure(grid);
      Momentum::Factors    factors{};
      factors.beta = 1;
      momentum.update(
        flow.velocity(), no_pressure, unused, convection, factors);

      double work = 0, size = 0;
      for (int i = boundary.first_r_face(); i < grid.end_row(); ++i)
        for (int j = 0; j < grid.y.n_cells; ++j)
          {
            const double u = flow.velocity().r(i, j);
            const double w = grid.r.face[i] * grid.r.centre_gap[i] *
                             grid.y.width[j] * u * (convection.r(i, j) - u);
            work += w;
            size += std::abs(w);
          }
      for (int i = grid.first_row; i < grid.end_row(); ++i)
        for (int j = 1; j < grid.y.n_cells; ++j)
          {
            const double u = flow.velocity().y(i, j);
            const double w = grid.r.centre[i] * grid.r.width[i] *
                             grid.y.centre_gap[j] * u *
                             (convection.y(i, j) - u);
            work += w;
            size += std::abs(w);
          }
      work = mpi::sum(work, MPI_COMM_WORLD);
      size = mpi::sum(size, MPI_COMM_WORLD);
      BOOST_TEST(size > 1e-3);
      BOOST_TEST(std::abs(work) < 1e-13 * size);
    }
}

BOOST_AUTO_TEST_CASE(inviscid_energy_drift)
{
  for (const TimeScheme scheme : {TimeScheme::rk3, TimeScheme::ab2})
    {
      FlowParameters parameters = closed_box(false);
      parameters.scheme         = scheme;
      const double expected     = scheme == TimeScheme::rk3 ? 3. : 2.;
      double       previous     = 0;
      for (const int n_steps : {40, 80, 160})
        {
          FlowSolver flow(parameters, MPI_COMM_WORLD);
          set_vortices(flow);
          const double before = kinetic_energy(flow.velocity(), flow.density());
          run(flow, 1., n_steps);
          const double drift = std::abs(
            kinetic_energy(flow.velocity(), flow.density()) / before - 1);
          BOOST_TEST_MESSAGE(n_steps << " steps: drift " << drift << ", order "
                                     << std::log2(previous / drift));
          if (previous > 0)
            BOOST_TEST(std::log2(previous / drift) > expected - 0.15);
          previous = drift;
        }
      BOOST_TEST(previous < 1e-4);
    }
}

BOOST_AUTO_TEST_CASE(divergence_at_round_off)
{
  for (const TimeScheme scheme : {TimeScheme::rk3, TimeScheme::ab2})
    for (const bool uniform_y : {true, false})
      for (const ViscousTreatment viscous :
           {ViscousTreatment::explicit_, ViscousTreatment::implicit})
        {
          FlowParameters parameters = closed_box(uniform_y);
          parameters.scheme         = scheme;
          parameters.viscosity      = 0.01;
          parameters.viscous        = viscous;
          parameters.outer.kind     = SideKind::no_slip;
          FlowSolver flow(parameters, MPI_COMM_WORLD);
          BOOST_TEST(flow.poisson().name() == (uniform_y ? "fft" : "eigen"));
          set_vortices(flow);
          for (int step = 0; step < 5; ++step)
            {
              flow.advance(step * 0.01, 0.01);
              BOOST_TEST(relative_divergence(flow.velocity()) < 1e-12);
            }
          BOOST_TEST(flow.finite());
        }
}

BOOST_AUTO_TEST_CASE(any_number_of_ranks)
{
  // The same flow on all ranks together and on each alone.
  for (const bool uniform_y : {true, false})
    for (const ViscousTreatment viscous :
         {ViscousTreatment::explicit_, ViscousTreatment::implicit})
      {
        FlowParameters parameters        = closed_box(uniform_y);
        parameters.viscosity             = 0.01;
        parameters.viscous               = viscous;
        parameters.lower.kind            = SideKind::velocity;
        parameters.lower.axial_velocity  = "exp(-20*s^2)*sin(3*t)";
        parameters.lower.radial_velocity = "s*(1-s)";
        parameters.upper.kind            = SideKind::outflow;
        FlowSolver together(parameters, MPI_COMM_WORLD);
        FlowSolver alone(parameters, MPI_COMM_SELF);
        set_vortices(together);
        set_vortices(alone);
        run(together, 0.2, 10);
        run(alone, 0.2, 10);
        const StaggeredGrid &grid       = together.grid();
        double               difference = 0, pressure_size = 0;
        for (int i = grid.first_row; i < grid.end_row(); ++i)
          for (int j = 0; j < grid.y.n_cells; ++j)
            {
              difference = std::max(
                {difference,
                 std::abs(together.velocity().r(i, j) -
                          alone.velocity().r(i, j)),
                 std::abs(together.velocity().y(i, j) -
                          alone.velocity().y(i, j)),
                 std::abs(together.pressure()(i, j) - alone.pressure()(i, j))});
              pressure_size =
                std::max(pressure_size, std::abs(alone.pressure()(i, j)));
            }
        BOOST_TEST(pressure_size > 0.01);
        BOOST_TEST(difference < 1e-12 * std::max(1., pressure_size));
      }
}

BOOST_AUTO_TEST_CASE(dissipation_is_the_loss_of_energy)
{
  // A Stokes mode loses its kinetic energy at twice its rate.
  for (const StokesMode &mode : {StokesMode{M_PI, 4.8055067166, 0.1, false},
                                 StokesMode{M_PI, 3.8317059702, 0.1, true}})
    {
      double previous = 0;
      for (const int n : {16, 32, 64})
        {
          FlowParameters parameters = unit_pipe(n, 2., mode.viscosity);
          parameters.outer.kind =
            mode.slip ? SideKind::free_slip : SideKind::no_slip;
          FlowSolver flow(parameters, MPI_COMM_WORLD);
          flow.set_initial_velocity(mode.v_r(0), mode.v_y(0));
          const double loss =
            2 * mode.rate() * kinetic_energy(flow.velocity(), 1.);
          const double error =
            std::abs(dissipation(flow.velocity(), mode.viscosity) / loss - 1);
          if (previous > 0)
            BOOST_TEST(std::log2(previous / error) > 1.8);
          previous = error;
        }
      BOOST_TEST(previous < 5e-3);
    }
}

BOOST_AUTO_TEST_CASE(diffusing_ring)
{
  // A circular vortex line of radius 1 diffuses without convection:
  //   omega = Gamma0 / (4 sqrt(pi) (nu t)^(3/2))
  //           exp(-(r^2 + 1 + y^2)/(4 nu t)) I1(r/(2 nu t)),
  // Gamma = Gamma0 (1 - exp(-1/(4 nu t))), impulse pi rho Gamma0. Its velocity
  // is the curl of A = int_t^inf nu omega dt'.
  const auto vorticity = [](const double r, const double y, const double nu_t) {
    const double z = r / (2 * nu_t);
    // I1(z) exp(-z), for large z by its asymptotic series.
    const double scaled = z < 300 ? std::cyl_bessel_i(1, z) * std::exp(-z)
                                  : (1 - 0.375 / z) / std::sqrt(2 * M_PI * z);
    return scaled * std::exp(-((r - 1) * (r - 1) + y * y) / (4 * nu_t)) /
           (4 * std::sqrt(M_PI) * std::pow(nu_t, 1.5));
  };
  const auto potential =
    [&](const double r, const double y, const double nu_t) {
      // Simpson's rule in s = sqrt(nu_t / tau), where the integrand is smooth.
      constexpr int n   = 200;
      double        sum = 0;
      for (int k = 0; k <= n; ++k)
        {
          const double s = static_cast<double>(k) / n;
          const double f =
            k == 0 ? 0.
                   : vorticity(r, y, nu_t / (s * s)) * 2 * nu_t / (s * s * s);
          sum += f * (k == 0 || k == n ? 1 : (k % 2 == 1 ? 4 : 2)) / (3. * n);
        }
      return sum;
    };

  constexpr double start = 0.04, end = 0.08;
  double           previous = 0;
  for (const int n : {8, 16, 32})
    {
      FlowParameters parameters;
      parameters.density = parameters.viscosity = 1.;
      parameters.convection                     = false;
      parameters.viscous                        = ViscousTreatment::implicit;
      parameters.grid.r.breakpoints             = {0., 2., 4.};
      parameters.grid.r.spacings                = {1. / n, 1. / n, 2. / n};
      parameters.grid.y.breakpoints             = {-3., 3.};
      parameters.grid.y.spacings                = {1. / n};
      for (SideParameters *side :
           {&parameters.lower, &parameters.upper, &parameters.outer})
        side->kind = SideKind::free_slip;
      FlowSolver           flow(parameters, MPI_COMM_WORLD);
      const StaggeredGrid &grid = flow.grid();
      // The discrete curl of A at the corners is free of divergence.
      std::vector<double> a((grid.r.n_cells + 1) * (grid.y.n_cells + 1));
      const auto          at = [&](const int i, const int j) -> double          &{
        return a[i * (grid.y.n_cells + 1) + j];
      };
      for (int i = 1; i <= grid.r.n_cells; ++i)
        for (int j = 0; j <= grid.y.n_cells; ++j)
          at(i, j) = potential(grid.r.face[i], grid.y.face[j], start);
      flow.set_initial_velocity(
        [&](const double r, const double y) {
          const int i = grid.r.cell_of(r * (1 - 1e-12)) + 1,
                    j = grid.y.cell_of(y);
          return -(at(i, j + 1) - at(i, j)) / grid.y.width[j];
        },
        [&](const double r, const double y) {
          const int i = grid.r.cell_of(r), j = grid.y.cell_of(y + 1e-9);
          return (grid.r.face[i + 1] * at(i + 1, j) -
                  grid.r.face[i] * at(i, j)) /
                 (grid.r.centre[i] * grid.r.width[i]);
        });
      const double impulse = vorticity_integrals(flow.velocity(), 1.).impulse;
      run(flow, end - start, n / 2);

      double error = 0, size = 0;
      for (int i = grid.first_row; i < grid.end_row(); ++i)
        for (int j = 0; j < grid.y.n_cells; ++j)
          {
            const double area = grid.r.width[i] * grid.y.width[j];
            const double exact =
              vorticity(grid.r.centre[i], grid.y.centre[j], end);
            error +=
              area * std::pow(cell_vorticity(flow.velocity(), i, j) - exact, 2);
            size += area * exact * exact;
          }
      error              = std::sqrt(mpi::sum(error, MPI_COMM_WORLD) /
                        mpi::sum(size, MPI_COMM_WORLD));
      const double gamma = circulation(flow.velocity());
      const double after = vorticity_integrals(flow.velocity(), 1.).impulse;
      BOOST_TEST_MESSAGE("n = " << n << ": error " << error << ", circulation "
                                << gamma << ", impulse " << impulse << " -> "
                                << after);
      if (previous > 0)
        BOOST_TEST(std::log2(previous / error) > 1.85);
      previous = error;
      if (n == 32)
        {
          BOOST_TEST(gamma == 1 - std::exp(-1 / (4 * end)),
                     boost::test_tools::tolerance(2e-3));
          BOOST_TEST(after == M_PI, boost::test_tools::tolerance(2e-3));
        }
      BOOST_TEST(after == impulse, boost::test_tools::tolerance(3e-3));
    }
}

BOOST_AUTO_TEST_SUITE_END()
