#pragma once

#include "ephyra/simulation/scene.h"

namespace ephyra::simulation
{
  /// What can be known of an elastic body before it is computed: sides that
  /// contradict each other, a tie or the axis at some time of the run, formulas
  /// without a value, a muscle that shortens too much, a body that nothing holds
  /// in statics. Errors are added to those of @p prm; to the warnings of the
  /// scene that low degrees lock.
  void
  check_elasticity(Scene                        &scene,
                   const splines::NurbsPatch<2> &patch,
                   ParameterHandler             &prm);

  /// K / c10 from which on the error of a bent wall exceeds about one per cent,
  /// with @p n elements across it: 0.1 n^2, 30 n^3 and 1000 n^6 for the degrees
  /// 1, 2 and 3; beyond them infinity.
  double
  locking_limit(int degree, int n);
} // namespace ephyra::simulation
