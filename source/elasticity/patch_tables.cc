#include "ephyra/elasticity/patch_tables.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/splines/quadrature.h"

#include <cmath>

namespace ephyra::elasticity
{
  namespace
  {
    struct DirectionTables
    {
      std::vector<double> basis;   ///< [e][q][0 or 1][a]
      std::vector<double> theta;   ///< [e][q]
      std::vector<double> weights; ///< [e][q]
    };

    DirectionTables
    tabulate(const splines::KnotVector &knots, const splines::Quadrature &rule)
    {
      const int       n = knots.degree() + 1;
      DirectionTables tables;
      for (int e = 0; e < knots.n_elements(); ++e)
        for (int q = 0; q < rule.size(); ++q)
          {
            const double start  = knots.breaks()[e];
            const double length = knots.breaks()[e + 1] - start;
            tables.theta.push_back(start + length * rule.points[q]);
            tables.weights.push_back(length * rule.weights[q]);
            tables.basis.resize(tables.basis.size() + 2 * n);
            knots.evaluate(tables.theta.back(),
                           1,
                           &tables.basis[tables.basis.size() - 2 * n]);
          }
      return tables;
    }
  } // namespace

  PatchTables::PatchTables(const splines::NurbsPatch<2> &patch,
                           const std::array<int, 2>     &n_points)
    : ne1(patch.knot_vector(0).n_elements())
    , ne2(patch.knot_vector(1).n_elements())
    , n1(patch.degree(0) + 1)
    , n2(patch.degree(1) + 1)
    , nq1(n_points[0])
    , nq2(n_points[1])
    , orientation(0.)
  {
    const DirectionTables direction1 =
      tabulate(patch.knot_vector(0), splines::gauss_legendre(nq1));
    const DirectionTables direction2 =
      tabulate(patch.knot_vector(1), splines::gauss_legendre(nq2));
    basis1 = direction1.basis;
    theta1 = direction1.theta;
    theta2 = direction2.theta;

    basis2.resize(direction2.basis.size());
    basis2_transposed.resize(direction2.basis.size());
    products2.resize(static_cast<std::size_t>(4) * ne2 * nq2 * n2 * n2);
    for (int e2 = 0; e2 < ne2; ++e2)
      for (int q2 = 0; q2 < nq2; ++q2)
        {
          const double *N = &direction2.basis[2 * n2 * (e2 * nq2 + q2)];
          for (int d = 0; d < 2; ++d)
            for (int a = 0; a < n2; ++a)
              {
                const int block             = (2 * e2 + d) * nq2 * n2;
                basis2[block + q2 * n2 + a] = N[d * n2 + a];
                basis2_transposed[block + a * nq2 + q2] = N[d * n2 + a];
              }
          for (int kind = 0; kind < 4; ++kind)
            for (int a = 0; a < n2; ++a)
              for (int b = 0; b < n2; ++b)
                products2[((4 * e2 + kind) * nq2 + q2) * n2 * n2 + a * n2 + b] =
                  N[(kind / 2) * n2 + a] * N[(kind % 2) * n2 + b];
        }

    points.resize(static_cast<std::size_t>(n_elements()) * n_local());
    weights.resize(points.size());
    transform.resize(static_cast<std::size_t>(n_elements()) * n_transform *
                     n_q());
    const std::size_t n_all_q = static_cast<std::size_t>(n_elements()) * n_q();
    volume.reserve(n_all_q);
    frames.reserve(n_all_q);
    positions.reserve(n_all_q);

    for (int e1 = 0; e1 < ne1; ++e1)
      for (int e2 = 0; e2 < ne2; ++e2)
        {
          const int  e     = e1 * ne2 + e2;
          const int  i1    = patch.knot_vector(0).first_basis(e1);
          const int  i2    = patch.knot_vector(1).first_basis(e2);
          const auto local = static_cast<std::size_t>(e) * n_local();
          for (int a1 = 0; a1 < n1; ++a1)
            for (int a2 = 0; a2 < n2; ++a2)
              {
                const int point = (i1 + a1) * patch.n_basis(1) + i2 + a2;
                points[local + a1 * n2 + a2]  = point;
                weights[local + a1 * n2 + a2] = patch.weights()[point];
              }

          for (int q = 0; q < n_q(); ++q)
            {
              const int     line1 = e1 * nq1 + q / nq2;
              const int     line2 = e2 * nq2 + q % nq2;
              const double *N1    = &direction1.basis[2 * n1 * line1];
              const double *N2    = &direction2.basis[2 * n2 * line2];
              // W, w r, w y and their derivatives.
              double W[3] = {}, R[3] = {}, Y[3] = {};
              for (int a1 = 0; a1 < n1; ++a1)
                for (int a2 = 0; a2 < n2; ++a2)
                  {
                    const auto            a    = local + a1 * n2 + a2;
                    const double          N[3] = {N1[a1] * N2[a2],
                                                  N1[n1 + a1] * N2[a2],
                                                  N1[a1] * N2[n2 + a2]};
                    const splines::Point &x = patch.control_points()[points[a]];
                    for (int s = 0; s < 3; ++s)
                      {
                        W[s] += weights[a] * N[s];
                        R[s] += weights[a] * N[s] * x.r;
                        Y[s] += weights[a] * N[s] * x.y;
                      }
                  }
              const double r = R[0] / W[0], y = Y[0] / W[0];
              const double r1  = (R[1] - r * W[1]) / W[0];
              const double r2  = (R[2] - r * W[2]) / W[0];
              const double y1  = (Y[1] - y * W[1]) / W[0];
              const double y2  = (Y[2] - y * W[2]) / W[0];
              const double det = r1 * y2 - r2 * y1;

              const auto where = [&]() {
                std::ostringstream text;
                text << "at theta1 = " << theta1[line1]
                     << ", theta2 = " << theta2[line2];
                return text.str();
              };
              if (orientation == 0.)
                orientation = det > 0. ? 1. : -1.;
              EphyraThrowIf(!(det * orientation > 0.),
                            InputError,
                            "The patch is inverted or degenerate "
                              << where() << " (Jacobian " << det
                              << " m^2); move the control points there.");
              EphyraThrowIf(!(r > 0.),
                            InputError,
                            "The patch reaches across the axis "
                              << where() << " (r = " << r
                              << " m); all its points need r >= 0.");

              volume.push_back(2. * M_PI * r * std::abs(det) *
                               direction1.weights[line1] *
                               direction2.weights[line2]);
              frames.push_back({{r1, y1}, {r2, y2}, r});
              positions.push_back({r, y});

              // d theta^k / d(r, y), then the quotient rule.
              const double inv[2][2] = {{y2 / det, -r2 / det},
                                        {-y1 / det, r1 / det}};
              double      *T =
                &transform[static_cast<std::size_t>(e) * n_transform * n_q() +
                           q];
              for (int J = 0; J < 2; ++J)
                {
                  T[(3 * J) * n_q()] =
                    -(inv[0][J] * W[1] + inv[1][J] * W[2]) / (W[0] * W[0]);
                  T[(3 * J + 1) * n_q()] = inv[0][J] / W[0];
                  T[(3 * J + 2) * n_q()] = inv[1][J] / W[0];
                }
              T[6 * n_q()] = 1. / (r * W[0]);
            }
        }
  }
} // namespace ephyra::elasticity
