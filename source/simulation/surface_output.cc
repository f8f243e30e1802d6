#include "ephyra/simulation/surface_output.h"

#include "ephyra/elasticity/boundary_conditions.h"

#include <algorithm>

namespace ephyra::simulation
{
  SurfaceOutput::SurfaceOutput(const coupling::DeformableBody &body,
                               coupling::WetSurface           &surface,
                               const fluid::FlowSolver        &flow)
    : body(body)
    , surface(surface)
    , flow(flow)
  {
    const splines::NurbsPatch<2> &patch = body.mechanics().body().patch();
    for (std::size_t k = 0; k < surface.sides().size(); ++k)
      {
        const splines::Side side = surface.sides()[k];
        sides.push_back({elasticity::name(side),
                         static_cast<int>(k),
                         patch.side_control_points(side),
                         splines::BezierExtraction<1>(patch.side(side))});
        if (side == splines::Side::theta2_0)
          inner_curve = static_cast<int>(k);
      }
  }

  double
  SurfaceOutput::interpolate(const int                  curve,
                             const double               theta,
                             const std::vector<double> &values) const
  {
    const auto &markers = surface.markers();
    const int   first   = markers.first_of_curve()[curve];
    const int   last    = markers.first_of_curve()[curve + 1] - 1;
    int         k       = first;
    while (k < last && markers.theta(k + 1) < theta)
      ++k;
    if (k == last || theta <= markers.theta(first))
      return values[k];
    const double s =
      (theta - markers.theta(k)) / (markers.theta(k + 1) - markers.theta(k));
    return (1. - s) * values[k] + s * values[k + 1];
  }

  void
  SurfaceOutput::write_profiles(const double time, RunOutput &output) const
  {
    if (inner_curve < 0)
      return;
    surface.evaluate_loads(flow);
    LineProfile::write(
      "pressure",
      time,
      [&](const double theta) {
        return interpolate(inner_curve, theta, surface.loads().wall_pressure());
      },
      output);
  }

  void
  SurfaceOutput::write_fields(const double time, RunOutput &output) const
  {
    surface.evaluate_loads(flow);
    const auto               &traction = surface.loads().traction();
    const std::size_t         n        = traction.size() / 2;
    const std::vector<double> radial(traction.begin(), traction.begin() + n);
    const std::vector<double> axial(traction.begin() + n, traction.end());
    const std::vector<double> position = body.motion().position;
    for (const WetSide &side : sides)
      {
        BezierOutput        cells;
        std::vector<double> points;
        for (const int i : side.control_points)
          points.insert(points.end(), {position[2 * i], position[2 * i + 1]});
        cells.name                 = side.name;
        cells.parametric_dimension = 1;
        side.extraction.write_cells(cells, points);
        std::vector<double> tractions, pressures;
        for (const auto &theta : side.extraction.sample_points())
          {
            tractions.push_back(interpolate(side.curve, theta[0], radial));
            tractions.push_back(interpolate(side.curve, theta[0], axial));
            pressures.push_back(interpolate(
              side.curve, theta[0], surface.loads().wall_pressure()));
          }
        cells.point_fields.push_back(
          {"traction [Pa]", 2, side.extraction.interpolate(tractions, 2)});
        cells.point_fields.push_back(
          {"pressure [Pa]", 1, side.extraction.interpolate(pressures, 1)});
        output.add_fields("surface_" + side.name, time, cells);
      }
  }
} // namespace ephyra::simulation
