#pragma once

namespace ephyra::elasticity
{
  /// Coefficients of the generalised-alpha method for a spectral radius
  /// rho_infinity in [0, 1] of high frequencies (Chung & Hulbert 1993,
  /// 10.1115/1.2900803), eq. (63) of Nitti et al. 2023: u^alpha = alpha_f
  /// u^{n+1} + (1 - alpha_f) u^n and the same for a with alpha_m. 1/2 gives
  /// alpha_m = 1, alpha_f = 2/3, beta = 4/9, gamma = 5/6.
  struct GeneralizedAlpha
  {
    explicit GeneralizedAlpha(double rho_infinity);
    double alpha_m, alpha_f, beta, gamma;
  };
} // namespace ephyra::elasticity
