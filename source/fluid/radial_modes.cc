#include "ephyra/fluid/radial_modes.h"

#include "ephyra/base/exceptions.h"

#include <algorithm>
#include <cmath>

extern "C"
{
  void
  dgemm_(const char *,
         const char *,
         const int *,
         const int *,
         const int *,
         const double *,
         const double *,
         const int *,
         const double *,
         const int *,
         const double *,
         double *,
         const int *);
  void
  dstevd_(const char *,
          const int *,
          double *,
          double *,
          double *,
          const int *,
          double *,
          const int *,
          int *,
          const int *,
          int *);
}

namespace ephyra::fluid
{
  void
  multiply(const char    transpose_a,
           const char    transpose_b,
           const int     m,
           const int     n,
           const int     k,
           const double *a,
           const int     stride_a,
           const double *b,
           const int     stride_b,
           double       *c,
           const int     stride_c)
  {
    const double one = 1, zero = 0;
    dgemm_(&transpose_a,
           &transpose_b,
           &m,
           &n,
           &k,
           &one,
           a,
           &stride_a,
           b,
           &stride_b,
           &zero,
           c,
           &stride_c);
  }

  RadialModes::RadialModes(const StaggeredGrid &grid,
                           const bool           outer_dirichlet)
    : n(grid.r.n_cells)
    , root_weight(n)
    , vectors(static_cast<std::size_t>(n) * n)
  {
    // Flux through face i over the difference of phi; 0 at the axis.
    std::vector<double> conductance(n + 1);
    for (int i = 0; i <= n; ++i)
      conductance[i] =
        i < n || outer_dirichlet ? grid.r.face[i] / grid.r.centre_gap[i] : 0.;
    for (int i = 0; i < n; ++i)
      root_weight[i] = std::sqrt(grid.r.centre[i] * grid.r.width[i]);
    decompose(conductance);
    for (int k = 0; k < n; ++k)
      improve(k, conductance);
    if (!outer_dirichlet)
      eigenvalues[0] = 0;
  }

  void
  RadialModes::decompose(const std::vector<double> &conductance)
  {
    std::vector<double> off_diagonal(n);
    eigenvalues.resize(n);
    for (int i = 0; i < n; ++i)
      {
        eigenvalues[i] = (conductance[i] + conductance[i + 1]) /
                         (root_weight[i] * root_weight[i]);
        if (i < n - 1)
          off_diagonal[i] =
            -conductance[i + 1] / (root_weight[i] * root_weight[i + 1]);
      }
    const char          with_vectors = 'V';
    const int           work_size    = 1 + 4 * n + n * n;
    const int           integer_size = 3 + 5 * n;
    std::vector<double> work(work_size);
    std::vector<int>    integers(integer_size);
    int                 info = 0;
    dstevd_(&with_vectors,
            &n,
            eigenvalues.data(),
            off_diagonal.data(),
            vectors.data(),
            &n,
            work.data(),
            &work_size,
            integers.data(),
            &integer_size,
            &info);
    EphyraThrowIf(info != 0,
                  DivergedError,
                  "The eigenvectors of the radial grid could not be computed "
                  "(LAPACK dstevd returned "
                    << info << "): check the radial breakpoints and spacings.");
  }

  void
  RadialModes::improve(const int k, const std::vector<double> &conductance)
  {
    using Real           = long double;
    double *const v      = &vectors[static_cast<std::size_t>(k) * n];
    const auto    weight = [&](const int i) {
      return static_cast<Real>(root_weight[i]) * root_weight[i];
    };
    std::vector<Real> phi(n);
    const auto        rayleigh_quotient = [&] {
      Real energy = conductance[n] * phi[n - 1] * phi[n - 1], size = 0;
      for (int i = 0; i < n; ++i)
        {
          size += weight(i) * phi[i] * phi[i];
          if (i > 0)
            {
              const Real difference = phi[i] - phi[i - 1];
              energy += conductance[i] * difference * difference;
            }
        }
      return std::make_pair(energy / size, size);
    };
    for (int i = 0; i < n; ++i)
      phi[i] = static_cast<Real>(v[i]) / root_weight[i];
    const Real lambda = rayleigh_quotient().first;

    // flux_(i+1) - flux_i = -lambda weight_i phi_i
    const int largest =
      static_cast<int>(std::max_element(v,
                                        v + n,
                                        [](const double a, const double b) {
                                          return std::abs(a) < std::abs(b);
                                        }) -
                       v);
    const Real given = phi[largest];
    Real       flux  = 0;
    phi[0]           = 1;
    for (int i = 0; i < largest; ++i)
      {
        flux -= lambda * weight(i) * phi[i];
        phi[i + 1] = phi[i] + flux / conductance[i + 1];
      }
    Real scale = given / phi[largest];
    for (int i = 0; i < largest; ++i)
      phi[i] *= scale;
    if (largest < n - 1)
      {
        phi[n - 1] = 1;
        flux       = -conductance[n];
        for (int i = n - 1; i > largest; --i)
          {
            flux += lambda * weight(i) * phi[i];
            phi[i - 1] = phi[i] - flux / conductance[i];
          }
        scale = given / phi[largest];
        for (int i = largest + 1; i < n; ++i)
          phi[i] *= scale;
      }
    phi[largest] = given;

    const auto [quotient, size] = rayleigh_quotient();
    eigenvalues[k]              = static_cast<double>(quotient);
    const Real factor           = 1 / std::sqrt(size);
    for (int i = 0; i < n; ++i)
      v[i] = static_cast<double>(phi[i] * factor * root_weight[i]);
  }
} // namespace ephyra::fluid
