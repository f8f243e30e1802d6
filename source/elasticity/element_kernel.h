#pragma once

#include "material_kernel.h"

#include "ephyra/elasticity/patch_tables.h"

#include <cmath>
#include <type_traits>
#include <vector>

namespace ephyra::elasticity::internal
{
  /// Memory of the element loop, allocated once.
  struct ElementWork
  {
    explicit ElementWork(const PatchTables &g)
      : coefficients(2 * g.n_local())
      , values(6 * g.n_q())
      , cube_root(g.n_q())
      , pressure(g.n_q())
      , flux(6 * g.n_q())
      , force(2 * g.n_local())
      , moduli(36 * g.n_q())
      , lines(16 * g.nq2)
      , matrix(4 * g.n_local() * g.n_local())
    {
    }

    std::vector<double> coefficients; ///< w_a x_a: [component][a]
    std::vector<double> values;       ///< [component][s][q]
    std::vector<double> cube_root;    ///< J^(-2/3), [q]
    std::vector<double> pressure;     ///< dPsi/dJ of the volume, [q]
    std::vector<double> flux;         ///< work-conjugate to values
    std::vector<double> force;        ///< [2 a + component]
    std::vector<double> moduli;       ///< d flux / d values: [q1][s t][i k][q2]
    std::vector<double> lines;        ///< moduli after the first sum
    std::vector<double> matrix;       ///< row-major in 2 a + component
    double              smallest_J = 0.; ///< over the Gauss points
  };

  /// Calls f with the number of functions n2 of an element across as a
  /// constant, f(std::integral_constant<int, n2>()).
  template <typename Function>
  auto
  with_width(const int n2, const Function &f)
  {
    switch (n2)
      {
      case 2:
        return f(std::integral_constant<int, 2>());
      case 3:
        return f(std::integral_constant<int, 3>());
      case 4:
        return f(std::integral_constant<int, 4>());
      case 5:
        return f(std::integral_constant<int, 5>());
      case 6:
        return f(std::integral_constant<int, 6>());
      default:
        return f(std::integral_constant<int, 7>());
      }
  }

  /// Sums of the polynomial basis and its derivatives at the Gauss points:
  /// values[i][s][q] = sum_a coefficients[i][a] (N_a, N_a,1, N_a,2).
  template <int n2>
  void
  evaluate_values(const PatchTables &g, const int e, ElementWork &work)
  {
    const int     nq2 = g.nq2, nq = g.n_q(), n1 = g.n1;
    const double *basis1 = &g.basis1[(e / g.ne2) * g.nq1 * 2 * n1];
    const double *N2     = &g.basis2_transposed[(e % g.ne2) * 2 * nq2 * n2];
    const double *dN2    = N2 + nq2 * n2;
    for (int i = 0; i < 2; ++i)
      for (int q1 = 0; q1 < g.nq1; ++q1)
        {
          const double *N1    = basis1 + q1 * 2 * n1;
          const double *c     = &work.coefficients[i * g.n_local()];
          double        v[n2] = {}, dv[n2] = {};
          for (int a1 = 0; a1 < n1; ++a1)
            for (int a2 = 0; a2 < n2; ++a2)
              {
                v[a2] += N1[a1] * c[a1 * n2 + a2];
                dv[a2] += N1[n1 + a1] * c[a1 * n2 + a2];
              }
          double *x0 = &work.values[3 * i * nq + q1 * nq2];
          double *x1 = x0 + nq, *x2 = x1 + nq;
          for (int q2 = 0; q2 < nq2; ++q2)
            {
              double s0 = 0, s1 = 0, s2 = 0;
              for (int a2 = 0; a2 < n2; ++a2)
                {
                  s0 += N2[a2 * nq2 + q2] * v[a2];
                  s1 += N2[a2 * nq2 + q2] * dv[a2];
                  s2 += dN2[a2 * nq2 + q2] * v[a2];
                }
              x0[q2] = s0;
              x1[q2] = s1;
              x2[q2] = s2;
            }
        }
  }

