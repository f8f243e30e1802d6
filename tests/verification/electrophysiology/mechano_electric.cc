// Conduction on deformed lines: uniform stretches, in which the speed in
// material coordinates is exactly 1/stretch; a stretch that grows in time; and
// a line deformed into another one, which then behaves as that.
#include "ephyra/simulation/tissue_motion.h"

#include "reference_table.h"
#include "straight_line.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra::electrophysiology;
using ephyra::simulation::TissueMotion;
using Measure    = MonodomainOperator::Measure;
using Parameters = ElectrophysiologySolver::Parameters;

namespace
{
  /// Speed in material coordinates over the middle 60 % of a cable that is at
  /// least 20 mm long, stretched or not.
  double
  material_speed(const double  stretch,
                 const int     n_elements,
                 const Measure measure)
  {
    const double length = 20e-3 / std::min(1., stretch);
    const auto line = straight_line({15e-3, 0}, {15e-3, length}, 3, n_elements);
    Parameters prm;
    prm.time_step         = 10e-6;
    prm.measure           = measure;
    prm.stimulus.interval = {{0., 0.8e-3 / length}};
    prm.stimulus.current  = 1.;
    ElectrophysiologySolver  solver(prm, line, MPI_COMM_WORLD);
    TissueMotion::Parameters motion;
    motion.axial = std::to_string(stretch - 1.) + "*y";
    std::vector<double> G11, r;
    TissueMotion(motion, line, solver).metric(0., G11, r);
    if (stretch != 1)
      BOOST_REQUIRE(solver.set_deformed_metric(G11, r));
    const int first = solver.add_crossing_probe(0.2, 20e-3);
    const int last  = solver.add_crossing_probe(0.8, 20e-3);
    for (int i = 0; i < 400 && solver.crossing_times(last).empty(); ++i)
      BOOST_REQUIRE(solver.advance(i * 0.5e-3, 0.5e-3).success);
    return 0.6 * length /
           (solver.crossing_times(last).at(0) -
            solver.crossing_times(first).at(0));
  }

  /// Error of cos(pi y/L) at y = 0 on a cylinder whose length grows by the
  /// factor 1 + t: it decays with kappa (pi/L)^2 int dt/(1 + t)^2.
  double
  stretching_error(const int n_steps, const Measure measure)
  {
    const auto line = straight_line({1, 0}, {1, 1}, 3, 40);
    Parameters prm;
    prm.model             = ElectrophysiologySolver::Model::none;
    prm.conductivity      = 0.2;
    prm.capacitance       = 1;
    prm.stimulus.current  = 0;
    prm.time_step         = 1e-3;
    prm.measure           = measure;
    prm.metric_tolerance  = 0;
    prm.initial_potential = "cos(pi*s)";
    ElectrophysiologySolver  solver(prm, line, MPI_COMM_WORLD);
    TissueMotion::Parameters motion;
    motion.axial = "t*y";
    const TissueMotion  moved(motion, line, solver);
    const double        dt = 1. / n_steps;
    std::vector<double> G11, r;
    for (int i = 0; i < n_steps; ++i)
      {
        moved.metric((i + 0.5) * dt, G11, r);
        solver.set_deformed_metric(G11, r);
        BOOST_REQUIRE(solver.advance(i * dt, dt).success);
      }
    return solver.potential_at(0.) - std::exp(-0.2 * M_PI * M_PI * 0.5);
  }
} // namespace

BOOST_AUTO_TEST_SUITE(mechano_electric)

BOOST_AUTO_TEST_CASE(material_speed_is_the_inverse_stretch)
{
  // Elements as long as without stretch, when deformed.
  const double still = material_speed(1., 300, Measure::reference);
  for (const double stretch : {0.8, 1.25})
    {
      const int n = static_cast<int>(std::lround(300 * std::max(1., stretch)));
      for (const Measure measure : {Measure::reference, Measure::deformed})
        BOOST_TEST(
          std::abs(material_speed(stretch, n, measure) * stretch / still - 1.) <
          2e-4);
    }
}

BOOST_AUTO_TEST_CASE(long_table_of_stretches)
{
  const double still        = material_speed(1., 800, Measure::reference);
  const double coarse_still = material_speed(1., 400, Measure::reference);
  for (const double stretch : {0.5, 0.7, 0.9, 1.1, 1.4, 2.})
    {
      const int n = static_cast<int>(std::lround(800 * std::max(1., stretch)));
      const double fine     = material_speed(stretch, n, Measure::reference);
      const double deformed = material_speed(stretch, n, Measure::deformed);
      const double coarse   = material_speed(stretch, 400, Measure::reference);
      BOOST_TEST_MESSAGE("| " << stretch << " | " << fine << " | "
                              << fine * stretch / still - 1. << " | "
                              << deformed / fine - 1. << " | "
                              << coarse * stretch / coarse_still - 1. << " |");
      BOOST_TEST(std::abs(fine * stretch / still - 1.) < 1e-4);
      BOOST_TEST(std::abs(deformed / fine - 1.) < 1e-8);
    }
}

BOOST_AUTO_TEST_CASE(a_growing_stretch_is_second_order)
{
  for (const Measure measure : {Measure::reference, Measure::deformed})
    {
      const double coarse = stretching_error(10, measure);
      const double fine   = stretching_error(20, measure);
      BOOST_TEST_MESSAGE("errors " << coarse << ", " << fine);
      BOOST_TEST(std::abs(std::log2(coarse / fine) - 2.) < 0.1);
    }
}

BOOST_AUTO_TEST_CASE(a_line_deformed_into_a_disk_behaves_as_one)
{
  // The disk of eq. (A.1), as a deformed cylinder.
  const double radius = 40;
  Parameters   prm;
  prm.model               = ElectrophysiologySolver::Model::none;
  prm.conductivity        = 60;
  prm.capacitance         = 1;
  prm.time_step           = 2e-3;
  prm.measure             = Measure::deformed;
  prm.stimulus.current    = 0;
  prm.end.holds_potential = true;
  prm.end.potential       = "1";
  const auto line         = straight_line({radius, 0}, {radius, radius}, 3, 60);
  ElectrophysiologySolver  solver(prm, line, MPI_COMM_WORLD);
  TissueMotion::Parameters motion;
  motion.radial = "y - r";
  motion.axial  = "-y";
  std::vector<double> G11, r;
  TissueMotion(motion, line, solver).metric(0., G11, r);
  BOOST_REQUIRE(solver.set_deformed_metric(G11, r));
  BOOST_REQUIRE(solver.advance(0., 1.).success);
  double worst = 0;
  for (const std::vector<double> &row : read_reference("A1_disk_heat.csv"))
    worst =
      std::max(worst, std::abs(solver.potential_at(row[0] / radius) - row[3]));
  BOOST_TEST_MESSAGE("largest error " << worst);
  BOOST_TEST(worst < 1e-6);
}

BOOST_AUTO_TEST_SUITE_END()
