#pragma once

#include "ephyra/splines/knot_vector.h"

#include <vector>

namespace ephyra::splines
{
  /// Coefficients of a spline in one direction: row i holds the @p width
  /// numbers that belong to basis function i, e.g. the homogeneous coordinates
  /// (w r, w y, w) of one line of control points.
  struct SplineRows
  {
    KnotVector          knots;
    std::vector<double> rows;
    int                 width;
  };

  /// Inserts the (unsorted) knots one by one by Boehm's algorithm (Piegl &
  /// Tiller, The NURBS Book, eq. 5.15): convex combinations only. The function
  /// stays the same. Throws InputError for knots outside (0, 1) or with a
  /// multiplicity above the degree.
  SplineRows
  insert_knots(SplineRows spline, std::vector<double> new_knots);

  /// Raises the degree by @p times and the multiplicity of every knot as
  /// well, so that the function and its continuity stay the same. The new
  /// coefficients are values of the polar form (blossom) of the pieces, the
  /// raised form being the mean of the old one over all choices of degree
  /// arguments (Ramshaw 1989, 10.1016/0167-8396(89)90032-0).
  SplineRows
  elevate_degree(const SplineRows &spline, int times);

  /// Polar form (blossom) of the polynomial piece of a spline on the span
  /// [u_span, u_{span+1}) at degree arguments. @p coefficients holds those of
  /// the degree + 1 basis functions of the span, width numbers each; the last
  /// row becomes the result, the others are overwritten.
  void
  polar_form(const KnotVector          &knots,
             int                        span,
             const std::vector<double> &arguments,
             int                        width,
             std::vector<double>       &coefficients);

  /// Knots that cut every element into n_parts of equal parametric length.
  std::vector<double>
  splitting_knots(const KnotVector &knots, int n_parts);
} // namespace ephyra::splines
