#include "ephyra/simulation/tissue_checks.h"

#include "ephyra/base/exceptions.h"

namespace ephyra::simulation
{
  namespace
  {
    using Model = electrophysiology::ElectrophysiologySolver::Model;

    void
    check_line(const Scene &scene, ParameterHandler &prm)
    {
      try
        {
          const geometry::BodyCurve curve =
            geometry::create_curve(scene.tissue_line);
          if (!curve.closed)
            return;
          const auto check = [&prm](const bool holds, const std::string &end) {
            if (holds)
              prm.add_error("Electrophysiology/" + end + "/Type",
                            "the line is closed and has no end; set Type = no "
                            "flux.");
          };
          check(scene.tissue.start.holds_potential, "Start of the line");
          check(scene.tissue.end.holds_potential, "End of the line");
        }
      catch (const InputError &error)
        {
          prm.add_error("Tissue/Shape", error.what());
        }
    }

    void
    check_quantities(const Scene                             &scene,
                     const std::string                       &kind,
                     const std::vector<TissueSampling::Line> &samples,
                     ParameterHandler                        &prm)
    {
      for (const auto &sample : samples)
        {
          const std::string entry = kind + " " + sample.name + "/Quantities";
          if (sample.has("gates") &&
              scene.tissue.model != Model::jellyfish_neuron)
            prm.add_error(entry,
                          "the ionic model has no gates; leave them out or set "
                          "Electrophysiology/Ionic model = jellyfish neuron.");
          if (sample.has("currents") && scene.tissue.model == Model::none)
            prm.add_error(entry,
                          "there is no ionic model and no current; leave them "
                          "out or choose another Electrophysiology/Ionic "
                          "model.");
        }
    }
  } // namespace

  void
  check_tissue(Scene &scene, ParameterHandler &prm)
  {
    const TissueSampling &sampling = scene.tissue_sampling;
    if (scene.single_cell)
      {
        if (scene.tissue.model == Model::none)
          prm.add_error("Tissue/Isolated cell",
                        "a cell without an ionic model has nothing to compute; "
                        "choose another Electrophysiology/Ionic model.");
        if (!sampling.probes.empty() || !sampling.lines.empty() ||
            !scene.crossing_points.empty())
          scene.warnings.push_back(
            "Probes and lines have no effect on an isolated cell: all it has "
            "is in statistics.csv.");
        return;
      }
    check_line(scene, prm);
    check_quantities(scene, "Tissue probe", sampling.probes, prm);
    check_quantities(scene, "Tissue line", sampling.lines, prm);
  }
} // namespace ephyra::simulation
