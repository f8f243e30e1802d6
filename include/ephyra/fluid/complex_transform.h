#pragma once

#include "ephyra/fluid/aligned_vector.h"

#include <memory>

namespace ephyra::fluid
{
  /// Discrete Fourier transform of length n = p q,
  ///   Z_k = sum_j z_j exp(-2 pi i j k / n),
  /// by one step of radix p, vectorised over q columns, and p transforms of
  /// length q by FFTW (Cooley & Tukey 1965, 10.1090/S0025-5718-1965-0178586-1).
  /// The step takes any p, so prime factors for which FFTW has no fast code
  /// cost little, and the short transforms have good plans without measuring:
  /// results do not differ from run to run. Mode k = k1 + p k2 lies at
  /// k1 q + k2 on the modes' side.
  class ComplexTransform
  {
  public:
    static constexpr int largest_radix = 64;

    explicit ComplexTransform(int n);
    /// With a given divisor of n, at most largest_radix, as radix.
    ComplexTransform(int n, int radix);
    ~ComplexTransform();

    /// p of the first step.
    int
    radix() const
    {
      return p;
    }
    /// Mode at the given position.
    int
    mode(const int position) const
    {
      return position / q + p * (position % q);
    }

    /// Values, n each of real and imaginary part; they are kept.
    double *
    real_values()
    {
      return real.data();
    }
    double *
    imaginary_values()
    {
      return imaginary.data();
    }
    /// 2 n values, real and imaginary parts interleaved.
    double *
    modes()
    {
      return transformed.data();
    }

    /// Values to modes.
    void
    forward();
    /// Modes to n times the values.
    void
    backward();

  private:
    static constexpr int width = 8; ///< columns of a block
    struct Plans;
    struct Block;

    void
    forward_block(int column);
    void
    backward_block(int column);

    const int              n, p, q;
    AlignedVector          real, imaginary;
    AlignedVector          interleaved; ///< between the two parts
    AlignedVector          transformed; ///< modes
    AlignedVector          twiddle_real, twiddle_imaginary;
    AlignedVector          cosine, sine; ///< of 2 pi j k / p
    std::unique_ptr<Plans> plans;
  };
} // namespace ephyra::fluid
