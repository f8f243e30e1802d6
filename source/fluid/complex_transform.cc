#include "ephyra/fluid/complex_transform.h"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace ephyra::fluid
{
  namespace
  {
    /// Values of eight columns in two vector registers.
    struct Vector
    {
      static constexpr int size = 8;
      using Half                = double __attribute__((vector_size(32)));
      Half a, b;

      Vector() = default;
      explicit Vector(const double x)
        : a{x, x, x, x}
        , b{x, x, x, x}
      {
      }
      explicit Vector(const double *const from)
      {
        std::memcpy(&a, from, sizeof a);
        std::memcpy(&b, from + 4, sizeof b);
      }
      Vector(const Half &a, const Half &b)
        : a(a)
        , b(b)
      {
      }
      Vector
      operator+(const Vector &o) const
      {
        return {a + o.a, b + o.b};
      }
      Vector
      operator-(const Vector &o) const
      {
        return {a - o.a, b - o.b};
      }
      Vector
      operator*(const Vector &o) const
      {
        return {a * o.a, b * o.b};
      }
      /// Real and imaginary parts of complex numbers that lie side by side.
      static void
      deinterleave(const double *const from, Vector &re, Vector &im)
      {
        Half x[4];
        std::memcpy(x, from, sizeof x);
        using Mask = std::int64_t __attribute__((vector_size(32)));
        const Mask even{0, 2, 4, 6}, odd{1, 3, 5, 7};
        re = {__builtin_shuffle(x[0], x[1], even),
              __builtin_shuffle(x[2], x[3], even)};
        im = {__builtin_shuffle(x[0], x[1], odd),
              __builtin_shuffle(x[2], x[3], odd)};
      }
      void
      operator+=(const Vector &o)
      {
        a += o.a;
        b += o.b;
      }
      void
      store(double *const to) const
      {
        std::memcpy(to, &a, sizeof a);
        std::memcpy(to + 4, &b, sizeof b);
      }
      /// Stores the elements of this and of o in turns.
      void
      interleave(const Vector &o, double *const to) const
      {
        const auto put = [](const Half &x, const Half &y, double *const at) {
          using Mask      = std::int64_t __attribute__((vector_size(32)));
          const Half low  = __builtin_shuffle(x, y, Mask{0, 4, 1, 5});
          const Half high = __builtin_shuffle(x, y, Mask{2, 6, 3, 7});
          std::memcpy(at, &low, sizeof low);
          std::memcpy(at + 4, &high, sizeof high);
        };
        put(a, o.a, to);
        put(b, o.b, to + 8);
      }
    };


    /// Cost in ns of FFTW's unmeasured plans of length q, for each value, and
    /// of the step of radix p: rough figures that rank the choices.
    double
    transform_cost(const int q)
    {
      int        rest   = q;
      const auto remove = [&](const int factor) {
        bool found = false;
        for (; rest % factor == 0; rest /= factor)
          found = true;
        return found;
      };
      remove(2);
      remove(5);
      const bool threes = remove(3), sevens = remove(7);
      const bool large = remove(11) || remove(13);
      const bool direct =
        q <= 16 || q == 20 || q == 25 || q == 32 || q == 64 || q == 128;
      double cost = 1;
      if (rest > 1)
        cost = 5;
      else if (direct)
        cost = 0.3 + 0.003 * q;
      else if (large)
        cost = 2.5;
      else if (threes || sevens)
        cost = 1.8;
      return cost + 0.4 * std::log2(std::max(1., q / 512.));
    }
    double
    step_cost(const int p)
    {
      return 0.45 + 0.028 * p;
    }

    int
    choose_radix(const int n)
    {
      int best = 1;
      for (int p = 2;
           p <= std::min(ComplexTransform::largest_radix, n / Vector::size);
           ++p)
        if (n % p == 0 && step_cost(p) + transform_cost(n / p) <
                            step_cost(best) + transform_cost(n / best))
          best = p;
      return best;
    }
  } // namespace

  struct ComplexTransform::Plans
  {
    ~Plans()
    {
      fftw_destroy_plan(forward);
      fftw_destroy_plan(backward);
    }
    fftw_plan forward = nullptr, backward = nullptr;
  };

  /// Inputs of the radix step in one block of columns: z_0, the middle one
  /// where p is even, sums and differences of z_j and z_(p-j).
  struct ComplexTransform::Block
  {
    static constexpr int half = largest_radix / 2;

    Vector first_r, first_i, middle_r, middle_i;
    Vector sum_r[half], sum_i[half], difference_r[half], difference_i[half];

    /// @p value(j, re, im) gives z_j.
    template <typename Value>
    void
    load(int p, const Value &value);
    /// @p store(k, re, im) receives the modes.
    template <typename Store>
    void
    combine(int           p,
            const double *cosine,
            const double *sine,
            const Store  &store) const;
  };

  template <typename Value>
  inline void
  ComplexTransform::Block::load(const int p, const Value &value)
  {
    value(0, first_r, first_i);
    middle_r = middle_i = Vector(0.);
    if (p % 2 == 0)
      value(p / 2, middle_r, middle_i);
    for (int j = 1; 2 * j < p; ++j)
      {
        Vector a_r, a_i, b_r, b_i;
        value(j, a_r, a_i);
        value(p - j, b_r, b_i);
        sum_r[j - 1]        = a_r + b_r;
        sum_i[j - 1]        = a_i + b_i;
        difference_r[j - 1] = a_r - b_r;
        difference_i[j - 1] = a_i - b_i;
      }
  }

  template <typename Store>
  inline void
  ComplexTransform::Block::combine(const int           p,
                                   const double *const cosine,
                                   const double *const sine,
                                   const Store        &store) const
  {
    const int half    = (p - 1) / 2;
    Vector    total_r = first_r + middle_r, total_i = first_i + middle_i;
    for (int j = 0; j < half; ++j)
      {
        total_r += sum_r[j];
        total_i += sum_i[j];
      }
    store(0, total_r, total_i);
    for (int k = 1; k <= p / 2; ++k)
      {
        const Vector sign(k % 2 == 0 ? 1. : -1.);
        Vector e_r = first_r + sign * middle_r, e_i = first_i + sign * middle_i;
        Vector o_r(0.), o_i(0.);
        for (int j = 0; j < half; ++j)
          {
            const Vector c(cosine[k * p + j + 1]), s(sine[k * p + j + 1]);
            e_r += c * sum_r[j];
            e_i += c * sum_i[j];
            o_r += s * difference_r[j];
            o_i += s * difference_i[j];
          }
        store(k, e_r + o_i, e_i - o_r);
        if (2 * k < p)
          store(p - k, e_r - o_i, e_i + o_r);
      }
  }

  ComplexTransform::ComplexTransform(const int n)
    : ComplexTransform(n, choose_radix(n))
  {
  }

  ComplexTransform::ComplexTransform(const int n, const int radix)
    : n(n)
    , p(radix)
    , q(n / radix)
    , real(std::max(n, width))
    , imaginary(std::max(n, width))
    , interleaved(2 * std::max(n, width))
    , transformed(2 * n)
    , twiddle_real(std::max(n, width))
    , twiddle_imaginary(std::max(n, width))
    , cosine(p * p)
    , sine(p * p)
    , plans(std::make_unique<Plans>())
  {
    for (int k = 0; k < p; ++k)
      {
        for (int j = 0; j < p; ++j)
          {
            const double phase = 2 * M_PI * (k * j % p) / p;
            cosine[k * p + j]  = std::cos(phase);
            sine[k * p + j]    = std::sin(phase);
          }
        for (int j = 0; j < q; ++j)
          {
            const double phase           = 2 * M_PI * k * j / n;
            twiddle_real[k * q + j]      = std::cos(phase);
            twiddle_imaginary[k * q + j] = std::sin(phase);
          }
      }
    // In place, FFTW would copy.
    auto *const before = reinterpret_cast<fftw_complex *>(interleaved.data());
    auto *const after  = reinterpret_cast<fftw_complex *>(transformed.data());
    const auto  plan   = [&](fftw_complex *const from,
                          fftw_complex *const to,
                          const int           sign) {
      return fftw_plan_many_dft(
        1, &q, p, from, nullptr, 1, q, to, nullptr, 1, q, sign, FFTW_ESTIMATE);
    };
    plans->forward  = plan(before, after, FFTW_FORWARD);
    plans->backward = plan(after, before, FFTW_BACKWARD);
  }

  ComplexTransform::~ComplexTransform() = default;

  void
  ComplexTransform::forward()
  {
    // The last block may overlap the one before; columns are independent.
    for (int column = 0; column < q; column += width)
      forward_block(std::max(0, std::min(column, q - width)));
    fftw_execute(plans->forward);
  }

  void
  ComplexTransform::backward()
  {
    fftw_execute(plans->backward);
    for (int column = 0; column < q; column += width)
      backward_block(std::max(0, std::min(column, q - width)));
  }

  void
  ComplexTransform::forward_block(const int column)
  {
    const auto at = [&](const int k) {
      return static_cast<std::size_t>(k) * q + column;
    };
    Block x;
    x.load(p, [&](const int j, Vector &re, Vector &im) {
      re = Vector(&real[at(j)]);
      im = Vector(&imaginary[at(j)]);
    });
    x.combine(p,
              cosine.data(),
              sine.data(),
              [&](const int k, const Vector &re, const Vector &im) {
                const Vector t_r(&twiddle_real[at(k)]);
                const Vector t_i(&twiddle_imaginary[at(k)]);
                (re * t_r + im * t_i)
                  .interleave(im * t_r - re * t_i, &interleaved[2 * at(k)]);
              });
  }

  void
  ComplexTransform::backward_block(const int column)
  {
    const auto at = [&](const int k) {
      return static_cast<std::size_t>(k) * q + column;
    };
    Block x;
    x.load(p, [&](const int k, Vector &re, Vector &im) {
      const Vector t_r(&twiddle_real[at(k)]);
      const Vector t_i(&twiddle_imaginary[at(k)]);
      Vector       z_r, z_i;
      Vector::deinterleave(&interleaved[2 * at(k)], z_r, z_i);
      re = z_r * t_r - z_i * t_i;
      im = z_i * t_r + z_r * t_i;
    });
    // The other sign of the phase swaps the values j and p - j.
    x.combine(p,
              cosine.data(),
              sine.data(),
              [&](const int k, const Vector &re, const Vector &im) {
                const int j = k == 0 ? 0 : p - k;
                re.store(&real[at(j)]);
                im.store(&imaginary[at(j)]);
              });
  }
} // namespace ephyra::fluid
