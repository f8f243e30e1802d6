#pragma once

#include "ephyra/simulation/benchmark_report.h"

namespace ephyra::simulation
{
  /// Steps of flows of some millions of cells: time schemes, treatment of
  /// viscosity, Poisson solvers, a body with markers, a grid that fits the
  /// cache. About half a minute on one core.
  void
  run_flow_benchmark(BenchmarkReport &report, MPI_Comm comm);
} // namespace ephyra::simulation
