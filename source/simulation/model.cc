#include "ephyra/simulation/model.h"

#include "ephyra/simulation/body_model.h"
#include "ephyra/simulation/flow_model.h"
#include "ephyra/simulation/statics_model.h"
#include "ephyra/simulation/swimmer_model.h"
#include "ephyra/simulation/tissue_model.h"

namespace ephyra::simulation
{
  std::unique_ptr<Model>
  make_model(const Scene &scene, const MPI_Comm comm)
  {
    if (scene.elasticity && scene.flow)
      return std::make_unique<SwimmerModel>(scene, comm);
    if (scene.elasticity && scene.statics)
      return std::make_unique<StaticsModel>(scene, comm);
    if (scene.elasticity)
      return std::make_unique<BodyModel>(scene, comm);
    if (scene.flow)
      return std::make_unique<FlowModel>(scene, comm);
    return std::make_unique<TissueModel>(scene, comm);
  }
} // namespace ephyra::simulation
