// Decaying Stokes eigenmodes of a periodic pipe. The eigenvalues beta are
// roots of k I0(k) J1(beta) = beta J0(beta) I1(k) (no-slip wall) and of
// J1(beta) = 0 (slip wall), computed independently.
#include "exact_flows.h"

#include <boost/test/unit_test.hpp>

using namespace exact_flows;

namespace
{
  const StokesMode no_slip_mode{M_PI, 4.8055067166, 0.1, false};
  const StokesMode slip_mode{M_PI, 3.8317059702, 0.1, true};

  /// The mode between slip walls at y = 0 and 1, on a grid stretched in both
  /// directions.
  StokesMode
  between_walls(StokesMode mode)
  {
    mode.between_walls = true;
    return mode;
  }

  FlowParameters
  stretched_box(const int n)
  {
    FlowParameters parameters     = unit_pipe(n, 1., no_slip_mode.viscosity);
    parameters.grid.r.breakpoints = {0., 0.5, 1.};
    parameters.grid.r.spacings    = {0.8 / n, 1.3 / n, 0.7 / n};
    parameters.grid.y.breakpoints = {0., 0.4, 1.};
    parameters.grid.y.spacings    = {1.2 / n, 0.7 / n, 1.3 / n};
    parameters.lower.kind = parameters.upper.kind = SideKind::free_slip;
    return parameters;
  }

  double
  mode_error(const StokesMode &mode,
             FlowParameters    parameters,
             const double      end_time,
             const int         n_steps)
  {
    parameters.outer.kind = mode.slip ? SideKind::free_slip : SideKind::no_slip;
    parameters.convection = false;
    FlowSolver flow(parameters, MPI_COMM_WORLD);
    flow.set_initial_velocity(mode.v_r(0), mode.v_y(0));
    run(flow, end_time, n_steps);
    return relative_error(flow, mode.v_r(end_time), mode.v_y(end_time));
  }
} // namespace

BOOST_AUTO_TEST_SUITE(stokes_modes)

BOOST_AUTO_TEST_CASE(order_in_space)
{
  for (const StokesMode &mode : {no_slip_mode, slip_mode})
    for (const bool stretched : {false, true})
      {
        double previous = 0;
        for (const int n : {12, 24, 48})
          {
            FlowParameters parameters = unit_pipe(n, 2., mode.viscosity);
            parameters.viscous        = ViscousTreatment::implicit;
            if (stretched)
              {
                parameters.grid.r.breakpoints = {0., 0.5, 1.};
                parameters.grid.r.spacings    = {0.7 / n, 1.4 / n, 0.5 / n};
              }
            const double error = mode_error(mode, parameters, 0.2, 2 * n);
            if (previous > 0)
              {
                BOOST_TEST_MESSAGE((mode.slip ? "slip" : "no-slip")
                                   << (stretched ? ", stretched" : ", uniform")
                                   << ", n = " << n << ": error " << error
                                   << ", order "
                                   << std::log2(previous / error));
                BOOST_TEST(std::log2(previous / error) > 1.85);
              }
            previous = error;
          }
        BOOST_TEST(previous < 2e-3);
      }
}

BOOST_AUTO_TEST_CASE(order_on_grids_stretched_in_both_directions)
{
  // Cells and steps together: steps as the cells where viscosity is implicit,
  // as their squares where it is explicit.
  for (const StokesMode &mode :
       {between_walls(no_slip_mode), between_walls(slip_mode)})
    for (const TimeScheme scheme : {TimeScheme::rk3, TimeScheme::ab2})
      for (const ViscousTreatment viscous :
           {ViscousTreatment::explicit_, ViscousTreatment::implicit})
        {
          const bool implicit = viscous == ViscousTreatment::implicit;
          double     previous = 0;
          for (const int n : {8, 16, 32})
            {
              FlowParameters parameters = stretched_box(n);
              parameters.scheme         = scheme;
              parameters.viscous        = viscous;
              const int n_steps =
                implicit ? 2 * n : n * n / (scheme == TimeScheme::rk3 ? 4 : 1);
              const double error = mode_error(mode, parameters, 0.2, n_steps);
              BOOST_TEST_MESSAGE(
                (mode.slip ? "slip" : "no-slip")
                << (scheme == TimeScheme::rk3 ? ", rk3" : ", ab2")
                << (implicit ? ", implicit" : ", explicit") << ", n = " << n
                << ": error " << error << ", order "
                << std::log2(previous / error));
              if (previous > 0)
                BOOST_TEST(std::log2(previous / error) > 1.85);
              previous = error;
            }
        }
}

