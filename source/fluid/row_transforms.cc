#include "ephyra/fluid/row_transforms.h"

#include "ephyra/base/exceptions.h"

#include <fftw3.h>

#include <algorithm>
#include <cmath>

namespace ephyra::fluid
{
  struct RowTransforms::Plans
  {
    ~Plans()
    {
      fftw_destroy_plan(forward);
      fftw_destroy_plan(backward);
    }
    fftw_plan forward = nullptr, backward = nullptr;
  };

  namespace
  {
    /// FFTW's name of the real transform and of its inverse.
    std::pair<fftw_r2r_kind, fftw_r2r_kind>
    real_kinds(const RowEnds ends)
    {
      switch (ends)
        {
        case RowEnds::neumann_dirichlet:
          return {FFTW_REDFT11, FFTW_REDFT11};
        case RowEnds::dirichlet_neumann:
          return {FFTW_RODFT11, FFTW_RODFT11};
        default:
          return {FFTW_R2HC, FFTW_HC2R};
        }
    }
  } // namespace

  RowTransforms::RowTransforms(const int n, const RowEnds ends)
    : n(n)
    , ends(ends)
  {
    if (in_pairs())
      {
        complex = std::make_unique<ComplexTransform>(n);
        spare_row.resize(n);
        for (int position = 0; position < n; ++position)
          {
            const double phase = 0.5 * M_PI * complex->mode(position) / n;
            cosine.push_back(std::cos(phase));
            sine.push_back(std::sin(phase));
          }
        return;
      }
    // Plans that FFTW measures differ from run to run, and so would the results
    // in their last digits.
    plans = std::make_unique<Plans>();
    buffer.resize(n);
    double *const data             = buffer.data();
    const auto [forward, backward] = real_kinds(ends);
    plans->forward  = fftw_plan_r2r_1d(n, data, data, forward, FFTW_ESTIMATE);
    plans->backward = fftw_plan_r2r_1d(n, data, data, backward, FFTW_ESTIMATE);
  }

  RowTransforms::~RowTransforms() = default;

  bool
  RowTransforms::in_pairs() const
  {
    return ends == RowEnds::neumann_neumann ||
           ends == RowEnds::dirichlet_dirichlet;
  }

  double
  RowTransforms::scale() const
  {
    return ends == RowEnds::periodic ? n : 2 * n;
  }

  std::vector<double>
  RowTransforms::eigenvalues(const double h) const
  {
    std::vector<double> lambda(n);
    for (int k = 0; k < n; ++k)
      {
        double half_phase = 0.5 * M_PI * (k + 0.5) / n;
        if (ends == RowEnds::neumann_neumann)
          half_phase = 0.5 * M_PI * complex->mode(k) / n;
        else if (ends == RowEnds::dirichlet_dirichlet)
          half_phase = 0.5 * M_PI * (n - complex->mode(k)) / n;
        else if (ends == RowEnds::periodic)
          half_phase = M_PI * std::min(k, n - k) / n;
        lambda[k] = std::pow(2. / h * std::sin(half_phase), 2);
      }
    return lambda;
  }

  AlignedVector
  RowTransforms::value_weights(AlignedVector modes_of_one) const
  {
    // The transforms are transposed, but for the constant (or alternating) mode
    // with twice the norm.
    EphyraAssert(ends != RowEnds::periodic, "Fourier modes have other weights");
    if (in_pairs())
      modes_of_one[0] *= 0.5;
    return modes_of_one;
  }

  void
  RowTransforms::forward(double *const a, double *const b)
  {
    if (in_pairs())
      {
        if (b == nullptr)
          std::fill(spare_row.begin(), spare_row.end(), 0.);
        pair_forward(a, b == nullptr ? spare_row.data() : b);
        return;
      }
    for (double *const row : {a, b})
      if (row != nullptr)
        {
          std::copy_n(row, n, buffer.data());
          fftw_execute(plans->forward);
          std::copy_n(buffer.data(), n, row);
        }
  }

  void
  RowTransforms::backward(const double *const a,
                          const double *const b,
                          double *const       x,
                          double *const       y)
  {
    if (in_pairs())
      {
        if (b == nullptr)
          std::fill(spare_row.begin(), spare_row.end(), 0.);
        pair_backward(a,
                      b == nullptr ? spare_row.data() : b,
                      x,
                      b == nullptr ? spare_row.data() : y);
        return;
      }
    const auto transform = [&](const double *const modes,
                               double *const       values) {
      std::copy_n(modes, n, buffer.data());
      fftw_execute(plans->backward);
      std::copy_n(buffer.data(), n, values);
    };
    transform(a, x);
    if (b != nullptr)
      transform(b, y);
  }

