// Exact solutions that depend on r (and t) alone, in a pipe of radius 1.
#include "ephyra/fluid/flow_diagnostics.h"
#include "exact_flows.h"

#include <boost/test/unit_test.hpp>

#include <complex>

using namespace exact_flows;

namespace
{
  const Component zero = [](double, double) { return 0.; };

  /// First zero of J0: J0(2.404826 r) decays at the rate 5.783186 nu.
  constexpr double bessel_root = 2.404825557695773;

  double
  bessel_mode_error(const int              n,
                    const int              n_steps,
                    const TimeScheme       scheme,
                    const ViscousTreatment viscous)
  {
    constexpr double nu = 0.2, end_time = 0.5;
    FlowParameters   parameters = unit_pipe(n, 4. / n, nu);
    parameters.scheme           = scheme;
    parameters.viscous          = viscous;
    FlowSolver flow(parameters, MPI_COMM_WORLD);
    const auto exact = [](const double t) {
      return [t](const double r, double) {
        return std::cyl_bessel_j(0, bessel_root * r) *
               std::exp(-bessel_root * bessel_root * nu * t);
      };
    };
    flow.set_initial_velocity(zero, exact(0));
    run(flow, end_time, n_steps);
    return relative_error(flow, zero, exact(end_time));
  }

  using Complex = std::complex<double>;

  /// Bessel function J0 of a complex argument by its power series.
  Complex
  bessel_j0(const Complex z)
  {
    Complex term = 1, sum = 1;
    for (int k = 1; k < 80; ++k)
      {
        term *= -0.25 * z * z / static_cast<double>(k * k);
        sum += term;
      }
    return sum;
  }

  constexpr double omega = 2 * M_PI; ///< the period of all oscillations is 1

  /// J0(i^(3/2) alpha r) / J0(i^(3/2) alpha).
  Complex
  wall_layer(const double alpha, const double r)
  {
    const Complex a = alpha * std::exp(Complex(0, 0.75 * M_PI));
    return bessel_j0(a * r) / bessel_j0(a);
  }

  /// An oscillating flow Re(profile e^(i omega t)) over one period from its
  /// exact state; returns the error at the end.
  double
  oscillation_error(FlowParameters                        parameters,
                    const std::function<Complex(double)> &profile,
                    const int                             n_steps,
                    Complex                              *centre_line = nullptr)
  {
    FlowSolver flow(parameters, MPI_COMM_WORLD);
    const auto exact = [&](const double t) -> Component {
      return [&profile, t](const double r, double) {
        return (profile(r) * std::exp(Complex(0, omega * t))).real();
      };
    };
    flow.set_initial_velocity(zero, exact(0));
    const double dt = 1. / n_steps;
    for (int step = 0; step < n_steps; ++step)
      {
        flow.advance(step * dt, dt);
        if (centre_line != nullptr && flow.grid().is_first_rank())
          // Second order to the axis: v_y is even in r.
          *centre_line +=
            2. * dt * (9 * flow.velocity().y(0, 1) - flow.velocity().y(1, 1)) /
            8. * std::exp(Complex(0, -omega * (step + 1) * dt));
      }
    return relative_error(flow, zero, exact(1.));
  }
} // namespace

BOOST_AUTO_TEST_SUITE(pipe_flows)

BOOST_AUTO_TEST_CASE(bessel_mode)
{
  double previous = 0;
  for (const int n : {8, 16, 32})
    {
      const double error =
        bessel_mode_error(n, n, TimeScheme::rk3, ViscousTreatment::implicit);
      BOOST_TEST_MESSAGE("n = " << n << ": error " << error << ", order "
                                << std::log2(previous / error));
      if (previous > 0)
        BOOST_TEST(std::log2(previous / error) > 1.9);
      previous = error;
    }
  BOOST_TEST(previous < 1e-3);
}

BOOST_AUTO_TEST_CASE(poiseuille)
{
  // v = K (1 - r^2) / (4 mu), driven by a body force, and by the pressures at
  // both ends.
  constexpr double K     = 4.;
  const auto       exact = [](const double r, double) { return 1 - r * r; };
  for (const bool by_pressure : {false, true})
    {
      double previous = 0;
      for (const int n : {8, 16, 32})
        {
          FlowParameters parameters = unit_pipe(n, 0.5, 1.);
          if (by_pressure)
            {
              parameters.lower.kind = parameters.upper.kind =
                SideKind::pressure;
              parameters.lower.pressure = "2 * step(t)";
            }
          else
            parameters.body_force = "4";
          parameters.viscous = ViscousTreatment::implicit;
          FlowSolver flow(parameters, MPI_COMM_WORLD);
          run(flow, 3., 60);
          const double error = relative_error(flow, zero, exact);
          BOOST_TEST_MESSAGE((by_pressure ? "pressure" : "body force")
                             << ", n = " << n << ": error " << error);
          if (previous > 0)
            BOOST_TEST(std::log2(previous / error) > 1.9);
          previous = error;
          if (n == 32) // rho int v_y dV = pi/2 rho L
            BOOST_TEST(axial_momentum(flow.velocity(), 1.) == M_PI / 4,
                       boost::test_tools::tolerance(2e-3));
          if (by_pressure) // linear in y
            for (int i = flow.grid().first_row; i < flow.grid().end_row(); ++i)
              for (int j = 0; j < flow.grid().y.n_cells; ++j)
                BOOST_TEST(std::abs(flow.pressure()(i, j) -
                                    K * (0.5 - flow.grid().y.centre[j])) <
                           1e-4);
        }
      BOOST_TEST(previous < 1e-3);
    }
}

