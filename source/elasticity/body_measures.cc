// The functions of ElasticityOperator that are called now and then: what is
// evaluated on a body, rather than what its equations are assembled from.
#include "ephyra/elasticity/body_measures.h"

#include "element_kernel.h"

#include "ephyra/base/mpi.h"
#include "ephyra/elasticity/elasticity_operator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace ephyra::elasticity
{
  std::string
  ElasticityOperator::description() const
  {
    const double       mu = prm.material.shear_modulus();
    const double       nu = prm.material.poisson_ratio();
    std::ostringstream text;
    text << "small-strain E = " << 2. * mu * (1. + nu) << " Pa, nu = " << nu;
    if (active_strain.active())
      text << "; the muscle shortens fibres by at most " << shortening
           << "; Gauss points in an element: " << tables.nq1 << " x "
           << tables.nq2;
    return text.str();
  }

  AxisymmetricTensor
  ElasticityOperator::elastic_part(const AxisymmetricTensor &F,
                                   const AxisymmetricTensor &active) const
  {
    if (prm.material.small_strain)
      return {F[0] - active[0] + 1.,
              F[1] - active[1],
              F[2] - active[2],
              F[3] - active[3] + 1.,
              F[4] - active[4] + 1.};
    const AxisymmetricTensor G = inverse(active);
    return {F[0] * G[0] + F[1] * G[2],
            F[0] * G[1] + F[1] * G[3],
            F[2] * G[0] + F[3] * G[2],
            F[2] * G[1] + F[3] * G[3],
            F[4] * G[4]};
  }

  void
  ElasticityOperator::evaluate_positions(const std::vector<double> &x,
                                         const int                  e) const
  {
    gather(x, e);
    internal::with_width(tables.n2, [&](const auto width) {
      internal::evaluate_values<width>(tables, e, *work);
    });
  }

  AxisymmetricTensor
  ElasticityOperator::deformation_gradient(const int e, const int q) const
  {
    const int     nq  = tables.n_q();
    const double *x   = &work->values[q];
    const double *T   = &tables.transform[static_cast<std::size_t>(e) *
                                          PatchTables::n_transform * nq +
                                        q];
    const auto    row = [&](const int J, const int i) {
      double sum = 0.;
      for (int s = 0; s < 3; ++s)
        sum += T[(3 * J + s) * nq] * x[(3 * i + s) * nq];
      return sum;
    };
    return {row(0, 0), row(1, 0), row(0, 1), row(1, 1), T[6 * nq] * x[0]};
  }

  std::vector<double>
  ElasticityOperator::external_force(const std::vector<double> &u) const
  {
    std::vector<double> x(u), force(u.size(), 0.), scale(u.size(), 0.);
    for (std::size_t i = 0; i < u.size(); ++i)
      x[i] += reference[i];
    for (const SideLoad &load : side_loads)
      load.subtract_force(x, rank, n_ranks, force, scale);
    for (double &f : force)
      f = -f;

    if (!body_force_values.empty())
      {
        const int n = tables.n_local(), nq = tables.n_q();
        for (int e = first_element; e < first_element + n_own_elements; ++e)
          for (int q = 0; q < nq; ++q)
            {
              const std::size_t k = static_cast<std::size_t>(e) * nq + q;
              const double     *N1 =
                &tables.basis1[2 * tables.n1 *
                               (e / tables.ne2 * tables.nq1 + q / tables.nq2)];
              const double *N2 =
                &tables.basis2[(2 * (e % tables.ne2) * tables.nq2 +
                                q % tables.nq2) *
                               tables.n2];
              const double T6 = tables.transform[(static_cast<std::size_t>(e) *
                                                    PatchTables::n_transform +
                                                  6) *
                                                   nq +
                                                 q];
              for (int a = 0; a < n; ++a)
                {
                  const std::size_t local = static_cast<std::size_t>(e) * n + a;
                  const double R = tables.weights[local] * N1[a / tables.n2] *
                                   N2[a % tables.n2] * T6 * tables.frames[k].r;
                  for (int i = 0; i < 2; ++i)
                    force[2 * tables.points[local] + i] +=
                      tables.volume[k] * R *
                      body_force_values[i * tables.positions.size() + k];
                }
            }
      }
    mpi::sum_in_place(force, comm);
    return force;
  }

  double
  ElasticityOperator::centre_of_mass(const std::vector<double> &u) const
  {
    double mass = 0., moment = 0.;
    for (std::size_t a = 0; a < lumped_mass.size(); ++a)
      {
        mass += lumped_mass[a];
        moment += lumped_mass[a] * (reference[2 * a + 1] + u[2 * a + 1]);
      }
    return moment / mass;
  }

  BodyMeasures
  ElasticityOperator::measures(const std::vector<double> &u,
                               const std::vector<double> &v,
                               const std::vector<double> &gamma) const
  {
    double rest = 0., change = 0., energy = 0.;
    double smallest = std::numeric_limits<double>::max(), largest = -smallest;
    std::vector<double> x(u);
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] += reference[i];
    for (int e = first_element; e < first_element + n_own_elements; ++e)
      {
        evaluate_positions(x, e);
        for (int q = 0; q < tables.n_q(); ++q)
          {
            const std::size_t k =
              static_cast<std::size_t>(e) * tables.n_q() + q;
            const double here =
              gamma[e / tables.ne2 * tables.nq1 + q / tables.nq2];
            const AxisymmetricTensor F = deformation_gradient(e, q);
            const double             J = determinant(F);
            rest += tables.volume[k];
            change += (J - 1.) * tables.volume[k];
            energy +=
              tables.volume[k] *
              evaluate(prm.material,
                       elastic_part(F,
                                    active_strain.deformation(
                                      tables.frames[k], here * pattern[k])))
                .energy;
            smallest = std::min(smallest, J);
            largest  = std::max(largest, J);
          }
      }

    BodyMeasures        out{};
    std::vector<double> momentum(v.size(), 0.);
    add_inertia(v, momentum);
    for (std::size_t i = 0; i < v.size(); ++i)
      out.kinetic_energy += 0.5 * v[i] * momentum[i];
    for (std::size_t a = 0; a < lumped_mass.size(); ++a)
      {
        out.mass += lumped_mass[a];
        out.momentum += lumped_mass[a] * v[2 * a + 1];
      }
    out.centre_of_mass = centre_of_mass(u);
    rest               = mpi::sum(rest, comm);
    change             = mpi::sum(change, comm);
    out.volume         = rest + change;
    out.volume_change  = change / rest;
    out.elastic_energy = mpi::sum(energy, comm);
    out.smallest_J     = mpi::min(smallest, comm);
    out.largest_J      = mpi::max(largest, comm);
    return out;
  }

  double
  ElasticityOperator::muscle_work(const std::vector<double> &u_old,
                                  const std::vector<double> &gamma_old,
                                  const std::vector<double> &u_new,
                                  const std::vector<double> &gamma_new) const
  {
    if (!active_strain.active())
      return 0.;
    std::vector<double> middle(u_old.size());
    for (std::size_t i = 0; i < middle.size(); ++i)
      middle[i] = reference[i] + 0.5 * (u_old[i] + u_new[i]);
    double total = 0.;
    for (int e = first_element; e < first_element + n_own_elements; ++e)
      {
        evaluate_positions(middle, e);
        for (int q = 0; q < tables.n_q(); ++q)
          {
            const std::size_t k =
              static_cast<std::size_t>(e) * tables.n_q() + q;
            const int line = e / tables.ne2 * tables.nq1 + q / tables.nq2;
            // Below this the pattern is the far tail of a layer.
            if (gamma_old[line] == gamma_new[line] ||
                std::abs(pattern[k]) < 1e-15)
              continue;
            const auto active = [&](const double activation) {
              return active_strain.deformation(tables.frames[k],
                                               activation * pattern[k]);
            };
            const AxisymmetricTensor old_active = active(gamma_old[line]);
            const AxisymmetricTensor new_active = active(gamma_new[line]);
            const AxisymmetricTensor mid =
              active(0.5 * (gamma_old[line] + gamma_new[line]));
            const AxisymmetricTensor F =
              elastic_part(deformation_gradient(e, q), mid);
            const AxisymmetricTensor P = evaluate(prm.material, F).stress;
            AxisymmetricTensor       d;
            for (int i = 0; i < 5; ++i)
              d[i] = new_active[i] - old_active[i];
            if (prm.material.small_strain)
              {
                for (int i = 0; i < 5; ++i)
                  total -= tables.volume[k] * P[i] * d[i];
                continue;
              }
            // F_e^T P_e and dF_a F_a^-1
            const AxisymmetricTensor M{F[0] * P[0] + F[2] * P[2],
                                       F[0] * P[1] + F[2] * P[3],
                                       F[1] * P[0] + F[3] * P[2],
                                       F[1] * P[1] + F[3] * P[3],
                                       F[4] * P[4]};
            const AxisymmetricTensor G = inverse(mid);
            const AxisymmetricTensor rate{d[0] * G[0] + d[1] * G[2],
                                          d[0] * G[1] + d[1] * G[3],
                                          d[2] * G[0] + d[3] * G[2],
                                          d[2] * G[1] + d[3] * G[3],
                                          d[4] * G[4]};
            for (int i = 0; i < 5; ++i)
              total -= tables.volume[k] * M[i] * rate[i];
          }
      }
    return mpi::sum(total, comm);
  }

  PointFields
  ElasticityOperator::fields(const std::vector<double> &u,
                             const std::vector<double> &gamma,
                             const double               theta1,
                             const double               theta2) const
  {
    // The hoop terms have no value on the axis itself.
    const auto evaluate_at = [&](const double x1, const double x2) {
      splines::BasisValues<2> basis;
      body.evaluate_basis({x1, x2}, basis);
      splines::Point x{}, d1{}, d2{}, X{}, D1{}, D2{};
      for (std::size_t a = 0; a < basis.index.size(); ++a)
        {
          const int    k = 2 * basis.index[a];
          const double R = basis.value[a], R1 = basis.derivative[0][a],
                       R2 = basis.derivative[1][a];
          const double Xr = reference[k], Xy = reference[k + 1];
          X.r += R * Xr, X.y += R * Xy;
          D1.r += R1 * Xr, D1.y += R1 * Xy;
          D2.r += R2 * Xr, D2.y += R2 * Xy;
          x.r += R * u[k], x.y += R * u[k + 1];
          d1.r += R1 * u[k], d1.y += R1 * u[k + 1];
          d2.r += R2 * u[k], d2.y += R2 * u[k + 1];
        }
      return std::array<splines::Point, 6>{X, D1, D2, x, d1, d2};
    };
    const splines::Point at      = evaluate_at(theta1, theta2)[3];
    const double         nudge   = 1e-6;
    auto                 x       = evaluate_at(theta1, theta2);
    double               inside1 = theta1;
    if (!(x[0].r > 1e-9 * std::abs(x[1].r)))
      {
        inside1 = std::clamp(theta1, nudge, 1. - nudge);
        x       = evaluate_at(inside1, std::clamp(theta2, nudge, 1. - nudge));
      }

    PointFields out{};
    out.displacement = at;
    out.pattern      = active_strain.pattern(theta1, theta2);
    const auto above =
      std::upper_bound(tables.theta1.begin(), tables.theta1.end(), theta1);
    if (above == tables.theta1.begin())
      out.activation = gamma.front();
    else if (above == tables.theta1.end())
      out.activation = gamma.back();
    else
      {
        const auto   i = above - tables.theta1.begin();
        const double s = (theta1 - tables.theta1[i - 1]) /
                         (tables.theta1[i] - tables.theta1[i - 1]);
        out.activation = (1. - s) * gamma[i - 1] + s * gamma[i];
      }

    const auto &[X, D1, D2, v, d1, d2] = x;
    const double             det       = D1.r * D2.y - D2.r * D1.y;
    const AxisymmetricTensor F{1. + (d1.r * D2.y - d2.r * D1.y) / det,
                               (-d1.r * D2.r + d2.r * D1.r) / det,
                               (d1.y * D2.y - d2.y * D1.y) / det,
                               1. + (-d1.y * D2.r + d2.y * D1.r) / det,
                               1. + v.r / X.r};
    out.J = determinant(F);
    // F g_k is the tangent of the deformed line.
    const auto stretch = [](const splines::Point &D, const splines::Point &d) {
      return std::hypot(D.r + d.r, D.y + d.y) / std::hypot(D.r, D.y);
    };
    out.stretch = {{stretch(D1, d1), stretch(D2, d2), F[4]}};
    out.cauchy  = cauchy_stress(
      prm.material,
      elastic_part(F,
                   active_strain.deformation({D1, D2, X.r},
                                             out.activation * out.pattern)));
    return out;
  }
} // namespace ephyra::elasticity
