#pragma once

#include "ephyra/coupling/deformable_body.h"
#include "ephyra/geometry/body_patch.h"
#include "ephyra/simulation/scene.h"

#include <mpi.h>

#include <memory>

namespace ephyra::simulation
{
  /// The deformable body of a scene with the source of its activation. A small
  /// body is computed on every rank for itself, which is cheaper than sharing
  /// it; a large one is distributed over the ranks. The log says which.
  std::unique_ptr<coupling::DeformableBody>
  build_body(const Scene               &scene,
             const geometry::BodyPatch &shape,
             MPI_Comm                   comm);
} // namespace ephyra::simulation
