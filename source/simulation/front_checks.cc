#include "ephyra/simulation/front_checks.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/splines/nested_patch.h"

namespace ephyra::simulation
{
  namespace
  {
    using electrophysiology::ElectrophysiologySolver;

    splines::NurbsPatch<1>
    tissue_line(const Scene &scene)
    {
      if (!scene.elasticity)
        return geometry::create_curve(scene.tissue_line).curve;
      const auto patch = geometry::create_body(scene.body).patch;
      return splines::NestedPatch(patch,
                                  splines::Side::theta2_0,
                                  scene.nested_elements,
                                  patch.degree(0))
        .patch();
    }
  } // namespace

  void
  check_front(Scene &scene)
  {
    ElectrophysiologySolver::Parameters parameters = scene.tissue;
    parameters.linear_solver =
      electrophysiology::DiffusionStepper::LinearSolver::narrow_band;
    try
      {
        const std::string problem =
          scene.single_cell ? ElectrophysiologySolver(parameters, MPI_COMM_SELF)
                                .resolution_problem()
                            : ElectrophysiologySolver(
                                parameters, tissue_line(scene), MPI_COMM_SELF)
                                .resolution_problem();
        if (!problem.empty())
          scene.warnings.push_back(problem);
      }
    catch (const InputError &)
      {
        // Told where the tissue is built.
      }
  }
} // namespace ephyra::simulation
