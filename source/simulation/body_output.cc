#include "ephyra/simulation/body_output.h"

#include "ephyra/coupling/nerve_net.h"

namespace ephyra::simulation
{
  BodyOutput::BodyOutput(coupling::DeformableBody     &body,
                         const std::vector<BodyProbe> &probe_list)
    : body(body)
    , fields(body.mechanics().body().patch())
    , side(body.mechanics().body().patch(), splines::Side::theta2_0)
    , probes(probe_list, body.mechanics().body().patch())
    , net(dynamic_cast<const coupling::NerveNet *>(body.activation()))
  {
    if (net)
      line = LineProfile(net->line());
  }

  void
  BodyOutput::write_probes(const double time, RunOutput &output) const
  {
    probes.write(time,
                 body.mechanics().displacement(),
                 body.mechanics().velocity(),
                 output);
  }

  void
  BodyOutput::write_profiles(const double time, RunOutput &output) const
  {
    const auto &u = body.mechanics().displacement();
    side.write("radial_displacement", time, u, 2, 0, output);
    side.write("axial_displacement", time, u, 2, 1, output);
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
    output.add_fields("body",
                      time,
                      fields.evaluate(body.mechanics().body(),
                                      body.mechanics().displacement(),
                                      body.mechanics().velocity()));
  }
} // namespace ephyra::simulation
