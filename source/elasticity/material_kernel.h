#pragma once

namespace ephyra::elasticity::internal
{
  /// The 15 different entries of dP/dF by blocks of components: rr, yy, ry are
  /// dP_iJ / dF_kL for the components i and k named, then the indices J, L; h
  /// is the hoop.
  struct TangentEntries
  {
    double rr00, rr01, rr11;
    double yy00, yy01, yy11;
    double ry00, ry01, ry10, ry11;
    double hr0, hr1, hy0, hy1, hh;
  };

  /// Stress and tangent of Material at F = (f0, f1, f2, f3, f4), see
  /// material.h. @p i is J^(-2/3): cube roots do not vectorise, so a caller
  /// with many points computes them apart. The tangent takes the pressure
  /// dPsi/dJ of the volume from @p pressure, the stress from F.
  inline void
  neo_hookean(const double    c10,
              const double    K,
              const double    i,
              const double    f0,
              const double    f1,
              const double    f2,
              const double    f3,
              const double    f4,
              const double    pressure,
              double         &p0,
              double         &p1,
              double         &p2,
              double         &p3,
              double         &p4,
              TangentEntries &t)
  {
    const double D  = f0 * f3 - f1 * f2;
    const double J  = D * f4;
    const double d  = 1. / D;
    const double h0 = f3 * d, h1 = -f2 * d, h2 = -f1 * d, h3 = f0 * d;
    const double h4 = 1. / f4;
    const double I1 = f0 * f0 + f1 * f1 + f2 * f2 + f3 * f3 + f4 * f4;
    const double a  = 2. * c10 * i;
    const double e  = 2. / 3. * a;
    const double s  = 2. * K * J * (J - 1.) - a * I1 / 3.;
    const double b  = pressure * J - a * I1 / 3.;
    const double c  = 2. / 9. * a * I1 + pressure * J + 2. * K * J * J;

    p0 = a * f0 + s * h0;
    p1 = a * f1 + s * h1;
    p2 = a * f2 + s * h2;
    p3 = a * f3 + s * h3;
    p4 = a * f4 + s * h4;

    // c H_x H_y - e (F_x H_y + H_x F_y)
    const double k0 = c * h0 - e * f0, k1 = c * h1 - e * f1;
    const double k2 = c * h2 - e * f2, k3 = c * h3 - e * f3;
    const double k4 = c * h4 - e * f4;
    t.rr00          = a + h0 * k0 - e * h0 * f0 - b * h0 * h0;
    t.rr01          = h1 * k0 - e * h0 * f1 - b * h1 * h0;
    t.rr11          = a + h1 * k1 - e * h1 * f1 - b * h1 * h1;
    t.yy00          = a + h2 * k2 - e * h2 * f2 - b * h2 * h2;
    t.yy01          = h3 * k2 - e * h2 * f3 - b * h3 * h2;
    t.yy11          = a + h3 * k3 - e * h3 * f3 - b * h3 * h3;
    t.ry00          = h2 * k0 - e * h0 * f2 - b * h0 * h2;
    t.ry01          = h3 * k0 - e * h0 * f3 - b * h1 * h2;
    t.ry10          = h2 * k1 - e * h1 * f2 - b * h0 * h3;
    t.ry11          = h3 * k1 - e * h1 * f3 - b * h1 * h3;
    t.hr0           = h0 * k4 - e * h4 * f0;
    t.hr1           = h1 * k4 - e * h4 * f1;
    t.hy0           = h2 * k4 - e * h4 * f2;
    t.hy1           = h3 * k4 - e * h4 * f3;
    t.hh            = a + h4 * k4 - e * h4 * f4 - b * h4 * h4;
  }

  /// Linear elasticity: P = 2 mu e + (kappa - 2/3 mu) tr e, e = sym F - 1.
  inline void
  linear_elastic(const double    mu,
                 const double    kappa,
                 const double    f0,
                 const double    f1,
                 const double    f2,
                 const double    f3,
                 const double    f4,
                 double         &p0,
                 double         &p1,
                 double         &p2,
                 double         &p3,
                 double         &p4,
                 TangentEntries &t)
  {
    const double lambda = kappa - 2. / 3. * mu;
    const double e0 = f0 - 1., e3 = f3 - 1., e4 = f4 - 1.;
    const double pressure = lambda * (e0 + e3 + e4);
    p0                    = 2. * mu * e0 + pressure;
    p1                    = mu * (f1 + f2);
    p2                    = p1;
    p3                    = 2. * mu * e3 + pressure;
    p4                    = 2. * mu * e4 + pressure;

    t.rr00 = t.yy11 = t.hh = 2. * mu + lambda;
    t.rr11 = t.yy00 = t.ry10 = mu;
    t.rr01 = t.yy01 = t.ry00 = t.ry11 = 0.;
    t.ry01 = t.hr0 = t.hy1 = lambda;
    t.hr1 = t.hy0 = 0.;
  }
} // namespace ephyra::elasticity::internal