  void
  RowTransforms::pair_forward(double *const __restrict a,
                              double *const __restrict b)
  {
    // Values with even index ascending, then those with odd index descending;
    // row a is the real part, row b the imaginary one.
    const int    half = n / 2, last = n - 1;
    const double sign           = odd_sign();
    double *const __restrict re = complex->real_values();
    double *const __restrict im = complex->imaginary_values();
    for (int j = 0; j < half; ++j)
      {
        re[j] = a[2 * j];
        im[j] = b[2 * j];
      }
    for (int j = 0; j < half; ++j)
      {
        re[last - j] = sign * a[2 * j + 1];
        im[last - j] = sign * b[2 * j + 1];
      }
    if (n % 2 == 1)
      {
        re[half] = a[last];
        im[half] = b[last];
      }
    complex->forward();

    // Modes k and n - k of both rows from the pair Z_k, Z_(n - k).
    const double *const z = complex->modes();
    a[0]                  = 2 * z[0];
    b[0]                  = 2 * z[1];
    for_each_pair([&](const int first, const int partner, const int count) {
      const double *const __restrict zk = z + 2 * first;
      const double *const __restrict zn = z + 2 * partner;
      double *const __restrict ak       = a + first;
      double *const __restrict bk       = b + first;
      double *const __restrict an       = a + partner;
      double *const __restrict bn       = b + partner;
      const double *const c             = cosine.data() + first;
      const double *const s             = sine.data() + first;
      for (int k = 0; k < count; ++k)
        {
          const double re_a = zk[2 * k] + zn[-2 * k];
          const double im_a = zk[2 * k + 1] - zn[-2 * k + 1];
          const double re_b = zk[2 * k + 1] + zn[-2 * k + 1];
          const double im_b = zn[-2 * k] - zk[2 * k];
          ak[k]             = c[k] * re_a + s[k] * im_a;
          an[-k]            = s[k] * re_a - c[k] * im_a;
          bk[k]             = c[k] * re_b + s[k] * im_b;
          bn[-k]            = s[k] * re_b - c[k] * im_b;
        }
    });
    if (n % 2 == 0)
      {
        const int m = middle_position();
        a[m]        = 2 * cosine[m] * z[2 * m];
        b[m]        = 2 * cosine[m] * z[2 * m + 1];
      }
  }

  void
  RowTransforms::pair_backward(const double *const __restrict a,
                               const double *const __restrict b,
                               double *const __restrict x,
                               double *const __restrict y)
  {
    double *const z = complex->modes();
    z[0]            = a[0];
    z[1]            = b[0];
    for_each_pair([&](const int first, const int partner, const int count) {
      double *const __restrict zk       = z + 2 * first;
      double *const __restrict zn       = z + 2 * partner;
      const double *const __restrict ak = a + first;
      const double *const __restrict bk = b + first;
      const double *const __restrict an = a + partner;
      const double *const __restrict bn = b + partner;
      const double *const c             = cosine.data() + first;
      const double *const s             = sine.data() + first;
      for (int k = 0; k < count; ++k)
        {
          const double re_a = c[k] * ak[k] + s[k] * an[-k];
          const double im_a = s[k] * ak[k] - c[k] * an[-k];
          const double re_b = c[k] * bk[k] + s[k] * bn[-k];
          const double im_b = s[k] * bk[k] - c[k] * bn[-k];
          zk[2 * k]         = re_a - im_b;
          zk[2 * k + 1]     = im_a + re_b;
          zn[-2 * k]        = re_a + im_b;
          zn[-2 * k + 1]    = re_b - im_a;
        }
    });
    if (n % 2 == 0)
      {
        const int m  = middle_position();
        z[2 * m]     = 2 * cosine[m] * a[m];
        z[2 * m + 1] = 2 * cosine[m] * b[m];
      }
    complex->backward();

    const int    half = n / 2, last = n - 1;
    const double sign                 = odd_sign();
    const double *const __restrict re = complex->real_values();
    const double *const __restrict im = complex->imaginary_values();
    for (int j = 0; j < half; ++j)
      {
        x[2 * j]     = re[j];
        y[2 * j]     = im[j];
        x[2 * j + 1] = sign * re[last - j];
        y[2 * j + 1] = sign * im[last - j];
      }
    if (n % 2 == 1)
      {
        x[last] = re[half];
        y[last] = im[half];
      }
  }

  template <typename Function>
  void
  RowTransforms::for_each_pair(const Function &function) const
  {
    // Mode k = k1 + p k2 lies at k1 q + k2: its partner n - k is the mirrored
    // one in the block p - k1, or the mirrored one about 0 in the block 0.
    const int p = complex->radix(), q = n / p;
    function(1, q - 1, (q - 1) / 2);
    for (int k1 = 1; 2 * k1 < p; ++k1)
      function(k1 * q, (p - k1) * q + q - 1, q);
    if (p % 2 == 0)
      function(p / 2 * q, p / 2 * q + q - 1, q / 2);
  }

  int
  RowTransforms::middle_position() const
  {
    const int p = complex->radix(), q = n / p;
    return q % 2 == 0 ? q / 2 : p / 2 * q + q / 2;
  }

  bool
  is_awkward_length(const int n)
  {
    int rest = n;
    for (const int factor : {2, 3, 5, 7, 11, 13})
      while (rest % factor == 0)
        rest /= factor;
    return rest > ComplexTransform::largest_radix;
  }

  int
  next_good_length(int n)
  {
    while (is_awkward_length(n))
      ++n;
    return n;
  }
} // namespace ephyra::fluid
