#pragma once

#include "ephyra/coupling/acceleration.h"

namespace ephyra::coupling
{
  /// Aitken's dynamic relaxation for vectors (Küttler & Wall 2008,
  /// 10.1007/s00466-008-0255-5): omega <- -omega r_old.(r - r_old)/|r - r_old|^2
  /// with r = H(x) - x; not dynamic: constant relaxation.
  class Aitken : public Acceleration
  {
  public:
    Aitken(const Parameters &parameters, bool dynamic);
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
    const Parameters    parameters;
    const bool          dynamic;
    double              omega;
    std::vector<double> old_residual;
  };
} // namespace ephyra::coupling
