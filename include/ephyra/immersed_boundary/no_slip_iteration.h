#pragma once

#include "ephyra/base/step_status.h"
#include "ephyra/fluid/flow_solver.h"
#include "ephyra/immersed_boundary/direct_forcing.h"

#include <vector>

namespace ephyra::immersed_boundary
{
  /// Forces and projects a stage of the flow until the *projected* velocity
  /// meets the markers (the immersed boundary projection of Taira & Colonius
  /// 2007, 10.1016/j.jcp.2007.03.005, with the regularised forcing),
  ///   J P (u* + S F) = V,
  /// by GMRES on the marker forces, preconditioned from the right by the
  /// forcing's T. Every iteration costs one projection. A plain forcing leaves
  /// the slip that the projection brings back: large in the first steps of an
  /// impulsive start. Meant for verification.
  ///
  /// On entry @p F holds the plain forcing T (V - J u*) and the velocity is u*;
  /// on exit F holds the forcing and the velocity is projected. Converged where
  /// the root mean square of the slip over the markers has fallen below
  /// @p tolerance, m/s (StepStatus::residual is that slip); fails after
  /// @p most_iterations. Needs FlowSolver::keep_predicted(true). Collective.
  StepStatus
  converge_no_slip(fluid::FlowSolver         &flow,
                   unsigned int               stage,
                   const DirectForcing       &forcing,
                   const std::vector<double> &target,
                   double                     tolerance,
                   int                        most_iterations,
                   std::vector<double>       &F);
} // namespace ephyra::immersed_boundary