BOOST_AUTO_TEST_CASE(womersley)
{
  // u_centre i omega / K = 1 - 1 / J0(i^(3/2) alpha).
  const struct
  {
    double  alpha;
    Complex centre;
  } cases[] = {{5., {1.160456, 0.002988}}, {10., {0.993817, 0.002510}}};
  for (const auto &c : cases)
    {
      double previous = 0;
      for (const int n : {16, 32, 64})
        {
          FlowParameters parameters =
            unit_pipe(n, 4. / n, omega / (c.alpha * c.alpha));
          parameters.body_force = "cos(2*pi*t)";
          parameters.viscous    = ViscousTreatment::implicit;
          Complex      centre   = 0;
          const double error    = oscillation_error(
            parameters,
            [&](const double r) {
              return (1. - wall_layer(c.alpha, r)) / Complex(0, omega);
            },
            2 * n,
            &centre);
          BOOST_TEST_MESSAGE("alpha = "
                             << c.alpha << ", n = " << n << ": error " << error
                             << ", centre line " << centre * Complex(0, omega));
          if (previous > 0)
            BOOST_TEST(std::log2(previous / error) > 1.8);
          previous      = error;
          double part[] = {centre.real(), centre.imag()};
          mpi::broadcast(part, 2, MPI_COMM_WORLD);
          if (n == 64)
            BOOST_TEST(std::abs(Complex(part[0], part[1]) * Complex(0, omega) -
                                c.centre) < 2e-3);
        }
    }
}

BOOST_AUTO_TEST_CASE(oscillating_pressure)
{
  // The same flow driven by the pressure at one end, explicit and implicit.
  constexpr double alpha = 5.;
  for (const bool implicit : {true, false})
    {
      double previous = 0;
      for (const int n : {8, 16, 32})
        {
          FlowParameters parameters =
            unit_pipe(n, 0.5, omega / (alpha * alpha));
          parameters.lower.kind = parameters.upper.kind = SideKind::pressure;
          parameters.lower.pressure                     = "0.5*cos(2*pi*t)";
          parameters.viscous =
            implicit ? ViscousTreatment::implicit : ViscousTreatment::explicit_;
          const double error = oscillation_error(
            parameters,
            [&](const double r) {
              return (1. - wall_layer(alpha, r)) / Complex(0, omega);
            },
            implicit ? 2 * n : n * n);
          BOOST_TEST_MESSAGE("n = " << n << ": error " << error);
          if (previous > 0)
            BOOST_TEST(std::log2(previous / error) > 1.8);
          previous = error;
        }
      BOOST_TEST(previous < 5e-3);
    }
}

BOOST_AUTO_TEST_CASE(oscillating_wall)
{
  constexpr double alpha = 5.;
  for (const TimeScheme scheme : {TimeScheme::rk3, TimeScheme::ab2})
    for (const ViscousTreatment viscous :
         {ViscousTreatment::explicit_, ViscousTreatment::implicit})
      {
        double previous = 0;
        for (const int n : {8, 16, 32})
          {
            FlowParameters parameters =
              unit_pipe(n, 4. / n, omega / (alpha * alpha));
            parameters.scheme               = scheme;
            parameters.viscous              = viscous;
            parameters.outer.kind           = SideKind::velocity;
            parameters.outer.axial_velocity = "cos(2*pi*t)";
            const int    n_steps = viscous == ViscousTreatment::implicit
                                     ? 4 * n
                                     : n * n * (scheme == TimeScheme::rk3 ? 1 : 3);
            const double error   = oscillation_error(
              parameters,
              [](const double r) { return wall_layer(alpha, r); },
              n_steps);
            BOOST_TEST_MESSAGE("n = " << n << ": error " << error);
            if (previous > 0)
              BOOST_TEST(std::log2(previous / error) > 1.8);
            previous = error;
          }
      }
}

BOOST_AUTO_TEST_CASE(accelerated_plug)
{
  // A plug pushed through slip walls: v = U(t), dp/dy = -rho U'(t).
  FlowParameters parameters = unit_pipe(8, 1., 0.);
  parameters.density        = 3.;
  parameters.outer.kind     = SideKind::free_slip;
  parameters.lower.kind = parameters.upper.kind = SideKind::velocity;
  parameters.lower.axial_velocity = parameters.upper.axial_velocity = "t + t*t";
  FlowSolver flow(parameters, MPI_COMM_WORLD);
  run(flow, 0.5, 50);
  BOOST_TEST(relative_error(flow, zero, [](double, double) { return 0.75; }) <
             1e-12);
  for (int i = flow.grid().first_row; i < flow.grid().end_row(); ++i)
    for (int j = 1; j < flow.grid().y.n_cells; ++j)
      BOOST_TEST((flow.pressure()(i, j) - flow.pressure()(i, j - 1)) * 8 == -6.,
                 boost::test_tools::tolerance(5e-3));
}

BOOST_AUTO_TEST_SUITE_END()
