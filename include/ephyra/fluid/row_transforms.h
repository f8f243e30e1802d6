#pragma once

#include "ephyra/fluid/complex_transform.h"

#include <memory>
#include <vector>

namespace ephyra::fluid
{
  /// The ends of a row, half a cell outside its first and last value.
  enum class RowEnds
  {
    neumann_neumann,     ///< cosines, DCT-II
    dirichlet_dirichlet, ///< sines, DST-II
    neumann_dirichlet,   ///< DCT-IV
    dirichlet_neumann,   ///< DST-IV
    periodic             ///< Fourier, real parts first, "half complex"
  };

  /// Discrete transforms that diagonalise the second difference along a row.
  /// Cosines, the case that counts, are computed for two rows at a time from
  /// one complex Fourier transform of length n (Makhoul 1980,
  /// 10.1109/TASSP.1980.1163351); so are sines, which are the cosines of the
  /// values with alternating signs in reversed order; the others by FFTW's real
  /// transforms.
  class RowTransforms
  {
  public:
    RowTransforms(int n, RowEnds ends);
    ~RowTransforms();
    RowTransforms(const RowTransforms &) = delete;
    RowTransforms &
    operator=(const RowTransforms &) = delete;

    /// backward(forward(x)) = scale() x.
    double
    scale() const;
    /// Eigenvalues of minus the second difference with spacing h, 1/m^2, in
    /// the order of the modes.
    std::vector<double>
    eigenvalues(double h) const;

    /// Weights of the modes in the value x_j of backward(), from the modes that
    /// forward() makes of a single 1 in x_j.
    AlignedVector
    value_weights(AlignedVector modes_of_one) const;

    /// Values to modes, in place, of two rows, or of one: @p b null.
    void
    forward(double *a, double *b);
    /// Modes a, b to values x, y; b and y null for one row.
    void
    backward(const double *a, const double *b, double *x, double *y);

  private:
    bool
    in_pairs() const;
    double
    odd_sign() const
    {
      return ends == RowEnds::dirichlet_dirichlet ? -1. : 1.;
    }
    void
    pair_forward(double *a, double *b);
    void
    pair_backward(const double *a, const double *b, double *x, double *y);
    /// Calls f(first, partner, count) for runs of modes k in the positions
    /// first ... with their partners n - k in partner, partner - 1, ...
    template <typename Function>
    void
    for_each_pair(const Function &function) const;
    /// Position of mode n / 2.
    int
    middle_position() const;

    struct Plans;

    const int                         n;
    const RowEnds                     ends;
    std::unique_ptr<ComplexTransform> complex;
    std::unique_ptr<Plans>            plans;
    AlignedVector                     cosine, sine; ///< of pi k / (2 n)
    AlignedVector                     spare_row;    ///< partner of a single row
    AlignedVector                     buffer; ///< of FFTW's real transforms
  };

  /// Whether the prime factors of n above 13 have a product above the largest
  /// radix of ComplexTransform, with which transforms are slow; the next number
  /// of which that is not so.
  bool
  is_awkward_length(int n);
  int
  next_good_length(int n);
} // namespace ephyra::fluid
