#include "ephyra/electrophysiology/monodomain_operator.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/splines/patch_quadrature.h"

#include <algorithm>
#include <cmath>

namespace ephyra::electrophysiology
{
  using linear_algebra::NarrowBandMatrix;

  MonodomainOperator::MonodomainOperator()
    : theta(1, 0.)
    , greville_points(1, 0.)
    , first(1, 0)
    , values(1, 1.)
    , derivatives(1, 0.)
    , weight(1, 1.)
    , reference_measure(1, 1.)
    , G11(1, 1.)
    , r(1, 1.)
    , measure(1, 1.)
    , collocation_matrix(1, 0)
    , shifted(1)
  {
    collocation_matrix(0, 0) = 1;
    assemble();
  }

  MonodomainOperator::MonodomainOperator(const splines::NurbsPatch<1> &curve,
                                         const Mass                    mass,
                                         const Measure                 measure)
    : line(1, curve)
    , mass_kind(mass)
    , measure_kind(measure)
    , n(curve.n_control_points())
    , n_elements(curve.n_elements())
    , n_per_element(curve.degree(0) + 1)
    , n_local(curve.degree(0) + 1)
    , greville_points(curve.knot_vector(0).greville())
    , collocation_matrix(n, curve.degree(0))
    , shifted(static_cast<std::size_t>(n_local) * n_elements)
  {
    const splines::Point &begin = curve.control_points().front();
    const splines::Point &end   = curve.control_points().back();
    is_closed                   = begin.r > 0 &&
                std::hypot(end.r - begin.r, end.y - begin.y) <= 1e-12 * begin.r;
    const splines::PatchQuadrature<1> quadrature(curve, {{n_per_element}});
    const std::size_t                 n_gauss = n_gauss_points();
    theta.resize(n_gauss);
    weight.resize(n_gauss);
    reference_measure.resize(n_gauss);
    this->measure.resize(n_gauss);
    G11.resize(n_gauss);
    r.resize(n_gauss);
    values.resize(n_gauss * n_local);
    derivatives.resize(n_gauss * n_local);
    for (int e = 0; e < n_elements; ++e)
      {
        first.push_back(curve.knot_vector(0).first_basis(e));
        for (int q = 0; q < n_per_element; ++q)
          {
            const int i = e * n_per_element + q;
            theta[i]    = quadrature.theta(e, q)[0];
            weight[i]   = quadrature.weight(e, q);
            for (int a = 0; a < n_local; ++a)
              {
                const std::size_t entry =
                  static_cast<std::size_t>(q * n_local + a) * n_elements + e;
                values[entry]      = quadrature.values(e, q)[a];
                derivatives[entry] = quadrature.derivatives(e, q, 0)[a];
              }
            const splines::Point g = curve.tangents({{theta[i]}})[0];
            G11[i]                 = g.r * g.r + g.y * g.y;
            r[i]                   = curve.point({{theta[i]}}).r;
            reference_measure[i]   = r[i] * std::sqrt(G11[i]);
          }
      }
    std::vector<double> N;
    for (int i = 0; i < n; ++i)
      {
        int j;
        basis(greville_points[i], j, N);
        for (int a = 0; a < n_local; ++a)
          if (std::abs(i - j - a) < n_local)
            collocation_matrix(i, j + a) = N[a];
      }
    assemble();
  }

  void
  MonodomainOperator::basis(const double         x,
                            int                 &first_index,
                            std::vector<double> &N) const
  {
    first_index = 0;
    N.assign(n_local, 1.);
    if (line.empty())
      return;
    splines::BasisValues<1> basis_values;
    line[0].evaluate_basis({{x}}, basis_values);
    first_index = basis_values.index[0];
    N           = basis_values.value;
  }

  bool
  MonodomainOperator::set_metric(const std::vector<double> &new_G11,
                                 const std::vector<double> &new_r,
                                 const double               tolerance)
  {
    EphyraAssert(new_G11.size() == G11.size() && new_r.size() == r.size(),
                 "The metric has to be given at all Gauss points.");
    const bool uses_r  = measure_kind == Measure::deformed;
    bool       changed = false;
    for (std::size_t i = 0; i < G11.size() && !changed; ++i)
      // Written so that a value that is not a number counts as a change.
      changed = !(std::abs(new_G11[i] - G11[i]) <= tolerance * G11[i]) ||
                (uses_r && !(std::abs(new_r[i] - r[i]) <= tolerance * r[i]));
    if (!changed)
      return false;
    G11 = new_G11;
    r   = new_r;
    assemble();
    return true;
  }

