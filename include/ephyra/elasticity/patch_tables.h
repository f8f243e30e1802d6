#pragma once

#include "ephyra/elasticity/active_strain.h"
#include "ephyra/splines/nurbs_patch.h"

#include <vector>

namespace ephyra::elasticity
{
  /// Everything about the reference configuration that element loops read,
  /// computed once. The tensor structure is kept: one-dimensional bases of
  /// each direction plus a few numbers per Gauss point instead of the bivariate
  /// basis.
  ///
  /// With the polynomial bases N_a = N_a1(theta^1) N_a2(theta^2) and
  /// W = sum w_a N_a, the derivatives of R_a = w_a N_a / W along the three
  /// directions of the cylindrical frame are
  ///   (R_,r, R_,y, R/r) = w_a T (N_a, N_a,1, N_a,2)
  /// with a 3 x 3 matrix T per Gauss point of which two entries vanish.
  ///
  /// Gauss point q of an element is q1 * nq2 + q2, element e is e1 * ne2 + e2,
  /// local function a is a1 * n2 + a2.
  struct PatchTables
  {
    /// @p points Gauss points per direction and element. Throws InputError
    /// where the map is inverted, degenerate or crosses the axis.
    PatchTables(const splines::NurbsPatch<2> &patch,
                const std::array<int, 2>     &points);

    int
    n_elements() const
    {
      return ne1 * ne2;
    }
    int
    n_local() const
    {
      return n1 * n2;
    }
    int
    n_q() const
    {
      return nq1 * nq2;
    }
    /// Entries of T per Gauss point: r0 r1 r2 y0 y1 y2 h0.
    static constexpr int n_transform = 7;

    int ne1, ne2; ///< elements
    int n1, n2;   ///< functions of an element per direction
    int nq1, nq2; ///< Gauss points of an element per direction
    /// +1 where theta^1, theta^2 are right-handed in (r, y), else -1.
    double orientation;

    /// N_a1 and N_a1,1: [e1][q1][0 or 1][a1].
    std::vector<double> basis1;
    /// N_a2 and N_a2,2: [e2][0 or 1][q2][a2], and with q2 fastest.
    std::vector<double> basis2, basis2_transposed;
    /// Products of test and trial functions in the second direction,
    /// [e2][N N, N N', N' N, N' N'][q2][a2 * n2 + b2].
    std::vector<double> products2;

    std::vector<int>            points;    ///< control points, [e][a]
    std::vector<double>         weights;   ///< w_a, [e][a]
    std::vector<double>         transform; ///< T, [e][n_transform][q]
    std::vector<double>         volume;    ///< 2 pi r |det| weight, m^3, [e][q]
    std::vector<ReferenceFrame> frames;    ///< [e][q]
    std::vector<splines::Point> positions; ///< m, [e][q]
    /// Parameters of the Gauss points of each direction, [e1][q1], [e2][q2].
    std::vector<double> theta1, theta2;
  };
} // namespace ephyra::elasticity
