#pragma once

#include "ephyra/coupling/deformable_body.h"
#include "ephyra/coupling/wet_surface.h"
#include "ephyra/simulation/line_profile.h"
#include "ephyra/splines/bezier_extraction.h"

#include <string>
#include <vector>

namespace ephyra::simulation
{
  /// What the flow does to the wetted sides of a body, by the probes: profiles
  /// of the pressure along theta^1 and the sides as Bézier curves with traction
  /// and pressure.
  class SurfaceOutput
  {
  public:
    SurfaceOutput(const coupling::DeformableBody &body,
                  coupling::WetSurface           &surface,
                  const fluid::FlowSolver        &flow);

    /// profiles/pressure.csv, on the side theta^2 = 0; collective.
    void
    write_profiles(double time, RunOutput &output) const;
    /// Series surface_SIDE; collective.
    void
    write_fields(double time, RunOutput &output) const;

  private:
    struct WetSide
    {
      std::string                  name;
      int                          curve; ///< of the markers
      std::vector<int>             control_points;
      splines::BezierExtraction<1> extraction;
    };
    /// A quantity of the markers of a curve at other parameters: linear in
    /// between, constant beyond the first and the last marker.
    double
    interpolate(int                        curve,
                double                     theta,
                const std::vector<double> &values) const;

    const coupling::DeformableBody &body;
    coupling::WetSurface           &surface;
    const fluid::FlowSolver        &flow;
    std::vector<WetSide>            sides;
    int                             inner_curve = -1; ///< of theta^2 = 0
  };
} // namespace ephyra::simulation
