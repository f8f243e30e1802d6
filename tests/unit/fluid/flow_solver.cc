#include "ephyra/fluid/flow_solver.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/memory_archive.h"
#include "ephyra/base/parameter_handler.h"
#include "ephyra/fluid/flow_diagnostics.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <string>

using namespace ephyra;
using namespace ephyra::fluid;

namespace
{
  /// A tank with a jet from below and a convective outflow.
  FlowParameters
  jet()
  {
    FlowParameters parameters;
    parameters.density              = 1.;
    parameters.viscosity            = 0.01;
    parameters.grid.r.spacings      = {1. / 16};
    parameters.grid.y.breakpoints   = {0., 2.};
    parameters.grid.y.spacings      = {1. / 16};
    parameters.lower.kind           = SideKind::velocity;
    parameters.lower.axial_velocity = "exp(-10*s^2)*(1+t)";
    parameters.upper.kind           = SideKind::outflow;
    parameters.outer.kind           = SideKind::free_slip;
    return parameters;
  }

  double
  difference(const FlowSolver &a, const FlowSolver &b)
  {
    double largest = 0;
    for (int i = a.grid().first_row; i < a.grid().end_row(); ++i)
      for (int j = 0; j <= a.grid().y.n_cells; ++j)
        largest =
          std::max({largest,
                    std::abs(a.velocity().r(i, j) - b.velocity().r(i, j)),
                    std::abs(a.velocity().y(i, j) - b.velocity().y(i, j))});
    return mpi::max(largest, MPI_COMM_WORLD);
  }

