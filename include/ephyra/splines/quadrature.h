#pragma once

#include <vector>

namespace ephyra::splines
{
  /// Points and weights of a quadrature rule on [0, 1]; the weights sum to 1.
  struct Quadrature
  {
    std::vector<double> points; ///< increasing
    std::vector<double> weights;

    int
    size() const
    {
      return static_cast<int>(points.size());
    }
  };

  /// Gauss-Legendre rule with n points, exact for polynomials of degree
  /// 2 n - 1. Throws InputError for n < 1.
  Quadrature
  gauss_legendre(int n);
} // namespace ephyra::splines
