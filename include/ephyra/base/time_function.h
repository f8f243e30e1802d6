#pragma once

#include "ephyra/base/expression.h"
#include "ephyra/base/patterns.h"

#include <optional>
#include <string>
#include <vector>

namespace ephyra
{
  /// A number that depends on time, as a parameter file gives it:
  ///   0.5*(1 - cos(pi*t))     a formula in t (s), value in SI
  ///   30 mm/s                 a constant
  ///   table FILE              linear interpolation in a table
  ///   table FILE periodic     the same, repeated for ever
  /// A table is a CSV file with two columns, time and value. A header may name
  /// their units ("time [ms],pressure [kPa]"), SI otherwise. Outside of the
  /// table its first or last value holds; a periodic table ends with the value
  /// it begins with.
  class TimeFunction
  {
  public:
    /// Zero.
    TimeFunction();
    /// @p text is the value of an entry with the pattern
    /// patterns::TimeFunction. @p unit (SI) is that of the values: where a table
    /// names one of another dimension, or is wrong in another way, InputError
    /// is thrown.
    explicit TimeFunction(const std::string &text,
                          const std::string &unit = "");

    /// Throws InputError where a formula gives no finite value.
    double
    operator()(double time) const;

    /// Whether it is zero at all times: lets solvers drop a term altogether.
    bool
    is_zero() const;

    /// The words after "table".
    struct TableName
    {
      std::string file;
      bool        periodic = false;
    };
    /// Empty where @p text is no table.
    static std::optional<TableName>
    table_name(const std::string &text);

  private:
    void
    read_table(const TableName &name, const std::string &unit);

    std::optional<Expression> expression;
    bool                      periodic = false;
    std::vector<double>       times, values; ///< of a table
  };
} // namespace ephyra

namespace ephyra::patterns
{
  /// What class ephyra::TimeFunction understands. Table files are relative to
  /// the folder of the parameter file that names them.
  class TimeFunction : public PatternBase
  {
  public:
    explicit TimeFunction(const std::string &unit = "");
    std::unique_ptr<PatternBase>
    clone() const override;
    std::string
    error(const std::string &text) const override;
    std::string
    resolve(const std::string &text, const std::string &folder) const override;
    std::string
    description() const override;
    std::string
    unit() const override;

  private:
    Expression formula;
  };
} // namespace ephyra::patterns
