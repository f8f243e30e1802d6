#pragma once

#include "ephyra/base/parameter_handler.h"
#include "ephyra/base/time_control.h"
#include "ephyra/coupling/fluid_structure.h"
#include "ephyra/diagnostics/cycles.h"
#include "ephyra/elasticity/elasticity_solver.h"
#include "ephyra/elasticity/statics.h"
#include "ephyra/electrophysiology/electrophysiology_solver.h"
#include "ephyra/electrophysiology/prescribed_activation.h"
#include "ephyra/fluid/flow_parameters.h"
#include "ephyra/geometry/shapes.h"
#include "ephyra/immersed_boundary/parameters.h"
#include "ephyra/immersed_boundary/rigid_body.h"
#include "ephyra/simulation/body_probes.h"
#include "ephyra/simulation/flow_probes.h"
#include "ephyra/simulation/flow_regions.h"
#include "ephyra/simulation/run_output.h"
#include "ephyra/simulation/tissue_motion.h"
#include "ephyra/simulation/tissue_probes.h"
#include "ephyra/simulation/tracers.h"

#include <string>
#include <vector>

namespace ephyra::simulation
{
  /// A parameter file in memory: which physics a scene has, and the parameters
  /// of those. Only the sections of physics that are on are looked at.
  struct Scene
  {
    enum class Muscle
    {
      none,
      prescribed,
      nerve_net
    };

    // --- section Scene ----------------------------------------------------
    bool                     electrophysiology = false;
    bool                     elasticity        = false;
    bool                     statics = false; ///< equilibrium instead of motion
    bool                     flow    = false;
    bool                     rigid_bodies = false;
    Muscle                   muscle       = Muscle::none;
    double                   refinement = 1; ///< of what "Refined parts" names
    std::vector<std::string> refined_parts;  ///< of the scene, by their names
    int nested_elements      = 34; ///< of the line in each element of the body
    int distributed_unknowns = 20000; ///< of a body: from here on it is shared
                                      ///< among the ranks

    // --- loop -------------------------------------------------------------
    TimeControl::Parameters time;
    double                  wall_time_limit   = 0; ///< s; 0: none
    int                     progress_interval = 100;
    bool                    cut_backs         = true;
    OutputParameters        output;

    // --- physics ----------------------------------------------------------
    geometry::BodyParameters  body;
    BodySampling              body_sampling;
    geometry::CurveParameters tissue_line;
    TissueMotion::Parameters  tissue_motion;
    TissueSampling            tissue_sampling;
    bool                      single_cell = false;
    std::vector<double> crossing_points; ///< theta^1 of probes of the tissue
    double              crossing_level = 0.02; ///< V
    electrophysiology::ElectrophysiologySolver::Parameters tissue;
    electrophysiology::PrescribedActivation::Parameters    activation;
    elasticity::ElasticitySolver::Parameters               mechanics;
    elasticity::StaticsSolver::Parameters                  equilibrium;
    fluid::FlowParameters                                  fluid;
    FlowSampling                                           flow_sampling;
    std::vector<FlowRegion>                                flow_regions;
    std::vector<TracerParameters>                          tracers;
    immersed_boundary::Parameters                          immersed_boundary;
    std::vector<immersed_boundary::RigidBody::Parameters>  bodies;
    coupling::CouplingParameters                           coupling;
    diagnostics::CycleParameters                           cycles;

    std::vector<std::string> warnings; ///< for the log

    static void
    declare(ParameterHandler &prm);
    /// Reads the values and checks them against each other; errors are added
    /// to those of @p prm.
    void
    parse(ParameterHandler &prm);

    /// What is on, in words, for the log.
    std::string
    description() const;

  private:
    /// The refinement of one of the parts that can be refined: 1 where it is
    /// not named.
    double
    refinement_of(const std::string &part) const;
  };
} // namespace ephyra::simulation
