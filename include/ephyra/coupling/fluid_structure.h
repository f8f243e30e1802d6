#pragma once

#include "ephyra/base/parameter_handler.h"
#include "ephyra/coupling/acceleration.h"
#include "ephyra/coupling/added_mass.h"
#include "ephyra/coupling/deformable_body.h"
#include "ephyra/coupling/scheme.h"
#include "ephyra/coupling/wet_surface.h"
#include "ephyra/fluid/flow_solver.h"

#include <memory>
#include <string>
#include <vector>

namespace ephyra::coupling
{
  /// Section "Coupling".
  struct CouplingParameters
  {
    enum class SchemeKind
    {
      automatic, ///< forcing as load where the body is not lighter and the
                 ///< flow has one stage, else added mass
      sequential,
      forcing_as_load,
      fixed_point,
      added_mass
    };
    enum class LoadKind
    {
      probes,
      forcing
    };

    SchemeKind    scheme     = SchemeKind::automatic;
    LoadKind      load       = LoadKind::probes; ///< sequential scheme
    AddedMassKind added_mass = AddedMassKind::full;
    double        tolerance  = 1e-2; ///< fixed point: relative change of load
    double        absolute_tolerance = 0; ///< N
    int           maximum_iterations = 50;
    Acceleration::Parameters acceleration;

    static void
    declare(ParameterHandler &prm);
    void
    parse(ParameterHandler &prm);
  };

  /// What the schemes for a deformable body in a flow share: the three parts
  /// and the way in which one step of the flow answers a motion of the body.
  class FluidStructureScheme : public Scheme
  {
  public:
    FluidStructureScheme(fluid::FlowSolver &flow,
                         DeformableBody    &body,
                         WetSurface        &surface);

    void
    serialize(Archive &archive) override;
    void
    evaluate(Record &record) override;
    void
    evaluate_iterations(Record &record) const override;

  protected:
    /// Nerve net and muscle first, then the explicit part of the flow (u*) and
    /// the geometry of the markers, frozen at the extrapolated position, both
    /// of the first stage.
    StepStatus
    prepare(double t, double dt);
    /// Lets WetSurface::forcing_resistance() into the matrix of the body: among
    /// neighbours, and from the first step of implicit viscosity on among all
    /// wet unknowns. In the constructor and after prepare() of a scheme that
    /// uses it.
    void
    allow_forcing_resistance();
    /// After prepare(), as often as asked: the step of the flow, from the same
    /// start, for a motion of the body that ends like @p end, and the load on
    /// the body at its end, N. The positions of the markers are extrapolated
    /// ones in every stage.
    StepStatus
    respond(const BodyMotion &end, std::vector<double> &new_load);
    /// Forcing for the present motion of the markers, and projection, for the
    /// stage that was predicted.
    StepStatus
    force_and_project(unsigned int stage);
    /// Body and flow go on to the new level.
    void
    accept(const std::vector<double> &new_load);

    fluid::FlowSolver  &flow;
    DeformableBody     &body;
    WetSurface         &surface;
    std::vector<double> load;           ///< at the last accepted level, N
    StepStatus          last;           ///< of the last accepted step
    double              relaxation = 1; ///< of its last iteration
    double              axial_load = 0; ///< N, of the last accepted step
    std::vector<double> forcing_work;   ///< of the stages of this step, J
    double              step_start = 0, step = 0; ///< of prepare(), s
    int                 flow_solves = 0; ///< steps of the flow since prepare()

  private:
    enum class Resistance
    {
      none,
      of_neighbours,
      of_all
    } allowed_resistance = Resistance::none;
  };

  /// |a - b| over |a|; 0 where both vanish, infinite where a does alone.
  double
  relative_difference(const std::vector<double> &a,
                      const std::vector<double> &b);

  std::unique_ptr<Scheme>
  make_fluid_structure_scheme(const CouplingParameters &parameters,
                              fluid::FlowSolver        &flow,
                              DeformableBody           &body,
                              WetSurface               &surface);
} // namespace ephyra::coupling
