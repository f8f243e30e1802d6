#include "ephyra/elasticity/generalized_alpha.h"

namespace ephyra::elasticity
{
  GeneralizedAlpha::GeneralizedAlpha(const double rho_infinity)
  {
    alpha_m          = (2. - rho_infinity) / (1. + rho_infinity);
    alpha_f          = 1. / (1. + rho_infinity);
    const double sum = 1. - alpha_f + alpha_m;
    beta             = 0.25 * sum * sum;
    gamma            = 0.5 - alpha_f + alpha_m;
  }
} // namespace ephyra::elasticity
