#include "ephyra/simulation/build_body.h"

#include "ephyra/base/log.h"
#include "ephyra/base/mpi.h"
#include "ephyra/coupling/nerve_net.h"
#include "ephyra/coupling/prescribed_muscle.h"

namespace ephyra::simulation
{
  std::unique_ptr<coupling::DeformableBody>
  build_body(const Scene               &scene,
             const geometry::BodyPatch &shape,
             const MPI_Comm             comm)
  {
    const int  n_unknowns = 2 * shape.patch.n_control_points();
    const bool distributed =
      mpi::size(comm) > 1 && n_unknowns >= scene.distributed_unknowns;
    log().line(
      "Body: " + shape.shape + ", " + std::to_string(n_unknowns) +
      " unknowns, " +
      (distributed ? "distributed over the ranks" : "computed on every rank"));
    auto body = std::make_unique<coupling::DeformableBody>(
      scene.mechanics, shape.patch, distributed ? comm : MPI_COMM_SELF, comm);
    log().line("Body: " + body->mechanics().body().description());
    if (scene.mechanics.chosen_rho_infinity &&
        scene.mechanics.rho_infinity == 0.)
      log().line("Body: lighter than the fluid; Spectral radius 0 damps its "
                 "fast modes.");

    const auto &points = body->mechanics().body().activation_points();
    if (scene.muscle == Scene::Muscle::prescribed)
      body->set_activation_source(
        std::make_unique<coupling::PrescribedMuscle>(scene.activation, points));
    else if (scene.muscle == Scene::Muscle::nerve_net)
      body->set_activation_source(std::make_unique<coupling::NerveNet>(
        scene.tissue, shape.patch, scene.nested_elements, points, comm));
    return body;
  }
} // namespace ephyra::simulation
