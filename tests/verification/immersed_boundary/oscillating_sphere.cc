#include "cases.h"

#include <cmath>
#include <complex>

using namespace ephyra;
using namespace ephyra::test;

// A sphere that oscillates in a viscous fluid, V = v sin(omega t), without
// convection (Stokes 1851; Landau & Lifshitz, Fluid Mechanics, section 24):
//   F = -6 pi mu R (1 + R/delta) V
//       - 3 pi R^2 sqrt(2 mu rho / omega) (1 + 2R / (9 delta)) dV/dt,
// delta = sqrt(2 nu / omega). It passes back and forth over one to two cells.

BOOST_AUTO_TEST_SUITE(oscillating_sphere)

namespace
{
  using Complex = std::complex<double>;

  struct Answer
  {
    Complex by_forcing, by_probes; ///< amplitude over the exact one
    double  roughness; ///< of the force by forcing: rms above the sixth
                       ///< harmonic over rms
    /// Means over the period over the largest speed.
    double slip = 0, leakage = 0, slip_on_surface = 0, leakage_on_surface = 0;
  };

  Answer
  run(const int n, const immersed_boundary::WeightFunction weight)
  {
    const double          R = 0.5, mu = 0.02, v = 0.3, omega = 2 * M_PI;
    const double          delta = std::sqrt(2 * mu / omega), h = 1. / n;
    fluid::FlowParameters flow;
    flow.density            = 1.;
    flow.viscosity          = mu;
    flow.convection         = false;
    flow.grid.r.breakpoints = {0., 0.75, 4.};
    flow.grid.r.spacings    = {h, h, h + 0.39};
    flow.grid.y.breakpoints = {-5., -0.85, 0.85, 5.};
    flow.grid.y.spacings    = {h + 0.5, h, h, h + 0.5};
    auto sphere             = unit_sphere();
    sphere.motion           = immersed_boundary::RigidBody::Motion::prescribed;
    sphere.velocity         = "0.3*sin(2*pi*t)";
    immersed_boundary::Parameters parameters = rigid_defaults();
    parameters.weight                        = weight;
    RigidCase c(flow, {sphere}, parameters);

    const int    n_steps = 25 * n / 2; // 200 on the coarse grid
    const double dt      = 1. / n_steps;
    for (int k = 0; k < n_steps; ++k)
      c.step(dt);
    Answer              answer;
    std::vector<double> by_forcing, by_probes;
    for (int k = 0; k < n_steps; ++k)
      {
        c.step(dt);
        by_forcing.push_back(c.rigid->force_by_forcing(0)); // mean of the step
        by_probes.push_back(c.force_by_probes());
        const auto   at_points = c.rigid->no_slip_error();
        const auto   outside   = c.rigid->no_slip_error_on_surface();
        const double share     = 1. / (v * n_steps);
        answer.slip += share * at_points.slip;
        answer.leakage += share * at_points.leakage;
        answer.slip_on_surface += share * outside.slip;
        answer.leakage_on_surface += share * outside.leakage;
      }

    const Complex i(0, 1);
    const Complex exact = v * (-6 * M_PI * mu * R * (1 + R / delta) -
                               3 * M_PI * R * R * std::sqrt(2 * mu / omega) *
                                 (1 + 2 * R / (9 * delta)) * i * omega);
    const auto    harmonic =
      [&](const std::vector<double> &f, const int order, const double shift) {
        Complex sum = 0;
        for (int k = 0; k < n_steps; ++k)
          sum += f[k] * std::exp(-i * omega * ((k + 1 - shift) * dt * order));
        return sum * (order == 0 ? 1. : 2.) / static_cast<double>(n_steps);
      };
    double low = 0, all = 0; // energies
    for (int order = 0; order <= 6; ++order)
      low +=
        std::norm(harmonic(by_forcing, order, 0.)) * (order == 0 ? 1. : 0.5);
    for (const double f : by_forcing)
      all += f * f / n_steps;
    answer.by_forcing = harmonic(by_forcing, 1, 0.5) * i / exact;
    answer.by_probes  = harmonic(by_probes, 1, 0.) * i / exact;
    answer.roughness  = std::sqrt(std::max(0., all - low) / all);
    BOOST_TEST_MESSAGE(
      n << " cells: amplitude over exact and phase by forcing "
        << std::abs(answer.by_forcing) << ", " << std::arg(answer.by_forcing)
        << ", by probes " << std::abs(answer.by_probes) << ", "
        << std::arg(answer.by_probes) << "; roughness " << answer.roughness
        << "; slip " << answer.slip << ", on the surface "
        << answer.slip_on_surface << "; leakage " << answer.leakage
        << ", on the surface " << answer.leakage_on_surface);
    return answer;
  }
} // namespace

BOOST_AUTO_TEST_CASE(force_against_stokes)
{
  using immersed_boundary::WeightFunction;
  const Answer coarse      = run(16, WeightFunction::cubic_spline);
  const Answer fine        = run(32, WeightFunction::cubic_spline);
  const Answer exponential = run(32, WeightFunction::exponential);
  const double error       = std::abs(fine.by_forcing - 1.);
  BOOST_TEST(error < 0.02);
  BOOST_TEST(error < 0.5 * std::abs(coarse.by_forcing - 1.));
  BOOST_TEST(std::abs(exponential.by_forcing - 1.) < 0.02);
  BOOST_TEST(std::abs(fine.by_probes - 1.) < 0.1);
  BOOST_TEST(std::abs(fine.by_probes - 1.) <
             0.6 * std::abs(coarse.by_probes - 1.));
  // Slip and leakage on the surface, and what the forcing leaves at its points.
  BOOST_TEST(std::log2(coarse.slip_on_surface / fine.slip_on_surface) > 1.);
  BOOST_TEST(std::log2(coarse.leakage_on_surface / fine.leakage_on_surface) >
             1.);
  BOOST_TEST(fine.slip < coarse.slip);
  BOOST_TEST(fine.slip < exponential.slip);
  // The spurious pressure of the cells that change sides.
  BOOST_TEST(fine.roughness < 0.002);
  BOOST_TEST(fine.roughness < 0.5 * exponential.roughness);
  BOOST_TEST(exponential.roughness < 0.01);
}

BOOST_AUTO_TEST_SUITE_END()
