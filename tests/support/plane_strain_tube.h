#pragma once

#include "ephyra/elasticity/material.h"

#include <cmath>
#include <functional>

namespace ephyra::test
{
  /// Root of a function between two arguments where its sign differs.
  inline double
  bisect(const std::function<double(double)> &f, double low, double high)
  {
    const bool rising = f(high) > 0.;
    for (int k = 0; k < 200 && high - low > 1e-15 * std::abs(high); ++k)
      {
        const double middle                       = 0.5 * (low + high);
        ((f(middle) > 0.) == rising ? high : low) = middle;
      }
    return 0.5 * (low + high);
  }

  /// A tube A < R < B in plane strain under a dead pressure p inside, with the
  /// energy (10) of Nitti et al. 2023: the ordinary differential equation
  ///   dP_r/dR = (P_h - P_r)/R, P_r = dPsi/d(r'), P_h = dPsi/d(r/R),
  /// integrated by the classical Runge-Kutta method from P_r(A) = -p, where the
  /// radius a = r(A) is such that P_r(B) = 0.
  struct PlaneStrainTube
  {
    double A = 0.5, B = 0.8, c10 = 0.5, K = 1000., p = 0.2;

    /// P_r and P_h at the stretches x = dr/dR and h = r/R.
    std::pair<double, double>
    stress(const double x, const double h) const
    {
      const double J = x * h, I1 = x * x + h * h + 1.;
      const double a = 2. * c10 * std::pow(J, -2. / 3.);
      const double q = 2. * K * (J - 1.) - a * I1 / (3. * J);
      return {a * x + q * h, a * h + q * x};
    }

    /// r' at a stress P_r and a hoop stretch h.
    double
    radial_stretch(const double P_r, const double h) const
    {
      double x = 1. / h;
      for (int k = 0; k < 50; ++k)
        {
          const double d = 1e-7;
          const double f = stress(x, h).first - P_r;
          const double slope =
            (stress(x + d, h).first - stress(x - d, h).first) / (2. * d);
          x -= f / slope;
          if (std::abs(f) < 1e-13 * slope)
            break;
        }
      return x;
    }

    /// r(B) and P_r(B) for a radius a inside.
    std::pair<double, double>
    outside(const double a, const int n = 400) const
    {
      double       r = a, P = -p;
      const double d     = (B - A) / n;
      const auto   slope = [&](const double R, const double r, const double P) {
        const double x = radial_stretch(P, r / R);
        return std::pair(x, (stress(x, r / R).second - P) / R);
      };
      for (int k = 0; k < n; ++k)
        {
          const double R  = A + k * d;
          const auto   k1 = slope(R, r, P);
          const auto   k2 =
            slope(R + d / 2., r + d / 2. * k1.first, P + d / 2. * k1.second);
          const auto k3 =
            slope(R + d / 2., r + d / 2. * k2.first, P + d / 2. * k2.second);
          const auto k4 = slope(R + d, r + d * k3.first, P + d * k3.second);
          r += d / 6. * (k1.first + 2. * k2.first + 2. * k3.first + k4.first);
          P +=
            d / 6. * (k1.second + 2. * k2.second + 2. * k3.second + k4.second);
        }
      return {r, P};
    }

    /// Displacement of the inner surface, m.
    double
    inner_displacement() const
    {
      return bisect([this](const double a) { return outside(a).second; },
                    A,
                    1.6 * A) -
             A;
    }

    /// The same for K = infinity: r^2 = R^2 + a^2 - A^2 and the equilibrium of
    /// the radial Cauchy stress, by Simpson's rule.
    double
    incompressible_inner_displacement() const
    {
      const auto excess = [this](const double a) {
        const int n   = 2000;
        double    sum = 0.;
        for (int k = 0; k <= n; ++k)
          {
            const double R = A + (B - A) * k / n;
            const double s = (R * R + a * a - A * A) / (R * R);
            sum += (k % n == 0 ? 1. : k % 2 ? 4. : 2.) * (s - 1. / s) / (s * R);
          }
        return 2. * c10 * sum * (B - A) / (3. * n) * a / A - p;
      };
      return bisect(excess, A, 1.6 * A) - A;
    }
  };
} // namespace ephyra::test
