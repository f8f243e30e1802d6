#include "ephyra/simulation/body_output.h"

#include "ephyra/coupling/nerve_net.h"

namespace ephyra::simulation
{
  BodyOutput::BodyOutput(coupling::DeformableBody &body,
                         const BodySampling       &sampling)
    : body(body)
    , fields(body.mechanics().body().patch())
    , side(body.mechanics().body().patch(), splines::Side::theta2_0)
    , probes(sampling, body.mechanics().body().patch())
    , net(dynamic_cast<const coupling::NerveNet *>(body.activation()))
  {
    if (net)
      line = LineProfile(net->line());
  }

  BodyState
  BodyOutput::state() const
  {
    const elasticity::ElasticitySolver &solver = body.mechanics();
    return {solver.displacement(),
            solver.velocity(),
            [&solver](const double theta1, const double theta2) {
              return solver.fields(theta1, theta2);
            }};
  }

  void
  BodyOutput::write_probes(const double time, RunOutput &output) const
  {
    probes.write_probes(time, state(), output);
  }

  void
  BodyOutput::write_profiles(const double time, RunOutput &output) const
  {
    const auto &u = body.mechanics().displacement();
    side.write("radial_displacement", time, u, 2, 0, output);
    side.write("axial_displacement", time, u, 2, 1, output);
    probes.write_lines(time, state(), output);
    if (!net)
      return;
    line->write("potential", time, net->tissue().potential(), 1, 0, output);
    std::vector<double> gamma;
    net->tissue().activation(time, gamma);
    line->write("activation", time, gamma, 1, 0, output);
  }

  void
  BodyOutput::write_fields(const double time, RunOutput &output) const
  {
    output.add_fields("body", time, fields.evaluate(state()));
  }
} // namespace ephyra::simulation
