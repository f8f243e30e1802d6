#pragma once

#include "ephyra/simulation/line_profile.h"
#include "ephyra/simulation/model.h"
#include "ephyra/simulation/tissue_motion.h"
#include "ephyra/simulation/tissue_probes.h"

#include <optional>

namespace ephyra::simulation
{
  /// Electrophysiology alone: an isolated neuron, or a tissue on a line.
  class TissueModel : public Model
  {
  public:
    TissueModel(const Scene &scene, MPI_Comm comm);

    StepStatus
    advance(double t, double dt) override;
    void
    serialize(Archive &archive) override;
    void
    evaluate(Record &record) override;
    void
    write_probes(double time, RunOutput &output) const override;
    void
    write_profiles(double time, RunOutput &output) const override;
    void
    write_fields(double time, RunOutput &output) override;
    void
    add_results(Record &record) const override;

  private:
    /// Warns of fronts that passed one probe and never came to another, and of
    /// pulses that sent none.
    void
    report_lost_fronts() const;

    std::optional<splines::NurbsPatch<1>>                       line;
    std::unique_ptr<electrophysiology::ElectrophysiologySolver> solver;
    std::optional<LineProfile>                                  profile;
    std::optional<TissueMotion>                                 motion;
    std::optional<TissueProbes>                                 probes;
    std::int64_t        metric_updates = 0; ///< of a moving line
    std::vector<double> G11, radius;
    double              time = 0; ///< s
    std::vector<int>    crossing_probes;
    std::vector<double> probe_points;
  };
} // namespace ephyra::simulation