  /// The same where the number of functions is not known.
  inline void
  evaluate_values(const PatchTables &g, const int e, ElementWork &work)
  {
    switch (g.n2)
      {
      case 2:
        return evaluate_values<2>(g, e, work);
      case 3:
        return evaluate_values<3>(g, e, work);
      case 4:
        return evaluate_values<4>(g, e, work);
      case 5:
        return evaluate_values<5>(g, e, work);
      case 6:
        return evaluate_values<6>(g, e, work);
      default:
        return evaluate_values<7>(g, e, work);
      }
  }

  /// Stress and moduli at the Gauss points, in terms of the parametric values:
  /// @p T is the transform of the element, with the active strain in it. The
  /// tangent takes the pressure @p predicted, or that of F where this is null.
  template <bool small_strain, bool with_tangent>
  void
  evaluate_material(const PatchTables &g,
                    const double       modulus1,
                    const double       modulus2,
                    const double      *T,
                    const double      *volume,
                    const double      *shift,
                    const double      *predicted,
                    ElementWork       &work)
  {
    const int     nq2 = g.nq2, nq = g.n_q();
    const double *r0 = work.values.data(), *r1 = r0 + nq, *r2 = r1 + nq;
    const double *y0 = r2 + nq, *y1 = y0 + nq, *y2 = y1 + nq;
    const double *T0 = T, *T1 = T + nq, *T2 = T + 2 * nq, *T3 = T + 3 * nq,
                 *T4 = T + 4 * nq, *T5 = T + 5 * nq, *T6 = T + 6 * nq;
    double *flux = work.flux.data();
    double *root = work.cube_root.data();

    double smallest = 1e300;
    for (int q = 0; q < nq; ++q)
      {
        const double f0 = T0[q] * r0[q] + T1[q] * r1[q] + T2[q] * r2[q];
        const double f1 = T3[q] * r0[q] + T4[q] * r1[q] + T5[q] * r2[q];
        const double f2 = T0[q] * y0[q] + T1[q] * y1[q] + T2[q] * y2[q];
        const double f3 = T3[q] * y0[q] + T4[q] * y1[q] + T5[q] * y2[q];
        root[q]         = (f0 * f3 - f1 * f2) * T6[q] * r0[q];
        // A negative hoop stretch is as bad as a negative determinant.
        const double bad = r0[q] > 0. ? root[q] : -std::abs(root[q]);
        smallest         = !(bad >= smallest) ? bad : smallest;
      }
    work.smallest_J = smallest;
    if (!small_strain)
      {
        if (!(smallest > 0.))
          return;
        if (with_tangent && !predicted)
          for (int q = 0; q < nq; ++q)
            work.pressure[q] = 2. * modulus2 * (root[q] - 1.);
        for (int q = 0; q < nq; ++q)
          {
            const double c = std::cbrt(root[q]);
            root[q]        = 1. / (c * c);
          }
      }

    const double *pressure = predicted ? predicted : work.pressure.data();
    for (int q1 = 0; q1 < g.nq1; ++q1)
      {
        double *D = &work.moduli[q1 * 36 * nq2];
        for (int q2 = 0; q2 < nq2; ++q2)
          {
            const int      q   = q1 * nq2 + q2;
            const double   tr0 = T0[q], tr1 = T1[q], tr2 = T2[q];
            const double   ty0 = T3[q], ty1 = T4[q], ty2 = T5[q], th = T6[q];
            double         f0 = tr0 * r0[q] + tr1 * r1[q] + tr2 * r2[q];
            double         f1 = ty0 * r0[q] + ty1 * r1[q] + ty2 * r2[q];
            double         f2 = tr0 * y0[q] + tr1 * y1[q] + tr2 * y2[q];
            double         f3 = ty0 * y0[q] + ty1 * y1[q] + ty2 * y2[q];
            double         f4 = th * r0[q];
            double         p0, p1, p2, p3, p4;
            TangentEntries t;
            if (small_strain)
              {
                f0 -= shift[q];
                f1 -= shift[nq + q];
                f2 -= shift[nq + q];
                f3 -= shift[2 * nq + q];
                f4 -= shift[3 * nq + q];
                linear_elastic(modulus1,
                               modulus2,
                               f0,
                               f1,
                               f2,
                               f3,
                               f4,
                               p0,
                               p1,
                               p2,
                               p3,
                               p4,
                               t);
              }
            else
              neo_hookean(modulus1,
                          modulus2,
                          root[q],
                          f0,
                          f1,
                          f2,
                          f3,
                          f4,
                          with_tangent ? pressure[q] : 0.,
                          p0,
                          p1,
                          p2,
                          p3,
                          p4,
                          t);

            const double w   = volume[q];
            flux[q]          = w * (tr0 * p0 + ty0 * p1 + th * p4);
            flux[nq + q]     = w * (tr1 * p0 + ty1 * p1);
            flux[2 * nq + q] = w * (tr2 * p0 + ty2 * p1);
            flux[3 * nq + q] = w * (tr0 * p2 + ty0 * p3);
            flux[4 * nq + q] = w * (tr1 * p2 + ty1 * p3);
            flux[5 * nq + q] = w * (tr2 * p2 + ty2 * p3);

            if (with_tangent)
              {
                const double wr0 = w * tr0, wr1 = w * tr1, wr2 = w * tr2;
                const double wy0 = w * ty0, wy1 = w * ty1, wy2 = w * ty2;
                const double wh = w * th;
                // Rows d p / d values of the trial function, component r:
                const double a0 = t.rr00 * wr0 + t.rr01 * wy0 + t.hr0 * wh;
                const double a1 = t.rr00 * wr1 + t.rr01 * wy1;
                const double a2 = t.rr00 * wr2 + t.rr01 * wy2;
                const double b0 = t.rr01 * wr0 + t.rr11 * wy0 + t.hr1 * wh;
                const double b1 = t.rr01 * wr1 + t.rr11 * wy1;
                const double b2 = t.rr01 * wr2 + t.rr11 * wy2;
                const double h0 = t.hr0 * wr0 + t.hr1 * wy0 + t.hh * wh;
                const double h1 = t.hr0 * wr1 + t.hr1 * wy1;
                const double h2 = t.hr0 * wr2 + t.hr1 * wy2;
                // component y:
                const double c0 = t.ry00 * wr0 + t.ry01 * wy0;
                const double c1 = t.ry00 * wr1 + t.ry01 * wy1;
                const double c2 = t.ry00 * wr2 + t.ry01 * wy2;
                const double d0 = t.ry10 * wr0 + t.ry11 * wy0;
                const double d1 = t.ry10 * wr1 + t.ry11 * wy1;
                const double d2 = t.ry10 * wr2 + t.ry11 * wy2;
                const double g0 = t.hy0 * wr0 + t.hy1 * wy0;
                const double g1 = t.hy0 * wr1 + t.hy1 * wy1;
                const double g2 = t.hy0 * wr2 + t.hy1 * wy2;
                const double k0 = t.yy00 * wr0 + t.yy01 * wy0;
                const double k1 = t.yy00 * wr1 + t.yy01 * wy1;
                const double k2 = t.yy00 * wr2 + t.yy01 * wy2;
                const double l0 = t.yy01 * wr0 + t.yy11 * wy0;
                const double l1 = t.yy01 * wr1 + t.yy11 * wy1;
                const double l2 = t.yy01 * wr2 + t.yy11 * wy2;

                double *d = D + q2;
                // rr, symmetric in s t
                const double rr00 = tr0 * a0 + ty0 * b0 + th * h0;
                const double rr01 = tr0 * a1 + ty0 * b1 + th * h1;
                const double rr02 = tr0 * a2 + ty0 * b2 + th * h2;
                const double rr11 = tr1 * a1 + ty1 * b1;
                const double rr12 = tr1 * a2 + ty1 * b2;
                const double rr22 = tr2 * a2 + ty2 * b2;
                // yy, symmetric
                const double yy00 = tr0 * k0 + ty0 * l0;
                const double yy01 = tr0 * k1 + ty0 * l1;
                const double yy02 = tr0 * k2 + ty0 * l2;
                const double yy11 = tr1 * k1 + ty1 * l1;
                const double yy12 = tr1 * k2 + ty1 * l2;
                const double yy22 = tr2 * k2 + ty2 * l2;
                // ry: test r, trial y; yr is its transpose
                const double ry00 = tr0 * c0 + ty0 * d0 + th * g0;
                const double ry01 = tr0 * c1 + ty0 * d1 + th * g1;
                const double ry02 = tr0 * c2 + ty0 * d2 + th * g2;
                const double ry10 = tr1 * c0 + ty1 * d0;
                const double ry11 = tr1 * c1 + ty1 * d1;
                const double ry12 = tr1 * c2 + ty1 * d2;
                const double ry20 = tr2 * c0 + ty2 * d0;
                const double ry21 = tr2 * c1 + ty2 * d1;
                const double ry22 = tr2 * c2 + ty2 * d2;

                d[0 * nq2]  = rr00;
                d[1 * nq2]  = ry00;
                d[2 * nq2]  = ry00;
                d[3 * nq2]  = yy00;
                d[4 * nq2]  = rr01;
                d[5 * nq2]  = ry01;
                d[6 * nq2]  = ry10;
                d[7 * nq2]  = yy01;
                d[8 * nq2]  = rr02;
                d[9 * nq2]  = ry02;
                d[10 * nq2] = ry20;
                d[11 * nq2] = yy02;
                d[12 * nq2] = rr01;
                d[13 * nq2] = ry10;
                d[14 * nq2] = ry01;
                d[15 * nq2] = yy01;
                d[16 * nq2] = rr11;
                d[17 * nq2] = ry11;
                d[18 * nq2] = ry11;
                d[19 * nq2] = yy11;
                d[20 * nq2] = rr12;
                d[21 * nq2] = ry12;
                d[22 * nq2] = ry21;
                d[23 * nq2] = yy12;
                d[24 * nq2] = rr02;
                d[25 * nq2] = ry20;
                d[26 * nq2] = ry02;
                d[27 * nq2] = yy02;
                d[28 * nq2] = rr12;
                d[29 * nq2] = ry21;
                d[30 * nq2] = ry12;
                d[31 * nq2] = yy12;
                d[32 * nq2] = rr22;
                d[33 * nq2] = ry22;
                d[34 * nq2] = ry22;
                d[35 * nq2] = yy22;
              }
          }
      }
  }

