#include "ephyra/base/patterns.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/expression.h"
#include "ephyra/base/quantity.h"
#include "ephyra/base/text.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <stdexcept>

namespace ephyra::patterns
{
  namespace
  {
    /// Parameters are SI inside: a pattern in another unit is a slip.
    void
    check_si(const std::string &unit)
    {
      if (parse_unit(unit).to_si(1.) != 1.)
        throw std::logic_error("A pattern needs an SI unit, not " + unit + ".");
    }

    std::string
    in_unit(const double x, const std::string &unit)
    {
      return text::number(x) + (unit.empty() ? "" : " " + unit);
    }
  } // namespace

  std::string
  unit_error(const std::string &text, const std::string &unit)
  {
    try
      {
        const Quantity  quantity = parse_quantity(text);
        const Dimension needed   = parse_unit(unit).dimension;
        if (!quantity.has_unit || quantity.dimension == needed)
          return "";
        return text::quote(text) + " is " + quantity.dimension.description() +
               ", but " + needed.description() + " is needed";
      }
    catch (const InputError &error)
      {
        return error.what();
      }
  }

  std::string
  resolve_file(const std::string &name, const std::string &folder)
  {
    namespace fs = std::filesystem;
    if (name.empty())
      return name;
    const fs::path  beside = fs::path(folder) / name;
    std::error_code ignored;
    return fs::absolute(fs::exists(beside, ignored) ? beside : fs::path(name))
      .lexically_normal()
      .string();
  }

  // --- Double -----------------------------------------------------------

  Double::Double(const std::string &unit,
                 const double       min,
                 const double       max,
                 const Bounds       bounds)
    : unit_text(unit)
    , min(min)
    , max(max)
    , bounds(bounds)
  {
    check_si(unit);
  }

  std::unique_ptr<PatternBase>
  Double::clone() const
  {
    return std::make_unique<Double>(*this);
  }

  std::string
  Double::error(const std::string &text) const
  {
    const std::string wrong = unit_error(text, unit_text);
    if (!wrong.empty())
      return wrong;
    const double x = parse_quantity(text).value;
    const bool   in =
      bounds == Bounds::closed ? min <= x && x <= max : min < x && x < max;
    return in ? "" : text::quote(text) + " is out of range";
  }

  std::string
  Double::description() const
  {
    const std::string noun  = parse_unit(unit_text).dimension.description();
    const bool        open  = bounds == Bounds::open;
    const bool        above = std::isfinite(min), below = std::isfinite(max);
    if (above && below)
      return noun + " between " + text::number(min) + " and " +
             in_unit(max, unit_text) + (open ? ", both excluded" : "");
    if (above && min == 0 && open)
      return "a positive " + noun.substr(noun.find(' ') + 1) +
             (unit_text.empty() ? "" : " in " + unit_text);
    if (above)
      return noun + (open ? " above " : " of at least ") +
             in_unit(min, unit_text);
    if (below)
      return noun + (open ? " below " : " of at most ") +
             in_unit(max, unit_text);
    return noun + (unit_text.empty() ? "" : " in " + unit_text);
  }

  std::string
  Double::unit() const
  {
    return unit_text;
  }

  // --- Integer ----------------------------------------------------------

  Integer::Integer(const int min, const int max)
    : min(min)
    , max(max)
  {
  }

  std::unique_ptr<PatternBase>
  Integer::clone() const
  {
    return std::make_unique<Integer>(*this);
  }

  std::string
  Integer::error(const std::string &text) const
  {
    int        value          = 0;
    const auto end            = text.data() + text.size();
    const auto [rest, status] = std::from_chars(text.data(), end, value);
    if (status == std::errc::invalid_argument || rest != end)
      return text::quote(text) + " is not an integer";
    if (status != std::errc() || value < min || value > max)
      return text::quote(text) + " is out of range";
    return "";
  }

  std::string
  Integer::description() const
  {
    const bool above = min != std::numeric_limits<int>::min();
    const bool below = max != std::numeric_limits<int>::max();
    if (above && below)
      return "an integer between " + std::to_string(min) + " and " +
             std::to_string(max);
    if (above)
      return "an integer of at least " + std::to_string(min);
    if (below)
      return "an integer of at most " + std::to_string(max);
    return "an integer";
  }

  // --- Bool -------------------------------------------------------------

  std::unique_ptr<PatternBase>
  Bool::clone() const
  {
    return std::make_unique<Bool>(*this);
  }

  std::string
  Bool::error(const std::string &text) const
  {
    const bool allowed =
      text == "true" || text == "false" || text == "yes" || text == "no";
    return allowed ? "" : text::quote(text) + " is neither true nor false";
  }

  std::string
  Bool::description() const
  {
    return "true or false (or yes, no)";
  }

  // --- Selection --------------------------------------------------------

  Selection::Selection(const std::string &choices)
  {
    std::istringstream stream(choices);
    for (std::string choice; std::getline(stream, choice, '|');)
      this->choices.push_back(text::normalize(choice));
  }

