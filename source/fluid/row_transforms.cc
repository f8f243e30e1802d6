#include "ephyra/fluid/row_transforms.h"

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
        case RowEnds::dirichlet_dirichlet:
          return {FFTW_RODFT10, FFTW_RODFT01};
        case RowEnds::neumann_dirichlet:
          return {FFTW_REDFT11, FFTW_REDFT11};
        case RowEnds::dirichlet_neumann:
          return {FFTW_RODFT11, FFTW_RODFT11};
        case RowEnds::neumann_neumann:
          return {FFTW_REDFT10, FFTW_REDFT01};
        case RowEnds::periodic:
          break;
        }
      return {FFTW_R2HC, FFTW_HC2R};
    }

    fftw_complex *
    complex(AlignedVector &values)
    {
      return reinterpret_cast<fftw_complex *>(values.data());
    }
  } // namespace

  RowTransforms::RowTransforms(const int n, const RowEnds ends)
    : n(n)
    , ends(ends)
    , plans(std::make_unique<Plans>())
    , in(2 * n)
    , out(2 * n)
    , spare_row(n)
  {
    // Plans that FFTW measures differ from run to run, and so would the results
    // in their last digits; they are hardly faster.
    if (ends == RowEnds::neumann_neumann)
      {
        plans->forward = fftw_plan_dft_1d(
          n, complex(in), complex(out), FFTW_FORWARD, FFTW_ESTIMATE);
        plans->backward = fftw_plan_dft_1d(
          n, complex(in), complex(out), FFTW_BACKWARD, FFTW_ESTIMATE);
        for (int k = 0; k < n; ++k)
          {
            cosine.push_back(std::cos(0.5 * M_PI * k / n));
            sine.push_back(std::sin(0.5 * M_PI * k / n));
          }
        return;
      }
    const auto [forward, backward] = real_kinds(ends);
    plans->forward =
      fftw_plan_r2r_1d(n, in.data(), in.data(), forward, FFTW_ESTIMATE);
    plans->backward = fftw_plan_r2r_1d(
      n, in.data(), out.data(), backward, FFTW_ESTIMATE | FFTW_PRESERVE_INPUT);
  }

  RowTransforms::~RowTransforms() = default;

  double
  RowTransforms::scale() const
  {
    return ends == RowEnds::periodic ? n : 2 * n;
  }

  std::vector<double>
  RowTransforms::eigenvalues(const double h) const
  {
    // Mode k has the phase pi (k + shift) / n, or 2 pi k / n.
    double shift = 0.5;
    if (ends == RowEnds::neumann_neumann)
      shift = 0;
    else if (ends == RowEnds::dirichlet_dirichlet)
      shift = 1;
    std::vector<double> lambda(n);
    for (int k = 0; k < n; ++k)
      {
        const double half_phase = ends == RowEnds::periodic
                                    ? M_PI * std::min(k, n - k) / n
                                    : 0.5 * M_PI * (k + shift) / n;
        lambda[k]               = std::pow(2. / h * std::sin(half_phase), 2);
      }
    return lambda;
  }

  void
  RowTransforms::forward(double *const a, double *const b)
  {
    if (ends == RowEnds::neumann_neumann)
      {
        if (b == nullptr)
          std::fill(spare_row.begin(), spare_row.end(), 0.);
        cosines_forward(a, b == nullptr ? spare_row.data() : b);
        return;
      }
    fftw_execute_r2r(plans->forward, a, a);
    if (b != nullptr)
      fftw_execute_r2r(plans->forward, b, b);
  }

  void
  RowTransforms::backward(const double *const a,
                          const double *const b,
                          double *const       x,
                          double *const       y)
  {
    if (ends == RowEnds::neumann_neumann)
      {
        if (b == nullptr)
          std::fill(spare_row.begin(), spare_row.end(), 0.);
        cosines_backward(a,
                         b == nullptr ? spare_row.data() : b,
                         x,
                         b == nullptr ? spare_row.data() : y);
        return;
      }
    // FFTW takes no const input but keeps it (FFTW_PRESERVE_INPUT).
    fftw_execute_r2r(plans->backward, const_cast<double *>(a), x);
    if (b != nullptr)
      fftw_execute_r2r(plans->backward, const_cast<double *>(b), y);
  }

  void
  RowTransforms::cosines_forward(double *const __restrict a,
                                 double *const __restrict b)
  {
    // Values with even index ascending, then those with odd index descending;
    // row a is the real part, row b the imaginary one.
    const int half                = n / 2;
    double *const __restrict even = in.data();
    for (int j = 0; j < half; ++j)
      {
        even[2 * j]     = a[2 * j];
        even[2 * j + 1] = b[2 * j];
      }
    double *const __restrict odd = in.data() + 2 * (n - 1);
    for (int j = 0; j < half; ++j)
      {
        odd[-2 * j]     = a[2 * j + 1];
        odd[-2 * j + 1] = b[2 * j + 1];
      }
    if (n % 2 == 1)
      {
        even[n - 1] = a[n - 1];
        even[n]     = b[n - 1];
      }
    fftw_execute(plans->forward);

    // Modes k and n - k of both rows from the pair Z_k, Z_(n - k).
    const double *const __restrict z  = out.data();
    const double *const __restrict zn = out.data() + 2 * n;
    double *const __restrict an       = a + n;
    double *const __restrict bn       = b + n;
    const double *const c = cosine.data(), *const s = sine.data();
    a[0] = 2 * z[0];
    b[0] = 2 * z[1];
    for (int k = 1; k <= (n - 1) / 2; ++k)
      {
        const double re_a = z[2 * k] + zn[-2 * k];
        const double im_a = z[2 * k + 1] - zn[-2 * k + 1];
        const double re_b = z[2 * k + 1] + zn[-2 * k + 1];
        const double im_b = zn[-2 * k] - z[2 * k];
        a[k]              = c[k] * re_a + s[k] * im_a;
        an[-k]            = s[k] * re_a - c[k] * im_a;
        b[k]              = c[k] * re_b + s[k] * im_b;
        bn[-k]            = s[k] * re_b - c[k] * im_b;
      }
    if (n % 2 == 0)
      {
        a[half] = 2 * c[half] * z[n];
        b[half] = 2 * c[half] * z[n + 1];
      }
  }

  void
  RowTransforms::cosines_backward(const double *const __restrict a,
                                  const double *const __restrict b,
                                  double *const __restrict x,
                                  double *const __restrict y)
  {
    const int half                    = n / 2;
    double *const __restrict z        = in.data();
    double *const __restrict zn       = in.data() + 2 * n;
    const double *const __restrict an = a + n;
    const double *const __restrict bn = b + n;
    const double *const c = cosine.data(), *const s = sine.data();
    z[0] = a[0];
    z[1] = b[0];
    for (int k = 1; k <= (n - 1) / 2; ++k)
      {
        const double re_a = c[k] * a[k] + s[k] * an[-k];
        const double im_a = s[k] * a[k] - c[k] * an[-k];
        const double re_b = c[k] * b[k] + s[k] * bn[-k];
        const double im_b = s[k] * b[k] - c[k] * bn[-k];
        z[2 * k]          = re_a - im_b;
        z[2 * k + 1]      = im_a + re_b;
        zn[-2 * k]        = re_a + im_b;
        zn[-2 * k + 1]    = re_b - im_a;
      }
    if (n % 2 == 0)
      {
        z[n]     = 2 * c[half] * a[half];
        z[n + 1] = 2 * c[half] * b[half];
      }
    fftw_execute(plans->backward);

    const double *const __restrict even = out.data();
    const double *const __restrict odd  = out.data() + 2 * (n - 1);
    for (int j = 0; j < half; ++j)
      {
        x[2 * j]     = even[2 * j];
        y[2 * j]     = even[2 * j + 1];
        x[2 * j + 1] = odd[-2 * j];
        y[2 * j + 1] = odd[-2 * j + 1];
      }
    if (n % 2 == 1)
      {
        x[n - 1] = even[n - 1];
        y[n - 1] = even[n];
      }
  }

  bool
  is_awkward_length(const int n)
  {
    int rest = n;
    for (const int factor : {2, 3, 5, 7})
      while (rest % factor == 0)
        rest /= factor;
    return rest > 1;
  }

  int
  next_good_length(int n)
  {
    while (is_awkward_length(n))
      ++n;
    return n;
  }
} // namespace ephyra::fluid
