#include "ephyra/base/time_function.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/quantity.h"
#include "ephyra/base/table.h"
#include "ephyra/base/text.h"

#include <algorithm>
#include <cmath>

namespace ephyra
{
  TimeFunction::TimeFunction()
    : TimeFunction("0")
  {
  }

  TimeFunction::TimeFunction(const std::string &text, const std::string &unit)
  {
    if (const auto name = table_name(text))
      read_table(*name, unit);
    else
      expression =
        Expression(patterns::Expression({"t"}, unit).resolve(text, ""), {"t"});
  }

  std::optional<TimeFunction::TableName>
  TimeFunction::table_name(const std::string &text)
  {
    const std::string clean = text::normalize(text);
    if (clean != "table" && clean.compare(0, 6, "table ") != 0)
      return {};
    TableName         name;
    const std::string option = " periodic";
    name.file     = clean.substr(std::min<std::size_t>(6, clean.size()));
    name.periodic = name.file.size() > option.size() &&
                    name.file.compare(name.file.size() - option.size(),
                                      option.size(),
                                      option) == 0;
    if (name.periodic)
      name.file.erase(name.file.size() - option.size());
    return name;
  }

  void
  TimeFunction::read_table(const TableName &name, const std::string &unit)
  {
    EphyraThrowIf(
      name.file.empty(), InputError, "a file name must follow \"table\"");
    const Table       table = Table::read(name.file);
    const std::string where = "The table " + text::quote(name.file);
    EphyraThrowIf(table.n_columns() != 2 || table.n_rows() < 2,
                  InputError,
                  where << " must have two columns (time, value) and at least "
                           "two rows, it has "
                        << table.n_columns() << " and " << table.n_rows()
                        << ".");
    const std::string needed[2] = {"s", unit};
    for (std::size_t i = 0; i < 2; ++i)
      {
        std::vector<double> &target = i == 0 ? times : values;
        target                      = table.column(i);
        for (const double x : target)
          EphyraThrowIf(!std::isfinite(x),
                        InputError,
                        where << " holds " << x << ", which is not finite.");
        const std::string given =
          table.names().empty() ? "" : Table::unit(table.names()[i]);
        if (given.empty())
          continue;
        const Unit conversion = parse_unit(given);
        EphyraThrowIf(conversion.dimension != parse_unit(needed[i]).dimension,
                      InputError,
                      where << " has " << conversion.dimension.description()
                            << " in column " << i + 1 << ", but "
                            << parse_unit(needed[i]).dimension.description()
                            << " is needed.");
        for (double &x : target)
          x = conversion.to_si(x);
      }
    for (std::size_t i = 1; i < times.size(); ++i)
      EphyraThrowIf(times[i] <= times[i - 1],
                    InputError,
                    where << " has the time " << times[i] << " s after "
                          << times[i - 1] << " s; times must grow.");
    periodic = name.periodic;
    const auto [smallest, largest] =
      std::minmax_element(values.begin(), values.end());
    EphyraThrowIf(periodic && std::abs(values.back() - values.front()) >
                                1e-6 * (*largest - *smallest),
                  InputError,
                  where << " is periodic, but begins with " << values.front()
                        << " and ends with " << values.back()
                        << "; the two must be equal.");
  }

  double
  TimeFunction::operator()(const double time) const
  {
    if (expression)
      return (*expression)(time);
    double t = time;
    if (periodic)
      {
        const double period = times.back() - times.front();
        const double cycles = std::floor((t - times.front()) / period);
        t -= cycles * period;
      }
    const auto next = std::upper_bound(times.begin(), times.end(), t);
    if (next == times.begin())
      return values.front();
    if (next == times.end())
      return values.back();
    const std::size_t i = next - times.begin();
    const double      s = (t - times[i - 1]) / (times[i] - times[i - 1]);
    return (1 - s) * values[i - 1] + s * values[i];
  }

  bool
  TimeFunction::is_zero() const
  {
    return expression ? expression->is_zero()
                      : std::all_of(values.begin(),
                                    values.end(),
                                    [](const double x) { return x == 0; });
  }
} // namespace ephyra

namespace ephyra::patterns
{
  TimeFunction::TimeFunction(const std::string &unit)
    : formula({"t"}, unit)
  {
  }

  std::unique_ptr<PatternBase>
  TimeFunction::clone() const
  {
    return std::make_unique<TimeFunction>(*this);
  }

  std::string
  TimeFunction::error(const std::string &text) const
  {
    if (!ephyra::TimeFunction::table_name(text))
      return formula.error(text);
    try
      {
        ephyra::TimeFunction(text, unit());
        return "";
      }
    catch (const InputError &error)
      {
        return error.what();
      }
  }

  std::string
  TimeFunction::resolve(const std::string &text,
                        const std::string &folder) const
  {
    const auto name = ephyra::TimeFunction::table_name(text);
    if (!name)
      return formula.resolve(text, folder);
    return "table " + resolve_file(name->file, folder) +
           (name->periodic ? " periodic" : "");
  }

  std::string
  TimeFunction::description() const
  {
    return formula.description() +
           ", or \"table FILE\", or \"table FILE periodic\"";
  }

  std::string
  TimeFunction::unit() const
  {
    return formula.unit();
  }
} // namespace ephyra::patterns
