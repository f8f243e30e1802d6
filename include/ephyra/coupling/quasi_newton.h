#pragma once

#include "ephyra/coupling/acceleration.h"

#include <deque>

namespace ephyra::coupling
{
  /// Interface quasi-Newton with the inverse Jacobian from a least-squares
  /// model, IQN-ILS (Degroote, Bathe & Vierendeels 2009,
  /// 10.1016/j.compstruc.2008.11.013): the differences of residuals (V) and of
  /// answers (W) of this step and of some earlier ones give the update
  /// x <- H(x) + W c with V c ~ -r. Columns that are nearly dependent on newer
  /// ones are left out (QR2 filter, Haelterman et al. 2016,
  /// 10.1016/j.compstruc.2015.11.001).
  class QuasiNewton : public Acceleration
  {
  public:
    explicit QuasiNewton(const Parameters &parameters);
    void
    start_step() override;
    std::vector<double>
    next(const std::vector<double> &x,
         const std::vector<double> &answer) override;
    void
    finish_step(bool accepted) override;
    double
    relaxation() const override;
    void
    serialize(Archive &archive) override;

  private:
    struct Difference
    {
      std::vector<double> residual;
      std::vector<double> answer;
    };

    const Parameters                    parameters;
    std::vector<Difference>             current; ///< of this step, newest last
    std::deque<std::vector<Difference>> earlier; ///< of steps, newest first
    std::vector<double>                 old_residual, old_answer;
  };
} // namespace ephyra::coupling
