#pragma once

#include "ephyra/fluid/flow_solver.h"

#include <cmath>
#include <functional>

namespace exact_flows
{
  using namespace ephyra;
  using namespace ephyra::fluid;

  using Component = FlowSolver::Component;

  /// Unit density and radius; `n` cells on the radius, uniform.
  inline FlowParameters
  unit_pipe(const int n, const double length, const double viscosity)
  {
    FlowParameters parameters;
    parameters.density            = 1;
    parameters.viscosity          = viscosity;
    parameters.grid.r.breakpoints = {0., 1.};
    parameters.grid.r.spacings    = {1. / n};
    parameters.grid.y.breakpoints = {0., length};
    parameters.grid.y.spacings    = {1. / n};
    parameters.lower.kind = parameters.upper.kind = SideKind::periodic;
    return parameters;
  }

  /// Root of the volume integral of (v - exact)^2 over that of exact^2.
  inline double
  relative_error(const FlowSolver &flow,
                 const Component  &v_r,
                 const Component  &v_y)
  {
    const StaggeredGrid &grid  = flow.grid();
    double               error = 0, size = 0;
    const auto           add =
      [&](const double volume, const double value, const double exact) {
        error += volume * std::pow(value - exact, 2);
        size += volume * exact * exact;
      };
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      for (int j = 0; j < grid.y.n_cells; ++j)
        {
          add(grid.r.face[i] * grid.r.centre_gap[i] * grid.y.width[j],
              flow.velocity().r(i, j),
              v_r(grid.r.face[i], grid.y.centre[j]));
          add(grid.r.centre[i] * grid.r.width[i] * grid.y.centre_gap[j],
              flow.velocity().y(i, j),
              v_y(grid.r.centre[i], grid.y.face[j]));
        }
    return std::sqrt(mpi::sum(error, MPI_COMM_WORLD) /
                     mpi::sum(size, MPI_COMM_WORLD));
  }

  /// Decaying Stokes eigenmode of a periodic pipe of radius 1: wave number k,
  /// radial eigenvalue beta (verification against computed values of beta).
  struct StokesMode
  {
    double k, beta, viscosity;
    bool   slip;
    /// Moved by a quarter of a wavelength: no flow through and no stress at
    /// y = 0 and pi/k, where slip walls can stand.
    bool between_walls = false;

    double
    rate() const
    {
      return viscosity * (k * k + beta * beta);
    }
    Component
    v_r(const double t) const
    {
      return [=, *this](const double r, const double y) {
        const double wall =
          slip ? 0. : std::cyl_bessel_i(1, k * r) / std::cyl_bessel_i(1, k);
        const double core =
          slip ? std::cyl_bessel_j(1, beta * r)
               : std::cyl_bessel_j(1, beta * r) / std::cyl_bessel_j(1, beta);
        return (core - wall) *
               (between_walls ? std::cos(k * y) : std::sin(k * y)) *
               std::exp(-rate() * t);
      };
    }
    Component
    v_y(const double t) const
    {
      return [=, *this](const double r, const double y) {
        const double wall =
          slip ? 0. : k * std::cyl_bessel_i(0, k * r) / std::cyl_bessel_i(1, k);
        const double core = slip ? beta * std::cyl_bessel_j(0, beta * r)
                                 : beta * std::cyl_bessel_j(0, beta * r) /
                                     std::cyl_bessel_j(1, beta);
        return (core - wall) *
               (between_walls ? -std::sin(k * y) : std::cos(k * y)) / k *
               std::exp(-rate() * t);
      };
    }
  };

  inline void
  run(FlowSolver &flow, const double end_time, const int n_steps)
  {
    const double dt = end_time / n_steps;
    for (int step = 0; step < n_steps; ++step)
      flow.advance(step * dt, dt);
  }
} // namespace exact_flows
