#include "ephyra/elasticity/step_work.h"

namespace ephyra::elasticity
{
  StepWork::StepWork(const GeneralizedAlpha &coefficients)
    : alpha(coefficients)
  {
  }

  void
  StepWork::start(const std::vector<double> &start_reaction)
  {
    reaction = start_reaction;
    defect.assign(start_reaction.size(), 0.);
  }

  double
  StepWork::of_reactions(const std::vector<double> &reaction_alpha,
                         const Step                &step)
  {
    const double w    = alpha.alpha_f;
    double       work = 0.;
    for (std::size_t i = 0; i < reaction.size(); ++i)
      {
        const double next = (reaction_alpha[i] - (1. - w) * reaction[i]) / w;
        work += 0.5 * (reaction[i] + next) * step.u[i];
        reaction[i] = next;
      }
    return work;
  }

  double
  StepWork::dissipated(const ElasticityOperator &body, const Step &step)
  {
    std::vector<double> inertia(step.a.size(), 0.); // M da
    body.add_inertia(step.a, inertia);
    const double w    = alpha.alpha_f;
    const double lag  = step.load_at_new_level ? 1. - w : 0.;
    double       work = 0.;
    for (std::size_t i = 0; i < inertia.size(); ++i)
      {
        const double next = (lag * step.f[i] - (1. - w) * defect[i] -
                             (alpha.alpha_m - w) * inertia[i]) /
                            w;
        work +=
          ((w - 0.5) * (next - defect[i]) - lag * step.f[i]) * step.u[i] +
          (alpha.beta - 0.5 * alpha.gamma) * step.dt * inertia[i] * step.v[i];
        defect[i] = next;
      }
    return work;
  }

  void
  StepWork::serialize(Archive &archive)
  {
    archive.values("reaction", reaction);
    archive.values("defect of balance", defect);
  }
} // namespace ephyra::elasticity