  std::unique_ptr<PatternBase>
  Selection::clone() const
  {
    return std::make_unique<Selection>(*this);
  }

  std::string
  Selection::error(const std::string &text) const
  {
    for (const std::string &choice : choices)
      if (text == choice)
        return "";
    const std::string best = text::nearest(text, choices);
    return text::quote(text) + " is not among the choices" +
           (best.empty() ? "" : " (did you mean " + text::quote(best) + "?)");
  }

  std::string
  Selection::description() const
  {
    return "one of " + text::quoted_list(choices);
  }

  // --- List -------------------------------------------------------------

  List::List(const PatternBase &item,
             const unsigned int min_items,
             const unsigned int max_items)
    : item(item.clone())
    , min_items(min_items)
    , max_items(max_items)
  {
  }

  List::List(const List &other)
    : List(*other.item, other.min_items, other.max_items)
  {
  }

  std::unique_ptr<PatternBase>
  List::clone() const
  {
    return std::make_unique<List>(*this);
  }

  std::string
  List::error(const std::string &text) const
  {
    const std::vector<std::string> items = text::split_list(text);
    if (items.size() < min_items || items.size() > max_items)
      return "the list has " + std::to_string(items.size()) +
             (items.size() == 1 ? " item" : " items");
    for (std::size_t i = 0; i < items.size(); ++i)
      {
        const std::string wrong = item->error(items[i]);
        if (!wrong.empty())
          return "item " + std::to_string(i + 1) + ": " + wrong;
      }
    if (dynamic_cast<const Double *>(item.get()) == nullptr)
      return "";
    // "1, 2, 3 mm" would be 1 m, 2 m and 3 mm.
    bool some = false, all = true;
    for (const std::string &number : items)
      {
        const Quantity quantity = parse_quantity(number);
        some                    = some || quantity.has_unit;
        all = all && (quantity.has_unit || quantity.value == 0);
      }
    return some && !all ? "some items have a unit and some have none, give "
                          "each item its unit"
                        : "";
  }

  std::string
  List::description() const
  {
    std::string       count;
    const std::string least = std::to_string(min_items);
    if (max_items != std::numeric_limits<unsigned int>::max())
      count = min_items == max_items
                ? least + " "
                : least + " to " + std::to_string(max_items) + " ";
    else if (min_items > 0)
      count = "at least " + least + " ";
    return "a list of " + count + "items separated by commas, each " +
           item->description();
  }

  std::string
  List::unit() const
  {
    return item->unit();
  }

  // --- Expression -------------------------------------------------------

  Expression::Expression(const std::vector<std::string> &variables,
                         const std::string              &unit)
    : variables(variables)
    , unit_text(unit)
  {
    check_si(unit);
  }

  std::unique_ptr<PatternBase>
  Expression::clone() const
  {
    return std::make_unique<Expression>(*this);
  }

  std::string
  Expression::error(const std::string &text) const
  {
    try
      {
        // A number with a unit of another dimension.
        if (parse_quantity(text).has_unit)
          return unit_error(text, unit_text);
      }
    catch (const InputError &)
      {
      }
    try
      {
        ephyra::Expression(text, variables);
        return "";
      }
    catch (const InputError &error)
      {
        return error.what();
      }
  }

  std::string
  Expression::resolve(const std::string &text, const std::string &) const
  {
    try
      {
        const Quantity quantity = parse_quantity(text);
        if (quantity.has_unit &&
            quantity.dimension == parse_unit(unit_text).dimension)
          return text::number(quantity.value);
      }
    catch (const InputError &)
      {
      }
    return text;
  }

  std::string
  Expression::description() const
  {
    const std::string quantity =
      unit_text.empty()
        ? ""
        : " giving " + parse_unit(unit_text).dimension.description() + " in " +
            unit_text;
    if (variables.empty())
      return "a formula without variables" + quantity;
    return "a formula in " + text::quoted_list(variables) + quantity;
  }

  std::string
  Expression::unit() const
  {
    return unit_text;
  }

  // --- Anything ---------------------------------------------------------

  std::unique_ptr<PatternBase>
  Anything::clone() const
  {
    return std::make_unique<Anything>(*this);
  }

  std::string
  Anything::error(const std::string &) const
  {
    return "";
  }

  std::string
  Anything::description() const
  {
    return "any text";
  }

  // --- InputFile --------------------------------------------------------

  std::unique_ptr<PatternBase>
  InputFile::clone() const
  {
    return std::make_unique<InputFile>(*this);
  }

  std::string
  InputFile::error(const std::string &text) const
  {
    std::error_code ignored;
    if (text.empty() || std::filesystem::is_regular_file(text, ignored))
      return "";
    return "there is no file " + text::quote(text);
  }

  std::string
  InputFile::resolve(const std::string &text, const std::string &folder) const
  {
    return resolve_file(text, folder);
  }

  std::string
  InputFile::description() const
  {
    return "the name of a file, relative to the parameter file";
  }
} // namespace ephyra::patterns
