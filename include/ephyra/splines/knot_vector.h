#pragma once

#include <vector>

namespace ephyra::splines
{
  /// A clamped (open) knot vector with its degree: the B-spline basis N_{i,p}
  /// of Piegl & Tiller, The NURBS Book (2nd ed.), chapter 2, on [0, 1].
  class KnotVector
  {
  public:
    /// Highest degree; keeps the work arrays of evaluate() on the stack.
    static constexpr int max_degree = 15;

    /// Throws InputError unless the knots run from 0 to 1, do not decrease,
    /// are clamped (first and last repeated degree + 1 times), long enough,
    /// and no interior knot occurs more than degree times.
    KnotVector(int degree, std::vector<double> knots);

    /// n_elements equal spans on [0, 1], highest continuity.
    static KnotVector
    uniform(int degree, int n_elements);

    int
    degree() const
    {
      return p;
    }
    int
    n_basis() const
    {
      return static_cast<int>(all_knots.size()) - p - 1;
    }
    const std::vector<double> &
    knots() const
    {
      return all_knots;
    }

    /// Distinct knots; element e is [breaks()[e], breaks()[e + 1]].
    const std::vector<double> &
    breaks() const
    {
      return distinct;
    }
    int
    n_elements() const
    {
      return static_cast<int>(distinct.size()) - 1;
    }
    /// Index of the element that holds x (the last one for x = 1).
    int
    element_of(double x) const;
    /// First of the degree + 1 basis functions that live on element e.
    int
    first_basis(int element) const
    {
      return first_of_element[element];
    }

    /// Non-zero basis functions at x and their derivatives up to order n:
    /// values[d * (degree + 1) + a] = d^d N_{first + a} / dx^d (algorithm
    /// A2.3). Returns the index of the first function. @p values holds
    /// (n + 1)(degree + 1) numbers.
    int
    evaluate(double x, int n_derivatives, double *values) const;

    /// Greville abscissa of each basis function: mean of its interior knots.
    std::vector<double>
    greville() const;

  private:
    int                 p;
    std::vector<double> all_knots;
    std::vector<double> distinct;
    std::vector<int>    first_of_element;
  };
} // namespace ephyra::splines
