#pragma once

#include "ephyra/base/parameter_handler.h"
#include "ephyra/base/record.h"
#include "ephyra/fluid/flow_solver.h"
#include "ephyra/fluid/vortex_ring.h"

#include <string>
#include <vector>

namespace ephyra::simulation
{
  /// A part of the half plane whose vorticity is recorded (section "Flow region
  /// NAME").
  struct FlowRegion
  {
    std::string              name;
    fluid::Region            limits;
    std::vector<fluid::Side> flux_sides; ///< whose vorticity flux is recorded
    fluid::VorticitySign     ring = fluid::VorticitySign::all; ///< all: no ring
    double                   ring_level = 0.1; ///< of the strongest vorticity

    static void
    declare(ParameterHandler &prm);
    /// All sections of a file.
    static std::vector<FlowRegion>
    parse_all(ParameterHandler &prm);

    /// "NAME circulation [m^2/s]" and what else the section asks for, for the
    /// statistics; collective.
    void
    evaluate(const fluid::FlowSolver &flow, Record &record) const;
  };
} // namespace ephyra::simulation
