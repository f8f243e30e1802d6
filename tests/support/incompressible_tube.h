#pragma once

#include <array>
#include <cmath>

namespace ephyra::test
{
  /// Plane-strain motion of an incompressible neo-Hookean tube (energy c10 (I1 -
  /// 3)) from rest under a pressure p inside that acts on the deformed surface.
  /// With v_r = c/r, c = a da/dt, the radial momentum integrated over the wall is
  ///   rho (dc/dt ln(b/a) + c^2/2 (1/b^2 - 1/a^2))
  ///     = p - int_a^b (sigma_hoop - sigma_r)/r dr,
  ///   sigma_hoop - sigma_r = 2 c10 ((r/R)^2 - (R/r)^2), r^2 - R^2 = a^2 - A^2,
  /// an ordinary differential equation for the inner radius a, solved by the
  /// classical Runge-Kutta method.
  struct IncompressibleTube
  {
    double A = .5, B = .8, c10 = 400., density = 1100., p = 100.;

    /// a and c, at first A and 0.
    using State = std::array<double, 2>;

    State
    rate(const State &s) const
    {
      const double a = s[0], c = s[1], grown = a * a - A * A;
      const double b = std::sqrt(B * B + grown);
      // In R: dr/r = R dR / r^2. Simpson's rule.
      const int  n        = 200;
      double     integral = 0.;
      const auto f        = [&](const double R) {
        const double x = R * R, r2 = x + grown;
        return 2. * c10 * (r2 / x - x / r2) * R / r2;
      };
      const double h = (B - A) / n;
      for (int k = 0; k <= n; ++k)
        integral += (k == 0 || k == n ? 1.
                     : k % 2 == 1     ? 4.
                                      : 2.) *
                    h / 3. * f(A + k * h);
      return {{c / a,
               ((p - integral) / density -
                0.5 * c * c * (1. / (b * b) - 1. / (a * a))) /
                 std::log(b / a)}};
    }

    void
    advance(State &s, const double dt) const
    {
      const auto moved = [&s](const State &k, const double h) {
        return State{{s[0] + h * k[0], s[1] + h * k[1]}};
      };
      const State k1 = rate(s), k2 = rate(moved(k1, dt / 2.)),
                  k3 = rate(moved(k2, dt / 2.)), k4 = rate(moved(k3, dt));
      for (int i = 0; i < 2; ++i)
        s[i] += dt / 6. * (k1[i] + 2. * k2[i] + 2. * k3[i] + k4[i]);
    }
  };
} // namespace ephyra::test
