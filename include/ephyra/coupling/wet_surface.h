#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/base/step_status.h"
#include "ephyra/coupling/body_motion.h"
#include "ephyra/fluid/flow_solver.h"
#include "ephyra/immersed_boundary/direct_forcing.h"
#include "ephyra/immersed_boundary/interior_fluid.h"
#include "ephyra/immersed_boundary/markers.h"
#include "ephyra/immersed_boundary/surface_loads.h"
#include "ephyra/linear_algebra/sparse_matrix.h"
#include "ephyra/splines/nurbs_patch.h"

#include <Eigen/SparseCore>

#include <memory>
#include <vector>

namespace ephyra::coupling
{
  /// The wetted surface of a deformable patch in a flow: markers, forcing and
  /// loads in terms of the control values of the patch. With B the values of
  /// the patch's basis at the markers,
  ///   V = B v,   F = T (V - J u*),   u = u* + S F,
  /// or, where viscosity is implicit, the same behind its operator A,
  /// and the impulse that the fluid receives in a step is rho D F at the
  /// markers, D = diag(w) (see immersed_boundary::DirectForcing). Everything
  /// here is replicated on all ranks.
  class WetSurface
  {
  public:
    using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    WetSurface(const immersed_boundary::Parameters &parameters,
               const splines::NurbsPatch<2>        &patch,
               const std::vector<splines::Side>    &wet_sides,
               const fluid::FlowSolver             &flow);

    /// Before the first step of a scheme that uses fluid_load(): chooses the
    /// load, with a line in the log, and builds what it needs. Throws InputError
    /// for `Immersed boundary/Load = forcing` in a flow with several stages.
    void
    prepare_fluid_load(const fluid::FlowSolver &flow);
    /// At the start of a step, with the motion of the body and the flow there;
    /// collective.
    void
    begin_step(const BodyMotion &start, const fluid::FlowSolver &flow);
    /// Markers at the given motion; stencils follow the positions. Where the
    /// surface has been stretched beyond the largest marker spacing, the markers
    /// are placed anew, closely enough for all shapes for which that was done.
    /// Throws DivergedError where markers leave the grid, or are twice as far
    /// apart as allowed at once.
    void
    set_geometry(const BodyMotion &motion);
    /// The shapes for which the markers have been placed.
    void
    serialize(Archive &archive);
    /// New velocity and acceleration, positions and stencils kept.
    void
    set_motion(const BodyMotion &motion);

    /// Keeps J u* of the stage that was predicted, and where viscosity is
    /// implicit its operator, for the calls below; collective.
    void
    sample(const fluid::FlowSolver &flow, unsigned int stage);
    /// Forcing that gives the flow the velocity of the markers.
    void
    solve_forcing();
    /// velocity() of the flow += S F (A^-1 S F where viscosity is implicit),
    /// projected; with `No-slip iterations` F is improved until the projected
    /// velocity meets the markers, which may fail. After solve_forcing(), for
    /// the stage that was predicted. Collective.
    StepStatus
    force_and_project(fluid::FlowSolver &flow, unsigned int stage);

    /// Work of the forcing on the flow in a stage between two velocities, J;
    /// collective.
    double
    forcing_work(const fluid::VelocityField &before,
                 const fluid::VelocityField &after) const;

    /// -rho B^T D F / dt: what the body receives for the forcing in a step (or
    /// a stage) of length @p dt, N at the control points.
    void
    add_forcing_load(double dt, std::vector<double> &load) const;

    /// The forcing's load as a function of the control velocities, without the
    /// constant part: K = rho B^T D T B / dt, so that
    /// -rho B^T D F / dt = -K v + rho B^T D T J u* / dt. Where viscosity is
    /// implicit, every marker acts on every other one through it. After
    /// sample().
    Matrix
    forcing_resistance(double dt) const;

    /// Traction at the markers by the probes, see loads(); collective.
    void
    evaluate_loads(const fluid::FlowSolver &flow);
    /// The same as consistent nodal forces, N; collective.
    void
    probe_load(const fluid::FlowSolver &flow, std::vector<double> &load);
    /// The load of the fluid at the control points after force_and_project()
    /// of a step of length @p dt, N, from the probes or from forcing and
    /// interior fluid (`Immersed boundary/Load`); collective. After
    /// prepare_fluid_load().
    void
    fluid_load(const fluid::FlowSolver &flow,
               double                   dt,
               std::vector<double>     &load);
    /// Roughness of nodal loads f: with the tractions t_i = f_i / (area of R_i)
    /// along the wet sides, root of sum |t_{i-1} - 2 t_i + t_{i+1}|^2 over
    /// 4 (sum |t_i|^2)^(1/2); 1 for a load that alternates, 0 for none.
    double
    roughness(const std::vector<double> &load) const;

    /// Pairs of unknowns that forcing_resistance() couples: those of markers
    /// less than a few cells apart, with a margin for deformation; with
    /// @p implicit_viscosity all of the wet sides.
    linear_algebra::SparsityPattern
    coupling_pattern(bool implicit_viscosity) const;

    /// Slip after the projection: root mean square of J u - V over that of V
    /// (0 where V vanishes); collective.
    double
    slip(const fluid::VelocityField &velocity) const;

    /// Wetted sides of the patch; side k is curve k of the markers.
    const std::vector<splines::Side> &
    sides() const
    {
      return wet_sides;
    }
    const immersed_boundary::Markers &
    markers() const
    {
      return *the_markers;
    }
    const immersed_boundary::SurfaceLoads &
    loads() const
    {
      return *surface_loads;
    }
    double
    largest_spacing() const;

    bool
    reports_roughness() const
    {
      return parameters.load_roughness;
    }

  private:
    void
    assemble_shape();
    /// For all shapes so far.
    void
    place_markers();
    void
    follow_stretch(const BodyMotion &motion);
    /// What the fluid inside gives to the body acts on its surface: the nodal
    /// forces across the thickness are moved to the wet sides theta^2 = 0 and 1
    /// with their sum and, between two sides, their moment.
    void
    assemble_to_surface();
    /// Velocities of the markers, all radial components first.
    std::vector<double>
    target() const;

    const immersed_boundary::Parameters               parameters;
    const splines::NurbsPatch<2>                      patch;
    const std::vector<splines::Side>                  wet_sides;
    const fluid::StaggeredGrid                       &grid;
    const double                                      density;
    std::unique_ptr<immersed_boundary::Markers>       the_markers;
    std::unique_ptr<immersed_boundary::DirectForcing> forcing;
    std::unique_ptr<immersed_boundary::SurfaceLoads>  surface_loads;
    std::unique_ptr<immersed_boundary::InteriorFluid> interior; ///< or null
    const int                                         n_control_points;
    Matrix shape;      ///< B, one component
    Matrix to_surface; ///< control points to those of wet sides
    std::vector<std::vector<double>> shapes; ///< control positions
    std::vector<double>              frozen_position;
    std::vector<double>              Ju, F; ///< of markers
  };
} // namespace ephyra::coupling
