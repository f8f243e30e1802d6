#include "ephyra/simulation/body_fields.h"

#include "ephyra/splines/control_vector.h"

namespace ephyra::simulation
{
  BodyFields::BodyFields(const splines::NurbsPatch<2> &patch)
    : extraction(patch)
  {
    reference = splines::control_vector(patch);
  }

  BezierOutput
  BodyFields::evaluate(const BodyState &state) const
  {
    BezierOutput        output;
    std::vector<double> position(reference);
    for (std::size_t i = 0; i < position.size(); ++i)
      position[i] += state.displacement[i];
    extraction.write_cells(output, position);
    output.name = "body";
    extraction.write_field(output, "displacement [m]", state.displacement, 2);
    extraction.write_field(output, "velocity [m/s]", state.velocity, 2);

    // What is no spline is sampled in each cell.
    std::vector<double> activation, pattern, J, stress;
    for (const auto &theta : extraction.sample_points())
      {
        const elasticity::PointFields f = state.fields(theta[0], theta[1]);
        activation.push_back(f.activation);
        pattern.push_back(f.pattern);
        J.push_back(f.J);
        for (const int k : {0, 3, 4, 1}) // rr, yy, hoop, ry
          stress.push_back(f.cauchy[k]);
      }
    const auto add = [&](const std::string         &name,
                         const std::vector<double> &samples,
                         const int                  n_components) {
      output.point_fields.push_back(
        {name, n_components, extraction.interpolate(samples, n_components)});
    };
    add("activation [-]", activation, 1);
    add("muscle pattern [-]", pattern, 1);
    add("J [-]", J, 1);
    add("Cauchy stress rr, yy, hoop, ry [Pa]", stress, 4);
    return output;
  }
} // namespace ephyra::simulation
