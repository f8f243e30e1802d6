#include "ephyra/diagnostics/body_kinematics.h"
#include "ephyra/geometry/simple_bodies.h"

#include "coupled_body.h"
#include "reference_table.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <complex>

using namespace ephyra;

namespace
{
  constexpr double pi     = 3.14159265358979323846;
  constexpr double length = 0.25;

  /// Complex amplitudes of the axial velocity on the axis and at the interface
  /// in the periodic state of the exact problem in
  /// reference/fsi/axial_shear_rod_in_annulus.csv, v = Re[A exp(-2 pi i t)].
  std::array<std::complex<double>, 2>
  amplitudes(const double spacing, const int n_period)
  {
    geometry::Discretization mesh;
    mesh.degree     = {{3, 3}};
    mesh.n_elements = {{1, 8}};
    const geometry::BodyPatch rod =
      geometry::make_tube(0., 0.5, length, 0., mesh);
    elasticity::ElasticitySolver::Parameters mechanics;
    mechanics.body.material = elasticity::Material{0.5, 50., false};
    mechanics.body.density  = 1.1;
    mechanics.body.tie      = elasticity::Tie::theta1;

    fluid::FlowParameters fluid;
    fluid.density              = 1.;
    fluid.viscosity            = 0.05;
    fluid.scheme               = fluid::TimeScheme::ab2;
    fluid.grid.r.breakpoints   = {0., 1.};
    fluid.grid.r.spacings      = {spacing};
    fluid.grid.y.breakpoints   = {0., length};
    fluid.grid.y.spacings      = {spacing};
    fluid.lower.kind           = fluid::SideKind::periodic;
    fluid.upper.kind           = fluid::SideKind::periodic;
    fluid.outer.kind           = fluid::SideKind::velocity;
    fluid.outer.axial_velocity = "cos(2*pi*t)";

    immersed_boundary::Parameters immersed_boundary;
    immersed_boundary.load = immersed_boundary::Load::forcing;
    coupling::CouplingParameters coupling;
    coupling.scheme    = coupling::CouplingParameters::SchemeKind::fixed_point;
    coupling.tolerance = 1e-3;
    test::CoupledBody coupled;
    coupled.couple(mechanics, rod.patch, fluid, immersed_boundary, coupling);

    const diagnostics::BodyKinematics probe(rod.patch);
    const std::vector<double>         rest(coupled.body->n_unknowns(), 0.);
    // Explicit viscosity.
    const double                        dt      = 1. / n_period;
    const int                           n_steps = 12 * n_period;
    std::array<std::complex<double>, 2> result{};
    for (int step = 0; step < n_steps; ++step)
      {
        const StepStatus status = coupled.scheme->advance(step * dt, dt);
        BOOST_REQUIRE_MESSAGE(status.success, status.reason);
        if (step < n_steps - n_period)
          continue;
        const std::complex<double> phase =
          std::exp(std::complex<double>(0., 2. * pi * (step + 1) * dt));
        for (const int k : {0, 1})
          {
            // The velocity field is evaluated like a displacement.
            const std::array<double, 2> theta{{0.5, static_cast<double>(k)}};
            const double                v =
              probe.position(theta, coupled.body->motion().velocity).y -
              probe.position(theta, rest).y;
            result[k] += 2. / n_period * v * phase;
          }
      }
    return result;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(rod_in_annulus)

BOOST_AUTO_TEST_CASE(shear_waves_have_the_exact_amplitude)
{
  std::array<std::complex<double>, 2> exact;
  for (const auto &row : read_reference("fsi/axial_shear_rod_in_annulus.csv"))
    for (const int k : {0, 1})
      if (std::abs(row.at(0) - 0.5 * k) < 1e-9)
        exact[k] = {row.at(1), row.at(2)};
  BOOST_TEST(std::abs(exact[0]) > 0.1);
  BOOST_TEST(std::abs(exact[1]) > 0.05);

  const auto coarse = amplitudes(1. / 16., 200);
  const auto fine   = amplitudes(1. / 32., 500);
  for (const int k : {0, 1})
    {
      const double error        = std::abs(fine[k]) / std::abs(exact[k]) - 1.;
      const double coarse_error = std::abs(coarse[k]) / std::abs(exact[k]) - 1.;
      const double phase        = std::arg(fine[k] / exact[k]);
      BOOST_TEST_MESSAGE((k == 0 ? "axis" : "interface")
                         << ": relative error of the amplitude " << coarse_error
                         << " at 1/16, " << error << " at 1/32; of the phase "
                         << phase << " rad");
      BOOST_TEST(std::abs(error) < 0.015);
      BOOST_TEST(std::log2(coarse_error / error) > 1.7);
      BOOST_TEST(std::abs(phase) < 0.045);
    }
}

BOOST_AUTO_TEST_SUITE_END()