  /// The message of the InputError that a flow with these parameters throws.
  std::string
  error_of(const FlowParameters &parameters)
  {
    try
      {
        FlowSolver flow(parameters, MPI_COMM_WORLD);
        flow.advance(0, 0.01);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }

  bool
  contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(flow_solver)

BOOST_AUTO_TEST_CASE(stages)
{
  FlowParameters parameters = jet();
  FlowSolver     flow(parameters, MPI_COMM_WORLD);
  flow.begin_step(1., 0.1);
  BOOST_TEST(flow.n_stages() == 3u);
  BOOST_TEST(flow.stage_dt(0) + flow.stage_dt(1) + flow.stage_dt(2) == 0.1,
             boost::test_tools::tolerance(1e-14));
  BOOST_TEST(flow.stage_time(2) == 1.1, boost::test_tools::tolerance(1e-14));
  parameters.scheme = TimeScheme::ab2;
  FlowSolver adams(parameters, MPI_COMM_WORLD);
  adams.begin_step(1., 0.1);
  BOOST_TEST(adams.n_stages() == 1u);
  BOOST_TEST(adams.stage_dt(0) == 0.1);
}

BOOST_AUTO_TEST_CASE(repeated_evaluations_start_from_the_same_prediction)
{
  FlowSolver once(jet(), MPI_COMM_WORLD), repeated(jet(), MPI_COMM_WORLD);
  for (int step = 0; step < 3; ++step)
    {
      once.advance(step * 0.01, 0.01);
      repeated.begin_step(step * 0.01, 0.01);
      for (unsigned int k = 0; k < 3; ++k)
        {
          repeated.predict(k);
          for (int i = repeated.grid().first_row; i < repeated.grid().end_row();
               ++i)
            repeated.velocity().y(i, 7) += 1.; // a force of a rejected trial
          repeated.project(k);
          BOOST_TEST(relative_divergence(repeated.velocity()) < 1e-12);
          repeated.reset_to_predicted(k);
          repeated.project(k);
        }
      repeated.end_step();
    }
  BOOST_TEST(difference(once, repeated) == 0.);
  BOOST_TEST(once.pressure()(once.grid().first_row, 3) ==
             repeated.pressure()(once.grid().first_row, 3));
}

BOOST_AUTO_TEST_CASE(predictions_need_not_be_kept)
{
  FlowSolver kept(jet(), MPI_COMM_WORLD), swapped(jet(), MPI_COMM_WORLD);
  swapped.keep_predicted(false);
  for (int step = 0; step < 3; ++step)
    {
      kept.advance(step * 0.01, 0.01);
      swapped.advance(step * 0.01, 0.01);
    }
  BOOST_TEST(difference(kept, swapped) == 0.);
}

BOOST_AUTO_TEST_CASE(restart)
{
  for (const TimeScheme scheme : {TimeScheme::rk3, TimeScheme::ab2})
    {
      FlowParameters parameters = jet();
      parameters.scheme         = scheme;
      FlowSolver whole(parameters, MPI_COMM_WORLD);
      FlowSolver resumed(parameters, MPI_COMM_WORLD);
      for (int step = 0; step < 4; ++step)
        whole.advance(step * 0.01, 0.01);
      MemoryArchive memory;
      memory.begin_writing();
      whole.serialize(memory);
      memory.begin_reading();
      resumed.serialize(memory);
      BOOST_TEST(difference(whole, resumed) == 0.);
      for (int step = 4; step < 8; ++step)
        {
          whole.advance(step * 0.01, 0.01);
          resumed.advance(step * 0.01, 0.01);
        }
      BOOST_TEST(difference(whole, resumed) == 0.);
    }
}

BOOST_AUTO_TEST_CASE(a_step_is_taken_back_without_a_copy)
{
  FlowParameters parameters = jet();
  parameters.scheme         = TimeScheme::ab2;
  FlowSolver flow(parameters, MPI_COMM_WORLD);
  FlowSolver other(parameters, MPI_COMM_WORLD);
  flow.keep_predicted(false);
  for (int step = 0; step < 4; ++step)
    {
      flow.advance(step * 0.01, 0.01);
      other.advance(step * 0.01, 0.01);
    }
  const int     row      = flow.grid().first_row;
  const double  pressure = flow.pressure()(row, 3);
  MemoryArchive memory(true);
  memory.begin_writing();
  flow.serialize(memory);

  // After a whole step, and in the middle of one, again and again.
  for (int attempt = 0; attempt < 3; ++attempt)
    {
      flow.begin_step(0.04, 0.01);
      flow.predict(0);
      if (attempt != 1)
        {
          flow.project(0);
          flow.end_step();
        }
      BOOST_TEST(difference(flow, other) > 0.);
      memory.begin_reading();
      flow.serialize(memory);
      BOOST_TEST(difference(flow, other) == 0.);
      BOOST_TEST(flow.pressure()(row, 3) == pressure);
    }

  // Without history the next step is one of first order, those after it are
  // of second order again.
  for (int step = 0; step < 8; ++step)
    {
      flow.advance(0.04 + 0.005 * step, 0.005);
      other.advance(0.04 + 0.005 * step, 0.005);
    }
  BOOST_TEST(difference(flow, other) > 0.);
  BOOST_TEST(difference(flow, other) < 1e-3);
}

BOOST_AUTO_TEST_CASE(one_projection_per_step)
{
  FlowParameters parameters = jet();
  FlowSolver     each(parameters, MPI_COMM_WORLD);
  parameters.project_every_substep = false;
  FlowSolver one(parameters, MPI_COMM_WORLD);
  for (int step = 0; step < 20; ++step)
    {
      each.advance(step * 0.01, 0.01);
      one.advance(step * 0.01, 0.01);
    }
  BOOST_TEST(relative_divergence(one.velocity()) < 1e-12);
  BOOST_TEST(difference(each, one) > 0.);
  BOOST_TEST(difference(each, one) < 1e-3);
}

BOOST_AUTO_TEST_CASE(outflow_balances_the_mass)
{
  FlowSolver           flow(jet(), MPI_COMM_WORLD);
  const StaggeredGrid &grid = flow.grid();
  for (int step = 0; step < 50; ++step)
    flow.advance(step * 0.02, 0.02);
  double in = 0, out = 0;
  for (int i = grid.first_row; i < grid.end_row(); ++i)
    {
      in += grid.r.centre[i] * grid.r.width[i] * flow.velocity().y(i, 0);
      out += grid.r.centre[i] * grid.r.width[i] *
             flow.velocity().y(i, grid.y.n_cells);
    }
  in  = mpi::sum(in, MPI_COMM_WORLD);
  out = mpi::sum(out, MPI_COMM_WORLD);
  BOOST_TEST(in > 0.05);
  BOOST_TEST(out == in, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(relative_divergence(flow.velocity()) < 1e-12);
  BOOST_TEST(flow.max_cfl(0.02) < 2.);
}

BOOST_AUTO_TEST_CASE(vortex_leaves_through_outflow)
{
  FlowParameters parameters         = jet();
  parameters.viscosity              = 1e-3;
  parameters.lower.axial_velocity   = "1";
  parameters.initial_axial_velocity = "1 + exp(-20*(r^2 + (y - 1)^2))";
  FlowSolver flow(parameters, MPI_COMM_WORLD);
  for (int step = 0; step < 150; ++step)
    flow.advance(step * 0.02, 0.02);
  // What remains is the uniform stream of energy rho/2 pi R^2 L.
  BOOST_TEST(kinetic_energy(flow.velocity(), 1.) == M_PI,
             boost::test_tools::tolerance(2e-3));
}

BOOST_AUTO_TEST_CASE(non_finite_fields_are_noticed)
{
  FlowSolver flow(jet(), MPI_COMM_WORLD);
  BOOST_TEST(flow.finite());
  if (flow.grid().is_last_rank())
    flow.velocity().y(flow.grid().end_row() - 1, 3) = std::nan("");
  BOOST_TEST(!flow.finite());
}

BOOST_AUTO_TEST_CASE(contradictions_are_refused)
{
  FlowParameters parameters = jet();
  parameters.upper.kind     = SideKind::no_slip;
  BOOST_TEST(contains(error_of(parameters), "m^3/s more in than out"));
  parameters            = jet();
  parameters.upper.kind = SideKind::periodic;
  BOOST_TEST(contains(error_of(parameters), "periodic"));
  parameters           = jet();
  parameters.viscosity = 1.;
  parameters.viscous   = ViscousTreatment::explicit_;
  BOOST_TEST(contains(error_of(parameters), "limit of explicit viscosity"));
  BOOST_TEST(error_of(jet()).empty());
}

BOOST_AUTO_TEST_CASE(parameters_from_a_file)
{
  ParameterHandler prm;
  FlowParameters::declare(prm);
  prm.read_text("subsection Fluid\n"
                "  set Density = 1 g/cm^3\n"
                "  set Time scheme = ab2\n"
                "  subsection Grid\n"
                "    set Axial breakpoints = 0, 20 mm\n"
                "    set Axial spacings = 1 mm\n"
                "  end\n"
                "  subsection Upper boundary\n"
                "    set Type = pressure\n"
                "    set Pressure = sin(t)\n"
                "  end\n"
                "end\n",
                "test");
  FlowParameters parameters;
  parameters.parse(prm);
  prm.throw_errors();
  BOOST_TEST(parameters.density == 1000., boost::test_tools::tolerance(1e-14));
  BOOST_TEST((parameters.scheme == TimeScheme::ab2));
  BOOST_TEST((parameters.upper.kind == SideKind::pressure));
  BOOST_TEST(parameters.upper.pressure == "sin(t)");
  BOOST_TEST(parameters.grid.y.breakpoints[1] == 0.02,
             boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_SUITE_END()