  /// force[2 a + i] = w_a sum_q flux[i][s][q] (N_a, N_a,1, N_a,2).
  template <int n2>
  void
  integrate_force(const PatchTables &g, const int e, ElementWork &work)
  {
    const int     nq2 = g.nq2, nq = g.n_q(), n1 = g.n1, n = g.n_local();
    const double *basis1 = &g.basis1[(e / g.ne2) * g.nq1 * 2 * n1];
    const double *N2     = &g.basis2[(e % g.ne2) * 2 * nq2 * n2];
    const double *dN2    = N2 + nq2 * n2;
    const double *w      = &g.weights[static_cast<std::size_t>(e) * n];
    for (int i = 0; i < 2; ++i)
      {
        double *force = &work.force[i];
        for (int a = 0; a < n; ++a)
          force[2 * a] = 0.;
        for (int q1 = 0; q1 < g.nq1; ++q1)
          {
            const double *f0 = &work.flux[3 * i * nq + q1 * nq2];
            const double *f1 = f0 + nq, *f2 = f1 + nq;
            double        v[n2] = {}, dv[n2] = {};
            for (int q2 = 0; q2 < nq2; ++q2)
              for (int a2 = 0; a2 < n2; ++a2)
                {
                  v[a2] +=
                    N2[q2 * n2 + a2] * f0[q2] + dN2[q2 * n2 + a2] * f2[q2];
                  dv[a2] += N2[q2 * n2 + a2] * f1[q2];
                }
            const double *N1 = basis1 + q1 * 2 * n1;
            for (int a1 = 0; a1 < n1; ++a1)
              for (int a2 = 0; a2 < n2; ++a2)
                force[2 * (a1 * n2 + a2)] +=
                  N1[a1] * v[a2] + N1[n1 + a1] * dv[a2];
          }
        for (int a = 0; a < n; ++a)
          force[2 * a] *= w[a];
      }
  }

