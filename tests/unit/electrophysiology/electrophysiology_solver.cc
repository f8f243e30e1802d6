#include "ephyra/electrophysiology/electrophysiology_solver.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/memory_archive.h"
#include "ephyra/base/mpi.h"
#include "ephyra/base/parameter_handler.h"

#include "straight_line.h"
#include "temporary_folder.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra;
using namespace ephyra::electrophysiology;
using Parameters = ElectrophysiologySolver::Parameters;

namespace
{
  /// A short cable excited at its start.
  Parameters
  excited()
  {
    Parameters prm;
    prm.time_step         = 10e-6;
    prm.stimulus.interval = {{0., 0.1}};
    prm.stimulus.current  = 0.5;
    return prm;
  }

  splines::NurbsPatch<1>
  cable(const int n_elements = 60)
  {
    return straight_line({15e-3, 0}, {15e-3, 3e-3}, 3, n_elements);
  }

  void
  run(ElectrophysiologySolver &solver, const double from, const double to)
  {
    const int n = static_cast<int>(std::round((to - from) / 0.5e-3));
    for (int i = 0; i < n; ++i)
      {
        const StepStatus status = solver.advance(from + i * 0.5e-3, 0.5e-3);
        BOOST_REQUIRE_MESSAGE(status.success, status.reason);
      }
  }
} // namespace

BOOST_AUTO_TEST_SUITE(electrophysiology_solver)

BOOST_AUTO_TEST_CASE(a_restored_state_continues_to_the_last_bit)
{
  for (const Placement placement : {Placement::control_coefficients,
                                    Placement::greville_points,
                                    Placement::quadrature_points})
    {
      Parameters prm = excited();
      prm.placement  = placement;
      ElectrophysiologySolver first(prm, cable(), MPI_COMM_WORLD);
      const std::size_t       n_metric = first.metric_points().size();
      first.set_deformed_metric(std::vector<double>(n_metric, 1.1e-5),
                                std::vector<double>(n_metric, 15e-3));
      run(first, 0, 5e-3);
      MemoryArchive archive;
      archive.begin_writing();
      first.serialize(archive);
      ElectrophysiologySolver second(prm, cable(), MPI_COMM_WORLD);
      archive.begin_reading();
      second.serialize(archive);
      run(first, 5e-3, 15e-3);
      run(second, 5e-3, 15e-3);
      BOOST_TEST(first.potential() == second.potential());
      BOOST_TEST(first.n_substeps() == second.n_substeps());
      std::vector<double> gamma_1, gamma_2;
      first.activation(15e-3, gamma_1);
      second.activation(15e-3, gamma_2);
      BOOST_TEST(gamma_1 == gamma_2);
    }
}

BOOST_AUTO_TEST_CASE(all_ranks_have_the_same_state)
{
  ElectrophysiologySolver solver(excited(), cable(), MPI_COMM_WORLD);
  run(solver, 0, 5e-3);
  for (const double v : solver.potential())
    {
      BOOST_TEST(mpi::max(v, MPI_COMM_WORLD) == v);
      BOOST_TEST(mpi::min(v, MPI_COMM_WORLD) == v);
    }
}

BOOST_AUTO_TEST_CASE(unexcited_tissue_stays_at_rest_in_few_steps)
{
  Parameters prm       = excited();
  prm.stimulus.current = 0;
  ElectrophysiologySolver solver(prm, cable(), MPI_COMM_WORLD);
  const double            rest = solver.ionic_model()->rest_potential();
  run(solver, 0, 0.2);
  for (const double v : solver.potential())
    BOOST_TEST(std::abs(v - rest) < 1e-9);
  BOOST_TEST(solver.resting());
  BOOST_TEST(solver.n_substeps() < 1000);
}

BOOST_AUTO_TEST_CASE(a_moving_metric_does_not_wake_resting_tissue)
{
  Parameters prm       = excited();
  prm.stimulus.current = 0;
  ElectrophysiologySolver solver(prm, cable(), MPI_COMM_WORLD);
  const std::size_t       n_metric = solver.metric_points().size();
  run(solver, 0, 0.05);
  const auto before = solver.n_substeps();
  for (int i = 0; i < 1000; ++i)
    {
      const double t = 0.05 + i * 1e-4;
      solver.set_deformed_metric(
        std::vector<double>(n_metric, 9e-6 * (1 + 0.5 * std::sin(100 * t))),
        std::vector<double>(n_metric, 15e-3));
      BOOST_REQUIRE(solver.advance(t, 1e-4).success);
    }
  BOOST_TEST(solver.resting());
  BOOST_TEST(solver.n_substeps() - before <= 201);
}

