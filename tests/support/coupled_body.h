#pragma once

#include "ephyra/coupling/deformable_body.h"
#include "ephyra/coupling/fluid_structure.h"
#include "ephyra/coupling/wet_surface.h"

#include <memory>
#include <vector>

namespace ephyra::test
{
  /// A body in a flow that wets its outer side, and the scheme that couples
  /// both.
  struct CoupledBody
  {
    void
    couple(const elasticity::ElasticitySolver::Parameters &mechanics,
           const splines::NurbsPatch<2>                   &patch,
           const fluid::FlowParameters                    &fluid,
           const immersed_boundary::Parameters            &immersed_boundary,
           const coupling::CouplingParameters             &coupling)
    {
      flow = std::make_unique<fluid::FlowSolver>(fluid, MPI_COMM_WORLD);
      body = std::make_unique<coupling::DeformableBody>(
        mechanics, patch, MPI_COMM_SELF, MPI_COMM_WORLD);
      surface = std::make_unique<coupling::WetSurface>(
        immersed_boundary,
        patch,
        std::vector<splines::Side>{splines::Side::theta2_1},
        *flow);
      scheme =
        coupling::make_fluid_structure_scheme(coupling, *flow, *body, *surface);
    }

    std::unique_ptr<fluid::FlowSolver>        flow;
    std::unique_ptr<coupling::DeformableBody> body;
    std::unique_ptr<coupling::WetSurface>     surface;
    std::unique_ptr<coupling::Scheme>         scheme;
  };
} // namespace ephyra::test