  /// Adds the moduli D of one line of Gauss points, times the products of two
  /// functions of the first direction (n: value, d: derivative). Apart for the
  /// restricted pointers, without which it would not vectorise.
  inline void
  add_moduli(const int    width,
             const double nn,
             const double nd,
             const double dn,
             const double dd,
             const double *__restrict D,
             double *__restrict x00,
             double *__restrict x02,
             double *__restrict x20,
             double *__restrict x22)
  {
    for (int l = 0; l < width; ++l)
      {
        x00[l] += nn * D[l] + nd * D[width + l] + dn * D[3 * width + l] +
                  dd * D[4 * width + l];
        x02[l] += nn * D[2 * width + l] + dn * D[5 * width + l];
        x20[l] += nn * D[6 * width + l] + nd * D[7 * width + l];
        x22[l] += nn * D[8 * width + l];
      }
  }

  /// matrix = factor * (stiffness) + mass_factor * (mass), by sums along one
  /// direction after the other; pairs a1 > b1 follow from symmetry. @p mass is
  /// stored per pair a1 <= b1: [pair][a2 * n2 + b2], weights included.
  template <int n2>
  void
  integrate_matrix(const PatchTables &g,
                   const int          e,
                   const double       factor,
                   const double       mass_factor,
                   const double      *mass,
                   ElementWork       &work)
  {
    constexpr int n22 = n2 * n2;
    const int     nq2 = g.nq2, n1 = g.n1, size = 2 * g.n_local();
    const int     width  = 4 * nq2;
    const double *basis1 = &g.basis1[(e / g.ne2) * g.nq1 * 2 * n1];
    const double *P00    = &g.products2[(e % g.ne2) * 4 * nq2 * n22];
    const double *P01 = P00 + nq2 * n22, *P10 = P01 + nq2 * n22,
                 *P11 = P10 + nq2 * n22;
    const double *w   = &g.weights[static_cast<std::size_t>(e) * g.n_local()];
    double *x00 = work.lines.data(), *x02 = x00 + width, *x20 = x02 + width,
           *x22 = x20 + width;

    for (int a1 = 0; a1 < n1; ++a1)
      for (int b1 = a1; b1 < n1; ++b1, mass += n22)
        {
          for (int l = 0; l < 4 * width; ++l)
            x00[l] = 0.;
          for (int q1 = 0; q1 < g.nq1; ++q1)
            {
              const double *N1 = basis1 + q1 * 2 * n1;
              const double  nn = factor * N1[a1] * N1[b1];
              const double  nd = factor * N1[a1] * N1[n1 + b1];
              const double  dn = factor * N1[n1 + a1] * N1[b1];
              const double  dd = factor * N1[n1 + a1] * N1[n1 + b1];
              const double *D  = &work.moduli[q1 * 9 * width];
              add_moduli(width, nn, nd, dn, dd, D, x00, x02, x20, x22);
            }

          double K[4][n22];
          for (int ik = 0; ik < 4; ++ik)
            {
              double sum[n22] = {};
              for (int q2 = 0; q2 < nq2; ++q2)
                {
                  const int    l  = ik * nq2 + q2;
                  const double s0 = x00[l], s1 = x02[l], s2 = x20[l],
                               s3 = x22[l];
                  for (int m = 0; m < n22; ++m)
                    sum[m] += s0 * P00[q2 * n22 + m] + s1 * P01[q2 * n22 + m] +
                              s2 * P10[q2 * n22 + m] + s3 * P11[q2 * n22 + m];
                }
              for (int m = 0; m < n22; ++m)
                K[ik][m] = sum[m];
            }

          for (int a2 = 0; a2 < n2; ++a2)
            {
              const int     a    = a1 * n2 + a2;
              double       *row0 = &work.matrix[2 * a * size + 2 * b1 * n2];
              double       *row1 = row0 + size;
              const double *wb   = w + b1 * n2;
              for (int b2 = 0; b2 < n2; ++b2)
                {
                  const int    m   = a2 * n2 + b2;
                  const double ww  = w[a] * wb[b2];
                  const double M   = mass_factor * mass[m];
                  row0[2 * b2]     = ww * K[0][m] + M;
                  row0[2 * b2 + 1] = ww * K[1][m];
                  row1[2 * b2]     = ww * K[2][m];
                  row1[2 * b2 + 1] = ww * K[3][m] + M;
                }
            }
        }

    for (int a = n2; a < g.n_local(); ++a)
      for (int b = 0; b < (a / n2) * n2; ++b)
        {
          const double *above = &work.matrix[2 * b * size + 2 * a];
          double       *below = &work.matrix[2 * a * size + 2 * b];
          below[0]            = above[0];
          below[1]            = above[size];
          below[size]         = above[1];
          below[size + 1]     = above[size + 1];
        }
  }
} // namespace ephyra::elasticity::internal