BOOST_AUTO_TEST_CASE(sleep_changes_neither_arrival_nor_activation)
{
  // Two pulses, 0.25 s apart. The scene's own steps differ too.
  Parameters prm         = excited();
  prm.stimulus.frequency = 4;
  ElectrophysiologySolver sleeping(prm, cable(), MPI_COMM_WORLD);
  ElectrophysiologySolver short_steps(prm, cable(), MPI_COMM_WORLD);
  prm.resting_time_step     = 0;
  prm.sleep_tolerance       = 0;
  prm.neuron.table_interval = 0;
  ElectrophysiologySolver awake(prm, cable(), MPI_COMM_WORLD);
  for (ElectrophysiologySolver *solver : {&sleeping, &short_steps, &awake})
    solver->add_crossing_probe(0.8, 0.);
  run(sleeping, 0, 0.3);
  run(awake, 0, 0.3);
  for (int i = 0; i < 3000; ++i)
    BOOST_REQUIRE(short_steps.advance(i * 1e-4, 1e-4).success);
  BOOST_TEST(awake.n_substeps() == 30000);
  BOOST_TEST(awake.awake_share() == 1.);
  BOOST_TEST(sleeping.awake_share() < 0.98);
  std::vector<double> gamma_1, gamma_2;
  awake.activation(0.3, gamma_2);
  BOOST_TEST(gamma_2[10] > 0.1);
  for (ElectrophysiologySolver *solver : {&sleeping, &short_steps})
    {
      BOOST_TEST(solver->n_substeps() < awake.n_substeps() * 2 / 3);
      BOOST_REQUIRE(solver->crossing_times(0).size() == 2u);
      for (int i = 0; i < 2; ++i)
        BOOST_TEST(std::abs(solver->crossing_times(0)[i] -
                            awake.crossing_times(0)[i]) < 3e-7);
      solver->activation(0.3, gamma_1);
      for (std::size_t i = 0; i < gamma_1.size(); ++i)
        BOOST_TEST(std::abs(gamma_1[i] - gamma_2[i]) < 1e-4);
    }
  BOOST_TEST(short_steps.n_substeps() < 1.2 * sleeping.n_substeps());
}

BOOST_AUTO_TEST_CASE(activation_starts_continuously_and_peaks_at_one)
{
  ElectrophysiologySolver solver(excited(), cable(), MPI_COMM_WORLD);
  std::vector<double>     gamma;
  double                  before = 0, peak = 0, jump = 0;
  for (int i = 0; i < 1400; ++i)
    {
      BOOST_REQUIRE(solver.advance(i * 1e-3, 1e-3).success);
      solver.activation((i + 1) * 1e-3, gamma);
      const double middle = gamma[gamma.size() / 2];
      jump                = std::max(jump, std::abs(middle - before));
      peak                = std::max(peak, middle);
      before              = middle;
    }
  BOOST_TEST(std::abs(peak - 1.) < 0.03);
  BOOST_TEST(jump < 0.015);
  BOOST_TEST(before < 0.03);
}

BOOST_AUTO_TEST_CASE(a_held_end_launches_a_wave_and_lets_go)
{
  Parameters prm            = excited();
  prm.stimulus.current      = 0;
  prm.start.holds_potential = true;
  prm.start.potential       = "-69 mV";
  prm.start.start           = 3e-3; // by then the tissue rests
  prm.start.end             = 4e-3;
  ElectrophysiologySolver solver(prm, cable(), MPI_COMM_WORLD);
  const int               probe = solver.add_crossing_probe(0.9, 0.);
  run(solver, 0, 3e-3);
  BOOST_TEST(solver.resting());
  run(solver, 3e-3, 3.5e-3);
  BOOST_TEST(!solver.resting());
  BOOST_TEST(solver.potential()[0] == -69e-3,
             boost::test_tools::tolerance(1e-12));
  run(solver, 3.5e-3, 20e-3);
  BOOST_TEST(solver.crossing_times(probe).size() == 1u);
}

