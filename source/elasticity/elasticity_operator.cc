#include "ephyra/elasticity/elasticity_operator.h"

#include "element_kernel.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ephyra::elasticity
{
  using linear_algebra::SparseMatrix;

  ElasticityOperator::ElasticityOperator(const Parameters &parameters,
                                         const splines::NurbsPatch<2> &patch,
                                         const MPI_Comm                comm)
    : prm(parameters)
    , body(patch)
    , comm(comm)
    , rank(mpi::rank(comm))
    , n_ranks(mpi::size(comm))
    , active_strain(parameters.active_strain)
    , constraints(patch, parameters.sides, parameters.tie)
    , tables(patch,
             {{patch.degree(0) + 1 + parameters.n_extra_points()[0],
               patch.degree(1) + 1 + parameters.n_extra_points()[1]}})
    , work(std::make_unique<internal::ElementWork>(tables))
  {
    for (int d = 0; d < 2; ++d)
      EphyraThrowIf(patch.degree(d) < 1 || patch.degree(d) > 6,
                    InputError,
                    "Elasticity is built for degrees 1 to 6, not for degree "
                      << patch.degree(d) << " in direction " << d + 1
                      << " of the patch; choose one of those.");
    EphyraThrowIf(
      !(prm.density > 0.) || !(prm.material.c10 > 0.) || !(prm.material.K > 0.),
      InputError,
      "Density " << prm.density << " kg/m^3, c10 " << prm.material.c10
                 << " Pa and K " << prm.material.K
                 << " Pa of a body all have to be positive.");

    const mpi::Share share = mpi::share(tables.n_elements(), rank, n_ranks);
    first_element          = share.first;
    n_own_elements         = share.count;

    for (const splines::Point &x : patch.control_points())
      {
        reference.push_back(x.r);
        reference.push_back(x.y);
      }
    for (const int point : tables.points)
      for (int i = 0; i < 2; ++i)
        equations.push_back(constraints.equation(2 * point + i));
    for (const splines::Side side : all_sides)
      if (prm.sides[static_cast<int>(side)].loaded())
        side_loads.emplace_back(patch,
                                side,
                                prm.sides[static_cast<int>(side)],
                                tables.orientation,
                                std::max(tables.nq1, tables.nq2),
                                prm.material.small_strain);

    assemble_mass();
    const int nq = tables.n_q();
    for (int e = 0; e < tables.n_elements(); ++e)
      for (int q = 0; q < nq; ++q)
        pattern.push_back(active_strain.pattern(
          tables.theta1[e / tables.ne2 * tables.nq1 + q / tables.nq2],
          tables.theta2[e % tables.ne2 * tables.nq2 + q % tables.nq2]));
    check_shortening();
    transform = tables.transform;
    shift.assign(static_cast<std::size_t>(4) * nq * tables.n_elements(), 0.);
    set_activation(std::vector<double>(tables.theta1.size(), 0.));
    set_time(0.);
  }

  ElasticityOperator::~ElasticityOperator() = default;

  void
  ElasticityOperator::check_shortening()
  {
    const std::size_t n_q = tables.n_q();
    for (std::size_t k = 0; k < pattern.size(); ++k)
      {
        const double value =
          active_strain.shortening(tables.frames[k], pattern[k]);
        EphyraThrowIf(
          !(value < ActiveStrain::largest_shortening),
          InputError,
          "The active strain shortens a fibre by "
            << value << " at theta1 = "
            << tables.theta1[(k / n_q) / tables.ne2 * tables.nq1 +
                             (k % n_q) / tables.nq2]
            << ", r = " << tables.positions[k].r << " m; it has to stay below "
            << ActiveStrain::largest_shortening
            << ": lower the amplitude, or cut the pattern off nearer to the "
               "margin where the paper metric diverges at the axis.");
        shortening = std::max(shortening, value);
      }
  }

  void
  ElasticityOperator::assemble_mass()
  {
    const int n = tables.n_local(), n2 = tables.n2;
    const int pairs = tables.n1 * (tables.n1 + 1) / 2;
    element_mass.assign(
      static_cast<std::size_t>(tables.n_elements()) * pairs * n2 * n2, 0.);
    linear_algebra::SparsityPattern coupled(body.n_control_points());
    for (int e = 0; e < tables.n_elements(); ++e)
      coupled.add_element(
        {tables.points.begin() + e * n, tables.points.begin() + (e + 1) * n});
    coupled.compress();
    mass_start.push_back(0);
    for (const std::vector<int> &row : coupled.columns)
      {
        mass_column.insert(mass_column.end(), row.begin(), row.end());
        mass_start.push_back(static_cast<int>(mass_column.size()));
      }
    mass_value.assign(mass_column.size(), 0.);
    lumped_mass.assign(body.n_control_points(), 0.);
    std::vector<double> unit_force(n_unknowns(), 0.);

    std::vector<double> R(n), local(static_cast<std::size_t>(n) * n);
    for (int e = 0; e < tables.n_elements(); ++e)
      {
        std::fill(local.begin(), local.end(), 0.);
        for (int q = 0; q < tables.n_q(); ++q)
          {
            const std::size_t k =
              static_cast<std::size_t>(e) * tables.n_q() + q;
            const double *T =
              &tables.transform[static_cast<std::size_t>(e) *
                                  PatchTables::n_transform * tables.n_q() +
                                q];
            const auto t = [&](const int row) { return T[row * tables.n_q()]; };
            const double *N1 =
              &tables.basis1[2 * tables.n1 *
                             (e / tables.ne2 * tables.nq1 + q / tables.nq2)];
            const double *N2 =
              &tables
                 .basis2[(2 * (e % tables.ne2) * tables.nq2 + q % tables.nq2) *
                         n2];
            const double *dN2 = N2 + tables.nq2 * n2;
            for (int a = 0; a < n; ++a)
              {
                const double w  = tables.weights[e * n + a];
                const int    a1 = a / n2, a2 = a % n2;
                const double N   = w * N1[a1] * N2[a2];
                const double d1  = w * N1[tables.n1 + a1] * N2[a2];
                const double d2  = w * N1[a1] * dN2[a2];
                R[a]             = N * t(6) * tables.frames[k].r;
                const double g_r = t(0) * N + t(1) * d1 + t(2) * d2;
                const double g_y = t(3) * N + t(4) * d1 + t(5) * d2;
                const double h   = t(6) * N;
                const double f   = prm.material.bulk_modulus() *
                                 tables.volume[k] *
                                 std::sqrt(g_r * g_r + g_y * g_y + h * h);
                unit_force[2 * tables.points[e * n + a]] += f;
                unit_force[2 * tables.points[e * n + a] + 1] += f;
              }
            for (int a = 0; a < n; ++a)
              for (int b = 0; b < n; ++b)
                local[a * n + b] +=
                  prm.density * tables.volume[k] * R[a] * R[b];
          }

        double *pair =
          &element_mass[static_cast<std::size_t>(e) * pairs * n2 * n2];
        for (int a1 = 0; a1 < tables.n1; ++a1)
          for (int b1 = a1; b1 < tables.n1; ++b1)
            for (int a2 = 0; a2 < n2; ++a2)
              for (int b2 = 0; b2 < n2; ++b2)
                *pair++ = local[(a1 * n2 + a2) * n + b1 * n2 + b2];
        for (int a = 0; a < n; ++a)
          for (int b = 0; b < n; ++b)
            {
              const int  row   = tables.points[e * n + a];
              const auto begin = mass_column.begin() + mass_start[row];
              const auto end   = mass_column.begin() + mass_start[row + 1];
              const auto found =
                std::lower_bound(begin, end, tables.points[e * n + b]);
              mass_value[found - mass_column.begin()] += local[a * n + b];
              lumped_mass[row] += local[a * n + b];
            }
      }
    for (const double f : unit_force)
      unit_force_norm += f * f;
    unit_force_norm = std::sqrt(unit_force_norm);
  }

  linear_algebra::SparsityPattern
  ElasticityOperator::sparsity_pattern() const
  {
    linear_algebra::SparsityPattern pattern(n_unknowns());
    std::vector<int>                unknowns;
    for (int e = 0; e < tables.n_elements(); ++e)
      {
        unknowns.clear();
        for (int k = 0; k < 2 * tables.n_local(); ++k)
          if (const int i = equations[2 * e * tables.n_local() + k]; i >= 0)
            unknowns.push_back(i);
        pattern.add_element(unknowns);
      }
    for (int i = 0; i < n_unknowns(); ++i)
      pattern.columns[i].push_back(i);
    return pattern;
  }

  void
  ElasticityOperator::set_time(const double t, const double load_factor)
  {
    constraints.set_time(t, load_factor);
    for (SideLoad &load : side_loads)
      load.set_time(t, load_factor);
    if (prm.body_force[0].is_zero() && prm.body_force[1].is_zero())
      return;
    body_force_values.clear();
    for (const Expression &formula : prm.body_force)
      for (const splines::Point &x : tables.positions)
        body_force_values.push_back(
          formula.is_zero() ? 0. : load_factor * formula({x.r, x.y, t}));
  }

  void
  ElasticityOperator::set_activation(const std::vector<double> &new_gamma)
  {
    EphyraThrowIf(new_gamma.size() != tables.theta1.size(),
                  InputError,
                  "The activation has "
                    << new_gamma.size() << " values instead of one on each of "
                    << tables.theta1.size() << " lines of Gauss points.");
    gamma = new_gamma;
    if (!active_strain.active())
      return;
    const double largest = *std::max_element(gamma.begin(), gamma.end());
    EphyraThrowIf(!(largest * shortening < ActiveStrain::largest_shortening),
                  DivergedError,
                  "The activation " << largest << " shortens a fibre by "
                                    << largest * shortening
                                    << ", which has to stay below "
                                    << ActiveStrain::largest_shortening << ".");

    const int nq = tables.n_q();
    for (int e = first_element; e < first_element + n_own_elements; ++e)
      for (int q = 0; q < nq; ++q)
        {
          const std::size_t k = static_cast<std::size_t>(e) * nq + q;
          const double      here =
            gamma[e / tables.ne2 * tables.nq1 + q / tables.nq2];
          const AxisymmetricTensor F =
            active_strain.deformation(tables.frames[k], here * pattern[k]);
          if (prm.material.small_strain)
            {
              const double values[] = {F[0] - 1., F[1], F[3] - 1., F[4] - 1.};
              for (int i = 0; i < 4; ++i)
                shift[(4 * static_cast<std::size_t>(e) + i) * nq + q] =
                  values[i];
              continue;
            }
          const AxisymmetricTensor G = inverse(F);
          const std::size_t        start =
            static_cast<std::size_t>(e) * PatchTables::n_transform * nq + q;
          const double *T0 = &tables.transform[start];
          double       *T  = &transform[start];
          for (int s = 0; s < 3; ++s)
            {
              const double r = T0[s * nq], y = T0[(3 + s) * nq];
              T[s * nq]       = G[0] * r + G[1] * y;
              T[(3 + s) * nq] = G[2] * r + G[3] * y;
            }
          T[6 * nq] = G[4] * T0[6 * nq];
        }
  }

  void
  ElasticityOperator::gather(const std::vector<double> &x, const int e) const
  {
    const int     n = tables.n_local();
    const int    *a = &tables.points[static_cast<std::size_t>(e) * n];
    const double *w = &tables.weights[static_cast<std::size_t>(e) * n];
    double       *c = work->coefficients.data();
    for (int k = 0; k < n; ++k)
      {
        c[k]     = w[k] * x[2 * a[k]];
        c[n + k] = w[k] * x[2 * a[k] + 1];
      }
  }

  template <int n2>
  bool
  ElasticityOperator::element(const int     e,
                              SparseMatrix *matrix,
                              const double  stiffness_factor,
                              const double  mass_factor)
  {
    const int     nq = tables.n_q(), n = tables.n_local();
    const auto    index  = static_cast<std::size_t>(e);
    const double *T      = &transform[index * PatchTables::n_transform * nq];
    const double *volume = &tables.volume[index * nq];
    const double *moved  = &shift[index * 4 * nq];
    const double *predicted =
      predicted_pressure.empty() ? nullptr : &predicted_pressure[index * nq];
    const Material &m = prm.material;

    internal::evaluate_values<n2>(tables, e, *work);
    if (m.small_strain)
      {
        const double mu = m.shear_modulus(), kappa = m.bulk_modulus();
        if (matrix)
          internal::evaluate_material<true, true>(
            tables, mu, kappa, T, volume, moved, predicted, *work);
        else
          internal::evaluate_material<true, false>(
            tables, mu, kappa, T, volume, moved, predicted, *work);
      }
    else
      {
        if (matrix)
          internal::evaluate_material<false, true>(
            tables, m.c10, m.K, T, volume, moved, predicted, *work);
        else
          internal::evaluate_material<false, false>(
            tables, m.c10, m.K, T, volume, moved, predicted, *work);
        if (!(work->smallest_J > 0.))
          return false;
      }

    if (!body_force_values.empty())
      for (int i = 0; i < 2; ++i)
        {
          const double *b =
            &body_force_values[i * tables.positions.size() + index * nq];
          const double *T6 = &tables.transform[(index * 7 + 6) * nq];
          for (int q = 0; q < nq; ++q)
            work->flux[3 * i * nq + q] -=
              volume[q] * b[q] * T6[q] * tables.frames[index * nq + q].r;
        }
    internal::integrate_force<n2>(tables, e, *work);

    if (matrix)
      {
        const std::size_t pairs =
          static_cast<std::size_t>(tables.n1) * (tables.n1 + 1) / 2 * n2 * n2;
        internal::integrate_matrix<n2>(tables,
                                       e,
                                       stiffness_factor,
                                       mass_factor,
                                       &element_mass[index * pairs],
                                       *work);
        matrix->add(&equations[index * 2 * n], 2 * n, work->matrix.data());
      }
    return true;
  }

  ElasticityOperator::Evaluation
  ElasticityOperator::assemble(const std::vector<double> &u,
                               std::vector<double>       &residual,
                               SparseMatrix              *matrix,
                               const double               stiffness_factor,
                               const double               mass_factor)
  {
    const std::size_t n = u.size();
    position.resize(n);
    for (std::size_t i = 0; i < n; ++i)
      position[i] = reference[i] + u[i];

    std::vector<double> &scale = sums;
    residual.assign(n, 0.);
    scale.assign(n, 0.);
    double smallest = std::numeric_limits<double>::max();
    for (int e = first_element; e < first_element + n_own_elements; ++e)
      {
        gather(position, e);
        const bool valid =
          internal::with_width(tables.n2, [&](const auto width) {
            return element<width>(e, matrix, stiffness_factor, mass_factor);
          });
        if (!prm.material.small_strain &&
            !(work->smallest_J >= smallest)) // NaN counts as smallest
          smallest = work->smallest_J;
        if (!valid)
          continue;
        const int *points =
          &tables.points[static_cast<std::size_t>(e) * tables.n_local()];
        const double *force = work->force.data();
        for (int a = 0; a < tables.n_local(); ++a)
          for (int i = 0; i < 2; ++i)
            {
              residual[2 * points[a] + i] += force[2 * a + i];
              scale[2 * points[a] + i] += std::abs(force[2 * a + i]);
            }
      }
    for (const SideLoad &load : side_loads)
      {
        load.subtract_force(position, rank, n_ranks, residual, scale);
        if (matrix)
          load.add_tangent(
            position, rank, n_ranks, stiffness_factor, constraints, *matrix);
      }
    if (matrix)
      add_identity(*matrix);

    if (n_ranks > 1)
      {
        mpi::sum_in_place(residual, comm);
        mpi::sum_in_place(scale, comm);
        if (!std::isfinite(smallest))
          smallest = -std::numeric_limits<double>::max();
        smallest = mpi::min(smallest, comm);
      }
    double square = 0.;
    for (const double s : scale)
      square += s * s;
    return {smallest, std::sqrt(square)};
  }

  void
  ElasticityOperator::add_identity(SparseMatrix &matrix) const
  {
    if (rank == 0)
      for (int i = 0; i < n_unknowns(); ++i)
        if (constraints.equation(i) != i)
          matrix.add(i, i, 1.);
  }

  ElasticityOperator::Evaluation
  ElasticityOperator::residual(const std::vector<double> &u,
                               std::vector<double>       &residual)
  {
    return assemble(u, residual, nullptr, 0., 0.);
  }

  ElasticityOperator::Evaluation
  ElasticityOperator::residual_and_tangent(const std::vector<double> &u,
                                           std::vector<double>       &residual,
                                           SparseMatrix              &matrix,
                                           const double stiffness_factor,
                                           const double mass_factor)
  {
    const Evaluation result =
      assemble(u, residual, &matrix, stiffness_factor, mass_factor);
    predicted_pressure.clear();
    return result;
  }

  void
  ElasticityOperator::add_inertia(const std::vector<double> &a,
                                  std::vector<double>       &residual) const
  {
    for (std::size_t row = 0; row + 1 < mass_start.size(); ++row)
      {
        double r = 0., y = 0.;
        for (int k = mass_start[row]; k < mass_start[row + 1]; ++k)
          {
            r += mass_value[k] * a[2 * mass_column[k]];
            y += mass_value[k] * a[2 * mass_column[k] + 1];
          }
        residual[2 * row] += r;
        residual[2 * row + 1] += y;
      }
  }

  void
  ElasticityOperator::add_mass(SparseMatrix &matrix)
  {
    add_identity(matrix);
    if (rank != 0)
      return;
    for (std::size_t row = 0; row + 1 < mass_start.size(); ++row)
      for (int k = mass_start[row]; k < mass_start[row + 1]; ++k)
        for (int i = 0; i < 2; ++i)
          {
            const int test  = constraints.equation(2 * row + i);
            const int trial = constraints.equation(2 * mass_column[k] + i);
            if (test >= 0 && trial >= 0)
              matrix.add(test, trial, mass_value[k]);
          }
  }
} // namespace ephyra::elasticity
