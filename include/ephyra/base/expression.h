#pragma once

#include <memory>
#include <string>
#include <vector>

namespace ephyra
{
  /// A formula of a parameter file (muParser), e.g. "0.5*(1 - cos(pi*t))" in
  /// the variables ("t"). Besides muParser's functions, `pi`, `step(x)` (0 for
  /// x < 0, else 1) and the Bessel functions `bessel_j0(x)`, `bessel_j1(x)` and,
  /// modified, `bessel_i0(x)`, `bessel_i1(x)` are known. Values are SI.
  class Expression
  {
  public:
    /// Throws InputError with the parser's message and position.
    Expression(const std::string              &formula,
               const std::vector<std::string> &variables);
    Expression(const Expression &);
    Expression(Expression &&) noexcept;
    Expression &
    operator=(const Expression &);
    Expression &
    operator=(Expression &&) noexcept;
    ~Expression();

    /// Values in the order of the variables; throws InputError where the
    /// result is not finite.
    double
    operator()(const std::vector<double> &values) const;
    double
    operator()(double x) const; ///< of one variable

    const std::string &
    formula() const;
    /// Whether the formula is a plain constant zero ("0"): lets solvers drop a
    /// term altogether.
    bool
    is_zero() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> impl;
  };
} // namespace ephyra
