#include "ephyra/base/expression.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/text.h"

#include <muParser.h>

#include <cmath>

namespace ephyra
{
  namespace
  {
    double
    unit_step(const double x)
    {
      return x < 0 ? 0. : 1.;
    }

    double
    error_function(const double x)
    {
      return std::erf(x);
    }

    double
    bessel_j0(const double x)
    {
      return std::cyl_bessel_j(0., std::abs(x));
    }

    double
    bessel_j1(const double x)
    {
      return std::copysign(1., x) * std::cyl_bessel_j(1., std::abs(x));
    }

    double
    bessel_i0(const double x)
    {
      return std::cyl_bessel_i(0., std::abs(x));
    }

    double
    bessel_i1(const double x)
    {
      return std::copysign(1., x) * std::cyl_bessel_i(1., std::abs(x));
    }
  } // namespace

  struct Expression::Implementation
  {
    Implementation(const std::string              &formula,
                   const std::vector<std::string> &variables)
      : formula(text::normalize(formula))
      , variables(variables)
      , values(variables.size(), 0.)
    {
      check_characters();
      try
        {
          parser.DefineConst("pi", std::acos(-1.));
          parser.DefineFun("step", unit_step);
          parser.DefineFun("erf", error_function);
          parser.DefineFun("bessel_j0", bessel_j0);
          parser.DefineFun("bessel_j1", bessel_j1);
          parser.DefineFun("bessel_i0", bessel_i0);
          parser.DefineFun("bessel_i1", bessel_i1);
          for (std::size_t i = 0; i < variables.size(); ++i)
            parser.DefineVar(variables[i], &values[i]);
          parser.SetExpr(this->formula);
          int n_results = 0;
          parser.Eval(n_results); // parses; the values do not matter yet
          EphyraThrowIf(n_results != 1,
                        InputError,
                        "the formula " << text::quote(this->formula)
                                       << " has more than one value");
        }
      catch (const mu::Parser::exception_type &error)
        {
          fail(error);
        }
    }

    /// muParser would take "t = 1" as an assignment.
    void
    check_characters() const
    {
      EphyraThrowIf(formula.empty(), InputError, "the formula is empty");
      for (std::size_t i = 0; i < formula.size(); ++i)
        {
          const char before = i > 0 ? formula[i - 1] : ' ';
          const bool comparison =
            before == '=' || before == '<' || before == '>' || before == '!' ||
            (i + 1 < formula.size() && formula[i + 1] == '=');
          EphyraThrowIf(formula[i] == '=' && !comparison,
                        InputError,
                        "the formula "
                          << text::quote(formula)
                          << " holds an assignment, which is not allowed");
        }
    }

    [[noreturn]] void
    fail(const mu::Parser::exception_type &error) const
    {
      std::string message = "the formula " + text::quote(formula) + " ";
      if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN)
        message += "has the unknown name " + text::quote(error.GetToken());
      else
        message += "is not understood: " + error.GetMsg();
      if (error.GetPos() >= 0)
        message += " (position " + std::to_string(error.GetPos() + 1) + ")";
      if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN)
        message += variables.empty()
                     ? ", it has no variables"
                     : ", its variables are " + text::quoted_list(variables);
      throw InputError(message);
    }

    double
    evaluate()
    {
      double result = 0;
      try
        {
          result = parser.Eval();
        }
      catch (const mu::Parser::exception_type &error)
        {
          fail(error);
        }
      if (std::isfinite(result))
        return result;
      std::string at;
      for (std::size_t i = 0; i < variables.size(); ++i)
        at += (i == 0 ? " at " : ", ") + variables[i] + " = " +
              text::number(values[i]);
      throw InputError("The formula " + text::quote(formula) + " gives " +
                       text::number(result) + at +
                       "; change it so that it is finite there.");
    }

    const std::string              formula;
    const std::vector<std::string> variables;
    std::vector<double>            values; ///< the parser points to these
    mu::Parser                     parser;
  };

  Expression::Expression(const std::string              &formula,
                         const std::vector<std::string> &variables)
    : impl(std::make_unique<Implementation>(formula, variables))
  {
  }

  Expression::Expression(const Expression &other)
    : Expression(other.impl->formula, other.impl->variables)
  {
  }

  Expression::Expression(Expression &&) noexcept = default;

  Expression &
  Expression::operator=(const Expression &other)
  {
    return *this = Expression(other);
  }

  Expression &
  Expression::operator=(Expression &&) noexcept = default;

  Expression::~Expression() = default;

  double
  Expression::operator()(const std::vector<double> &values) const
  {
    EphyraAssert(values.size() == impl->values.size(),
                 "a formula needs one value for each variable");
    std::copy(values.begin(), values.end(), impl->values.begin());
    return impl->evaluate();
  }

  double
  Expression::operator()(const double x) const
  {
    EphyraAssert(impl->values.size() == 1,
                 "this formula has more than one variable");
    impl->values[0] = x;
    return impl->evaluate();
  }

  const std::string &
  Expression::formula() const
  {
    return impl->formula;
  }

  bool
  Expression::is_zero() const
  {
    return impl->parser.GetUsedVar().empty() && impl->parser.Eval() == 0.;
  }
} // namespace ephyra