BOOST_AUTO_TEST_CASE(a_step_too_large_ends_with_the_limit)
{
  Parameters prm = excited();
  prm.time_step  = 200e-6;
  ElectrophysiologySolver solver(prm, cable(), MPI_COMM_WORLD);
  StepStatus              status;
  for (int i = 0; i < 20 && status.success; ++i)
    status = solver.advance(i * 1e-3, 1e-3);
  BOOST_TEST(!status.success);
  BOOST_TEST(status.reason.find("reduce \"Electrophysiology/Time step\"") !=
             std::string::npos);
  BOOST_TEST(status.reason.find("7.8") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(the_limit_of_the_step_is_right_and_found_before_the_run)
{
  for (const double factor : {0.95, 1.45})
    {
      Parameters prm = excited();
      prm.time_step  = factor / MnnNeuron({}).fastest_rate();
      ElectrophysiologySolver solver(prm, cable(), MPI_COMM_WORLD);
      BOOST_TEST((solver.resolution_problem().find("beyond the limit") !=
                  std::string::npos) == (factor > 1));
      // One macro step: substeps of that size to within one in 500.
      BOOST_TEST(solver.advance(0, 25e-3).success == (factor < 1));
    }
}

BOOST_AUTO_TEST_CASE(a_stimulus_too_weak_is_no_front)
{
  Parameters prm       = excited();
  prm.stimulus.current = 1e-4;
  ElectrophysiologySolver solver(prm, cable(), MPI_COMM_WORLD);
  const int               probe = solver.add_crossing_probe(0.9, 0.);
  run(solver, 0, 5e-3);
  BOOST_TEST(solver.crossing_times(probe).empty());
  BOOST_TEST(solver.why_not_reached(probe, 5e-3).find("no point of the line") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_resting_step_too_long_is_refused)
{
  Parameters prm        = excited();
  prm.resting_time_step = 10e-3;
  BOOST_TEST(testing::message_of<InputError>([&] {
               ElectrophysiologySolver(prm, cable(), MPI_COMM_WORLD);
             }).find("Resting time step") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_mesh_too_coarse_for_the_front_is_found_before_the_run)
{
  BOOST_TEST(ElectrophysiologySolver(excited(), cable(60), MPI_COMM_WORLD)
               .resolution_problem()
               .empty());
  BOOST_TEST(ElectrophysiologySolver(excited(), cable(10), MPI_COMM_WORLD)
               .resolution_problem()
               .find("refine to") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(an_isolated_cell_needs_an_ionic_model)
{
  Parameters prm;
  prm.model = ElectrophysiologySolver::Model::none;
  BOOST_CHECK_THROW(ElectrophysiologySolver(prm, MPI_COMM_WORLD), InputError);
}

BOOST_AUTO_TEST_CASE(currents_add_up_to_the_rate_of_the_potential)
{
  Parameters prm          = excited();
  prm.stimulus.current    = 0;
  prm.stimulus.epsc_times = {0.};
  ElectrophysiologySolver neuron(prm, MPI_COMM_WORLD);
  run(neuron, 0, 2e-3);
  double sum = 0;
  for (const double current : neuron.currents(0))
    sum += current;
  const double before = neuron.potential()[0], dt = 1e-6;
  BOOST_REQUIRE(neuron.advance(2e-3, dt).success);
  // A/m^3 over F/m^3; the neuron is per volume of tissue here.
  BOOST_TEST((neuron.potential()[0] - before) / dt == -sum / prm.capacitance,
             boost::test_tools::tolerance(1e-2));
}

BOOST_AUTO_TEST_CASE(parameters_are_read_in_units)
{
  ParameterHandler prm;
  Parameters::declare(prm);
  prm.read_text("subsection Electrophysiology\n"
                "  set Conductivity = 2e-5 uS/mm\n"
                "  set Time step = 10 us\n"
                "  set Placement = quadrature points\n"
                "  subsection Jellyfish neuron\n"
                "    set Conductance I = 300 nS\n"
                "  end\n"
                "  subsection Stimulus\n"
                "    set Current = 0.2 nA/mm^3\n"
                "    set EPSC times = 1 ms, 3 ms\n"
                "  end\n"
                "  subsection Start of the line\n"
                "    set Type = potential\n"
                "    set Potential = -69 mV\n"
                "    set End time = 1 ms\n"
                "  end\n"
                "end\n",
                "test");
  Parameters parameters;
  parameters.parse(prm);
  prm.throw_errors();
  const auto close = boost::test_tools::tolerance(1e-12);
  BOOST_TEST(parameters.conductivity == 2e-8, close);
  BOOST_TEST(parameters.capacitance == 1e-3, close);
  BOOST_TEST(parameters.time_step == 10e-6, close);
  BOOST_TEST((parameters.placement == Placement::quadrature_points));
  BOOST_TEST(parameters.neuron.g_I == 300., close);
  BOOST_TEST(parameters.neuron.E_O == -84.6, close);
  BOOST_TEST(parameters.synapses.conductance == 75e-9, close);
  BOOST_TEST(parameters.stimulus.current == 0.2, close);
  BOOST_TEST(parameters.stimulus.epsc_times.at(1) == 3e-3, close);
  BOOST_TEST(parameters.start.end == 1e-3, close);
  BOOST_TEST(parameters.diffusivity() == 2e-5, close);
}

BOOST_AUTO_TEST_CASE(all_linear_solvers_give_the_same_spike)
{
  using LinearSolver = DiffusionStepper::LinearSolver;
  std::vector<std::vector<double>> results;
  for (const LinearSolver linear_solver : {LinearSolver::narrow_band,
                                           LinearSolver::lapack_band,
                                           LinearSolver::amesos2})
    {
      Parameters prm    = excited();
      prm.linear_solver = linear_solver;
      ElectrophysiologySolver solver(prm, cable(), MPI_COMM_WORLD);
      run(solver, 0., 4e-3);
      results.push_back(solver.potential());
    }
  double largest = -1.;
  for (std::size_t i = 0; i < results[0].size(); ++i)
    {
      largest = std::max(largest, results[0][i]);
      BOOST_TEST(std::abs(results[1][i] - results[0][i]) < 1e-10);
      BOOST_TEST(std::abs(results[2][i] - results[0][i]) < 1e-10);
    }
  BOOST_TEST(largest > 0.); // there is a spike to compare
}

BOOST_AUTO_TEST_SUITE_END()