BOOST_AUTO_TEST_CASE(order_in_time)
{
  // Errors in time alone: against a run with 16 times as many steps.
  for (const bool stretched : {false, true})
    for (const TimeScheme scheme : {TimeScheme::rk3, TimeScheme::ab2})
      for (const ViscousTreatment viscous :
           {ViscousTreatment::explicit_, ViscousTreatment::implicit})
        {
          const bool       implicit = viscous == ViscousTreatment::implicit;
          const StokesMode mode =
            stretched ? between_walls(no_slip_mode) : no_slip_mode;
          FlowParameters parameters =
            stretched ? stretched_box(10)
                      : unit_pipe(12, 2., no_slip_mode.viscosity);
          parameters.scheme     = scheme;
          parameters.viscous    = viscous;
          parameters.convection = false;
          const int n0 = implicit ? 10 : (scheme == TimeScheme::rk3 ? 12 : 30);
          const double end = 0.2;

          std::vector<std::unique_ptr<FlowSolver>> flows;
          for (const int n : {n0, 2 * n0, 4 * n0, 64 * n0})
            {
              flows.push_back(
                std::make_unique<FlowSolver>(parameters, MPI_COMM_WORLD));
              flows.back()->set_initial_velocity(mode.v_r(0), mode.v_y(0));
              run(*flows.back(), end, n);
            }
          const StaggeredGrid &grid       = flows[0]->grid();
          const auto           difference = [&](const FlowSolver &flow) {
            double sum = 0;
            for (int i = grid.first_row; i < grid.end_row(); ++i)
              for (int j = 0; j < grid.y.n_cells; ++j)
                sum +=
                  std::pow(
                    flow.velocity().y(i, j) - flows[3]->velocity().y(i, j), 2) +
                  std::pow(
                    flow.velocity().r(i, j) - flows[3]->velocity().r(i, j), 2);
            return std::sqrt(mpi::sum(sum, MPI_COMM_WORLD));
          };
          const double coarse = difference(*flows[0]),
                       middle = difference(*flows[1]),
                       fine   = difference(*flows[2]);
          BOOST_TEST_MESSAGE((scheme == TimeScheme::rk3 ? "rk3" : "ab2")
                             << (stretched ? ", stretched" : ", uniform")
                             << (implicit ? ", implicit" : ", explicit")
                             << ": orders " << std::log2(coarse / middle)
                             << ", " << std::log2(middle / fine) << ", error "
                             << fine);
          BOOST_TEST(std::log2(middle / fine) > 1.85);
        }
}

BOOST_AUTO_TEST_CASE(one_implicit_direction)
{
  // Cells flat in one direction make that one implicit; the step is then an
  // order of magnitude above the explicit limit.
  for (const bool flat_in_y : {true, false})
    {
      double previous = 0;
      for (const int n : {8, 16, 32})
        {
          FlowParameters parameters = unit_pipe(n, 2., no_slip_mode.viscosity);
          (flat_in_y ? parameters.grid.y : parameters.grid.r).spacings = {
            1. / (8 * n)};
          parameters.convection = false;
          FlowSolver flow(parameters, MPI_COMM_WORLD);
          flow.set_initial_velocity(no_slip_mode.v_r(0), no_slip_mode.v_y(0));
          const int n_steps = n * n / 4;
          run(flow, 0.2, n_steps);
          BOOST_TEST(flow.implicit_directions().y == flat_in_y);
          BOOST_TEST(flow.implicit_directions().r == !flat_in_y);
          BOOST_TEST(0.2 / n_steps > 5 * flow.viscous_time_step_limit());
          const double error =
            relative_error(flow, no_slip_mode.v_r(0.2), no_slip_mode.v_y(0.2));
          BOOST_TEST_MESSAGE("implicit in " << (flat_in_y ? "y" : "r")
                                            << ", n = " << n << ": error "
                                            << error);
          if (previous > 0)
            BOOST_TEST(std::log2(previous / error) > 1.85);
          previous = error;
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()
