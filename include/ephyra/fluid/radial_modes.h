#pragma once

#include "ephyra/fluid/aligned_vector.h"
#include "ephyra/fluid/staggered_grid.h"

#include <vector>

namespace ephyra::fluid
{
  /// Eigenvectors of the radial part of the Poisson equation: phi_i is the sum
  /// of vector(i, k) x_k / root_weight_i over the modes k; all rows of the grid
  /// on every rank. LAPACK's pairs are exact relative to the largest eigenvalue
  /// and component only. Each pair is improved in extended precision to
  /// round-off of its own: the eigenvalue by its Rayleigh quotient, a sum of
  /// squares, the eigenvector by recurrences from both ends to its largest
  /// component (Dhillon & Parlett 2004, 10.1016/j.laa.2003.12.028). That halves
  /// the residuals of solvers that use them, and leaves none at the seam
  /// between two solvers.
  class RadialModes
  {
  public:
    /// Throws DivergedError where LAPACK fails.
    RadialModes(const StaggeredGrid &grid, bool outer_dirichlet);

    const int           n;
    AlignedVector       root_weight; ///< sqrt(rc_i dr_i)
    AlignedVector       vectors;     ///< n x n, column k: mode k
    std::vector<double> eigenvalues; ///< of the negative operator, 1/m^2; the
                                     ///< constant's is exactly 0

  private:
    void
    decompose(const std::vector<double> &conductance);
    void
    improve(int k, const std::vector<double> &conductance);
  };

  /// C = op(A) op(B), column-major, op(A) m x k and op(B) k x n; 'T'
  /// transposes.
  void
  multiply(char          transpose_a,
           char          transpose_b,
           int           m,
           int           n,
           int           k,
           const double *a,
           int           stride_a,
           const double *b,
           int           stride_b,
           double       *c,
           int           stride_c);
} // namespace ephyra::fluid