  void
  MonodomainOperator::assemble()
  {
    const int width    = n_local - 1;
    mass_matrix        = NarrowBandMatrix(n, width);
    lumped_mass_matrix = NarrowBandMatrix(n, width);
    stiffness_matrix   = NarrowBandMatrix(n, width);
    for (int e = 0; e < n_elements; ++e)
      for (int q = 0; q < n_per_element; ++q)
        {
          const int i = e * n_per_element + q;
          EphyraThrowIf(!(G11[i] > 0) || !std::isfinite(G11[i]) || !(r[i] > 0),
                        DivergedError,
                        "The line of the tissue is degenerate at theta^1 = "
                          << theta[i] << ": G_11 = " << G11[i] << " m^2, r = "
                          << r[i] << " m; both must be positive.");
          const double w = weight[i] * (measure_kind == Measure::reference
                                          ? reference_measure[i]
                                          : r[i] * std::sqrt(G11[i]));
          measure[static_cast<std::size_t>(q) * n_elements + e] = w;
          const double *N =
            &values[static_cast<std::size_t>(q) * n_local * n_elements + e];
          const double *dN =
            &derivatives[static_cast<std::size_t>(q) * n_local * n_elements +
                         e];
          for (int a = 0; a < n_local; ++a)
            for (int b = 0; b < n_local; ++b)
              {
                const int    row = first[e] + a, column = first[e] + b;
                const double m = w * N[a * n_elements] * N[b * n_elements];
                mass_matrix(row, column) += m;
                lumped_mass_matrix(row, row) += m;
                stiffness_matrix(row, column) +=
                  w / G11[i] * dN[a * n_elements] * dN[b * n_elements];
              }
        }
  }

  void
  MonodomainOperator::interpolate(const double *coefficients,
                                  double       *gauss_values) const
  {
    for (int e = 0; e < n_elements; ++e)
      for (int a = 0; a < n_local; ++a)
        shifted[static_cast<std::size_t>(a) * n_elements + e] =
          coefficients[first[e] + a];
    for (int q = 0; q < n_per_element; ++q)
      {
        double *__restrict__ out =
          gauss_values + static_cast<std::size_t>(q) * n_elements;
        std::fill(out, out + n_elements, 0.);
        for (int a = 0; a < n_local; ++a)
          {
            const double *__restrict__ N =
              &values[static_cast<std::size_t>(q * n_local + a) * n_elements];
            const double *__restrict__ c =
              &shifted[static_cast<std::size_t>(a) * n_elements];
            for (int e = 0; e < n_elements; ++e)
              out[e] += N[e] * c[e];
          }
      }
  }

  void
  MonodomainOperator::integrate(const double *gauss_values, double *load) const
  {
    std::fill(shifted.begin(), shifted.end(), 0.);
    for (int q = 0; q < n_per_element; ++q)
      {
        const std::size_t offset     = static_cast<std::size_t>(q) * n_elements;
        const double *__restrict__ f = gauss_values + offset;
        const double *__restrict__ w = &measure[offset];
        for (int a = 0; a < n_local; ++a)
          {
            const double *__restrict__ N =
              &values[static_cast<std::size_t>(q * n_local + a) * n_elements];
            double *__restrict__ sum =
              &shifted[static_cast<std::size_t>(a) * n_elements];
            for (int e = 0; e < n_elements; ++e)
              sum[e] += N[e] * w[e] * f[e];
          }
      }
    std::fill(load, load + n, 0.);
    for (int e = 0; e < n_elements; ++e)
      for (int a = 0; a < n_local; ++a)
        load[first[e] + a] +=
          shifted[static_cast<std::size_t>(a) * n_elements + e];
  }

  double
  MonodomainOperator::longest_element() const
  {
    double longest = 0;
    for (int e = 0; e < n_elements && !line.empty(); ++e)
      {
        double length = 0;
        for (int i = e * n_per_element; i < (e + 1) * n_per_element; ++i)
          length += weight[i] * std::sqrt(G11[i]);
        longest = std::max(longest, length);
      }
    return longest;
  }

  void
  MonodomainOperator::shares(std::vector<double> &result) const
  {
    // Row sums of the mass matrix: the functions sum to one.
    result.resize(n);
    const std::vector<double> one(n, 1.);
    mass_matrix.multiply(one.data(), result.data());
  }

  std::vector<double>
  MonodomainOperator::interval_load(const std::array<double, 2> &interval) const
  {
    std::vector<double> load(n, 0.);
    if (line.empty())
      return std::vector<double>(1, 1.);
    const std::vector<double> &breaks = line[0].knot_vector(0).breaks();
    const splines::Quadrature  rule   = splines::gauss_legendre(n_per_element);
    std::vector<double>        N;
    for (int e = 0; e < n_elements; ++e)
      {
        const double a = std::max(breaks[e], interval[0]);
        const double b = std::min(breaks[e + 1], interval[1]);
        if (a >= b)
          continue;
        for (int q = 0; q < rule.size(); ++q)
          {
            const double         x = a + (b - a) * rule.points[q];
            const splines::Point g = line[0].tangents({{x}})[0];
            const double         w = (b - a) * rule.weights[q] *
                             line[0].point({{x}}).r * std::hypot(g.r, g.y);
            int j;
            basis(x, j, N);
            for (int k = 0; k < n_local; ++k)
              load[j + k] += w * N[k];
          }
      }
    return load;
  }
} // namespace ephyra::electrophysiology
