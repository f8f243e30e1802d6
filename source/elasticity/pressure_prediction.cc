#include "element_kernel.h"

#include "ephyra/elasticity/elasticity_operator.h"

namespace ephyra::elasticity
{
  void
  ElasticityOperator::predict_pressure(const std::vector<double> &u,
                                       const std::vector<double> &du)
  {
    if (prm.material.small_strain)
      return;
    position.resize(u.size());
    for (std::size_t i = 0; i < u.size(); ++i)
      position[i] = reference[i] + u[i];
    const int nq = tables.n_q();
    predicted_pressure.resize(tables.volume.size());
    std::vector<double> old(6 * static_cast<std::size_t>(nq));
    for (int e = first_element; e < first_element + n_own_elements; ++e)
      {
        gather(position, e);
        internal::evaluate_values(tables, e, *work);
        old.swap(work->values);
        gather(du, e);
        internal::evaluate_values(tables, e, *work);
        const double *x  = old.data();
        const double *dx = work->values.data();
        const double *T  = &transform[static_cast<std::size_t>(e) *
                                     PatchTables::n_transform * nq];
        double       *p = &predicted_pressure[static_cast<std::size_t>(e) * nq];
        for (int q = 0; q < nq; ++q)
          {
            // Row J of the transform times the values of component i.
            const auto F = [&](const double *v, const int J, const int i) {
              return T[3 * J * nq + q] * v[3 * i * nq + q] +
                     T[(3 * J + 1) * nq + q] * v[(3 * i + 1) * nq + q] +
                     T[(3 * J + 2) * nq + q] * v[(3 * i + 2) * nq + q];
            };
            const double rr = F(x, 0, 0), ry = F(x, 1, 0);
            const double yr = F(x, 0, 1), yy = F(x, 1, 1);
            const double det    = rr * yy - ry * yr;
            const double change = F(dx, 0, 0) * yy + rr * F(dx, 1, 1) -
                                  F(dx, 1, 0) * yr - ry * F(dx, 0, 1);
            const double J =
              T[6 * nq + q] * ((det + change) * x[q] + det * dx[q]);
            p[q] = 2. * prm.material.K * (J - 1.);
          }
      }
  }
} // namespace ephyra::elasticity
