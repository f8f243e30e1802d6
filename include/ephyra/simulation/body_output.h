#pragma once

#include "ephyra/coupling/deformable_body.h"
#include "ephyra/coupling/nerve_net.h"
#include "ephyra/simulation/body_fields.h"
#include "ephyra/simulation/body_probes.h"
#include "ephyra/simulation/line_profile.h"

#include <optional>

namespace ephyra::simulation
{
  /// Files about a deformable body: probes, profiles along its subumbrellar
  /// side (theta^2 = 0) and other lines, and fields. Shared by the scenes that have such a body.
  class BodyOutput
  {
  public:
    BodyOutput(coupling::DeformableBody &body, const BodySampling &sampling);

    void
    write_probes(double time, RunOutput &output) const;
    void
    write_profiles(double time, RunOutput &output) const;
    void
    write_fields(double time, RunOutput &output) const;

  private:
    BodyState
    state() const;

    coupling::DeformableBody  &body;
    BodyFields                 fields;
    LineProfile                side;
    BodyProbes                 probes;
    const coupling::NerveNet  *net;  ///< null: none
    std::optional<LineProfile> line; ///< of the nerve net
  };
} // namespace ephyra::simulation
