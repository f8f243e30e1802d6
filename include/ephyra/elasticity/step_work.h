#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/elasticity/elasticity_operator.h"
#include "ephyra/elasticity/generalized_alpha.h"

#include <vector>

namespace ephyra::elasticity
{
  /// What the forces in a step of the generalised-alpha method do that are
  /// known at t^alpha alone: those that move prescribed displacements, and
  /// those by which the method differs from the midpoint rule. The latter take
  /// energy out of motions that the steps do not resolve; their work is the
  /// numerical dissipation, zero for rho_infinity = 1.
  ///
  /// With g = M a + F_int - F_ext - f - R at a level and its change over the
  /// step, eq. (65) reads, to second order,
  ///   alpha_f g^{n+1} + (1 - alpha_f) g^n + (alpha_m - alpha_f) M da = 0,
  /// from which g follows without any evaluation of forces, and the dissipation
  /// of the step is
  ///   (alpha_f - 1/2) du . dg + (beta - gamma/2) dt da . M dv,
  /// exact for linear bodies under constant loads. The reaction R at the levels
  /// follows from that at t^alpha in the same way.
  class StepWork
  {
  public:
    /// Changes of displacement, velocity, acceleration (m, m/s, m/s^2) and load
    /// of the surroundings (N) over a step.
    struct Step
    {
      std::vector<double> u, v, a, f;
      double              dt;
      bool                load_at_new_level; ///< see InterfaceLoad
    };

    explicit StepWork(const GeneralizedAlpha &coefficients);

    /// Starts in balance, with the reactions at the start, N.
    void
    start(const std::vector<double> &start_reaction);
    /// J, with the reaction at t^alpha, N; goes on to the next level.
    double
    of_reactions(const std::vector<double> &reaction_alpha, const Step &step);
    /// J; goes on to the next level.
    double
    dissipated(const ElasticityOperator &body, const Step &step);
    void
    serialize(Archive &archive);

  private:
    GeneralizedAlpha    alpha;
    std::vector<double> reaction; ///< R at level n, N
    std::vector<double> defect;   ///< g at level n, N
  };
} // namespace ephyra::elasticity
