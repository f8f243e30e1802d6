#include "ephyra/base/quantity.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/text.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

namespace ephyra
{
  namespace
  {
    struct NamedUnit
    {
      const char *symbol;
      bool        prefixes;
      Unit        unit;
    };

    // Exponents in the order m, kg, s, A, K.
    const std::vector<NamedUnit> &
    named_units()
    {
      static const double                 degree = std::acos(-1.) / 180.;
      static const std::vector<NamedUnit> units{
        {"m", true, {1, 0, {{{1, 0, 0, 0, 0}}}}},
        {"g", true, {1, -3, {{{0, 1, 0, 0, 0}}}}},
        {"s", true, {1, 0, {{{0, 0, 1, 0, 0}}}}},
        {"A", true, {1, 0, {{{0, 0, 0, 1, 0}}}}},
        {"K", true, {1, 0, {{{0, 0, 0, 0, 1}}}}},
        {"N", true, {1, 0, {{{1, 1, -2, 0, 0}}}}},
        {"Pa", true, {1, 0, {{{-1, 1, -2, 0, 0}}}}},
        {"Hz", true, {1, 0, {{{0, 0, -1, 0, 0}}}}},
        {"J", true, {1, 0, {{{2, 1, -2, 0, 0}}}}},
        {"W", true, {1, 0, {{{2, 1, -3, 0, 0}}}}},
        {"V", true, {1, 0, {{{2, 1, -3, -1, 0}}}}},
        {"S", true, {1, 0, {{{-2, -1, 3, 2, 0}}}}},
        {"F", true, {1, 0, {{{-2, -1, 4, 2, 0}}}}},
        {"C", true, {1, 0, {{{0, 0, 1, 1, 0}}}}},
        {"Ohm", true, {1, 0, {{{2, 1, -3, -2, 0}}}}},
        {"\xCE\xA9", true, {1, 0, {{{2, 1, -3, -2, 0}}}}},     // Ω, letter
        {"\xE2\x84\xA6", true, {1, 0, {{{2, 1, -3, -2, 0}}}}}, // Ω, sign
        {"L", true, {1, -3, {{{3, 0, 0, 0, 0}}}}},
        {"rad", true, {1, 0, {}}},
        {"deg", false, {degree, 0, {}}},
        {"%", false, {1, -2, {}}},
        {"min", false, {60, 0, {{{0, 0, 1, 0, 0}}}}},
        {"h", false, {3600, 0, {{{0, 0, 1, 0, 0}}}}},
        {"1", false, {1, 0, {}}}};
      return units;
    }

    const std::vector<std::pair<std::string, int>> prefixes{{"f", -15},
                                                            {"p", -12},
                                                            {"n", -9},
                                                            {"u", -6},
                                                            {"\xC2\xB5", -6},
                                                            {"m", -3},
                                                            {"c", -2},
                                                            {"d", -1},
                                                            {"h", 2},
                                                            {"k", 3},
                                                            {"M", 6},
                                                            {"G", 9},
                                                            {"\xCE\xBC", -6},
                                                            {"T", 12}};

    /// Symbols stand before prefixed symbols: "min" are minutes, "Pa" is no
    /// peta-year.
    bool
    find_unit(const std::string &symbol, Unit &result)
    {
      for (const NamedUnit &named : named_units())
        if (symbol == named.symbol)
          {
            result = named.unit;
            return true;
          }
      for (const auto &[prefix, power] : prefixes)
        if (symbol.compare(0, prefix.size(), prefix) == 0)
          for (const NamedUnit &named : named_units())
            if (named.prefixes && symbol.substr(prefix.size()) == named.symbol)
              {
                result = named.unit;
                result.power_of_ten += power;
                return true;
              }
      return false;
    }

    void
    multiply(Unit &a, const Unit &b, const int exponent)
    {
      a.factor *= std::pow(b.factor, exponent);
      a.power_of_ten += exponent * b.power_of_ten;
      for (unsigned int i = 0; i < 5; ++i)
        a.dimension.exponents[i] += exponent * b.dimension.exponents[i];
    }

    /// Recursive descent through
    ///   product = factor { [*] factor } { / factor },
    ///   factor  = ( symbol | "(" product ")" ) [ ^ integer ].
    class UnitParser
    {
    public:
      explicit UnitParser(const std::string &text)
        : text(text)
      {
      }

      Unit
      parse()
      {
        const Unit result = product();
        if (position < text.size())
          fail("there is an unexpected " +
               text::quote(text.substr(position, 1)));
        return result;
      }

    private:
      [[noreturn]] void
      fail(const std::string &what) const
      {
        throw InputError("the unit " + text::quote(text) +
                         " is not understood: " + what);
      }

      char
      next()
      {
        while (position < text.size() && text[position] == ' ')
          ++position;
        return position < text.size() ? text[position] : '\0';
      }

      Unit
      product()
      {
        Unit result  = factor();
        bool divided = false;
        while (true)
          {
            const char c = next();
            if (c == '\0' || c == ')')
              return result;
            if (c == '/' || c == '*')
              ++position;
            if (c != '/' && divided)
              fail("a product after a division is ambiguous, use parentheses");
            divided = (c == '/');
            multiply(result, factor(), divided ? -1 : 1);
          }
      }

      Unit
      factor()
      {
        Unit base;
        if (next() == '(')
          {
            if (++depth > 5)
              fail("it has too many parentheses");
            ++position;
            base = product();
            if (next() != ')')
              fail("a closing parenthesis is missing");
            ++position;
            --depth;
          }
        else
          base = symbol();
        if (next() != '^')
          return base;
        ++position;
        Unit result;
        multiply(result, base, exponent());
        return result;
      }

      Unit
      symbol()
      {
        const std::size_t start = position;
        while (position < text.size() &&
               std::string(" */^()").find(text[position]) == std::string::npos)
          ++position;
        const std::string name = text.substr(start, position - start);
        if (name.empty())
          fail("a unit is missing");
        Unit result;
        if (!find_unit(name, result))
          fail("there is no unit " + text::quote(name));
        return result;
      }

      int
      exponent()
      {
        next();
        int        result = 0;
        const auto end    = text.data() + text.size();
        const auto [rest, status] =
          std::from_chars(text.data() + position, end, result);
        if (status != std::errc() || result < -9 || result > 9)
          fail("an integer between -9 and 9 must follow \"^\"");
        position = rest - text.data();
        return result;
      }

      const std::string &text;
      std::size_t        position = 0;
      unsigned int       depth    = 0;
    };

    struct NamedDimension
    {
      const char *unit;
      const char *description;
    };

    const std::vector<NamedDimension> named_dimensions{
      {"1", "a number"},
      {"m", "a length"},
      {"kg", "a mass"},
      {"s", "a time"},
      {"A", "an electric current"},
      {"K", "a temperature"},
      {"N", "a force"},
      {"Pa", "a pressure"},
      {"Hz", "a frequency"},
      {"J", "an energy"},
      {"W", "a power"},
      {"V", "a voltage"},
      {"S", "an electric conductance"},
      {"F", "an electric capacitance"},
      {"C", "an electric charge"},
      {"Ohm", "an electric resistance"},
      {"m^2", "an area"},
      {"m^3", "a volume"},
      {"1/m", "a reciprocal length"},
      {"m/s", "a velocity"},
      {"m/s^2", "an acceleration"},
      {"m^2/s", "a diffusivity or kinematic viscosity"},
      {"m^3/s", "a volume flow rate"},
      {"kg/m^3", "a density"},
      {"kg/s", "a mass flow rate"},
      {"N s", "a momentum"},
      {"Pa s", "a dynamic viscosity"},
      {"Pa/m", "a pressure gradient or force per volume"},
      {"N/m", "a force per length"},
      {"A/m^2", "an electric current per area"},
      {"A/m^3", "an electric current per volume"},
      {"S/m", "an electric conductivity"},
      {"S/m^2", "an electric conductance per area"},
      {"S/m^3", "an electric conductance per volume"},
      {"F/m^2", "an electric capacitance per area"},
      {"F/m^3", "an electric capacitance per volume"}};
  } // namespace

  bool
  Dimension::operator==(const Dimension &other) const
  {
    return exponents == other.exponents;
  }

  bool
  Dimension::operator!=(const Dimension &other) const
  {
    return !(*this == other);
  }

  std::string
  Dimension::description() const
  {
    for (const NamedDimension &named : named_dimensions)
      if (parse_unit(named.unit).dimension == *this)
        return named.description;
    return "a quantity in " + base_units();
  }

  std::string
  Dimension::base_units() const
  {
    // Mass first, as is usual.
    const std::array<std::pair<const char *, int>, 5> order{
      {{"kg", 1}, {"m", 0}, {"s", 2}, {"A", 3}, {"K", 4}}};
    std::string above, below;
    int         n_below = 0;
    for (const auto &[symbol, index] : order)
      {
        const int exponent = exponents[index];
        if (exponent == 0)
          continue;
        std::string &part = exponent > 0 ? above : below;
        part += (part.empty() ? "" : " ") + std::string(symbol);
        if (std::abs(exponent) > 1)
          part += "^" + std::to_string(std::abs(exponent));
        n_below += exponent < 0 ? 1 : 0;
      }
    if (above.empty())
      above = "1";
    if (below.empty())
      return above;
    return above + "/" + (n_below > 1 ? "(" + below + ")" : below);
  }

  double
  Unit::to_si(const double x) const
  {
    return power_of_ten < 0 ? x * factor / std::pow(10., -power_of_ten)
                            : x * factor * std::pow(10., power_of_ten);
  }

  Unit
  parse_unit(const std::string &text)
  {
    const std::string unit = text::normalize(text);
    return unit.empty() ? Unit() : UnitParser(unit).parse();
  }

  Quantity
  parse_quantity(const std::string &text)
  {
    const std::string clean = text::normalize(text);
    const char       *begin = clean.data(), *end = begin + clean.size();
    if (begin != end && *begin == '+')
      ++begin;
    const char *digit = begin;
    if (digit != end && *digit == '-')
      ++digit;
    double value = 0;
    // Words such as "nan" and "inf" are no numbers here.
    const bool number =
      digit != end &&
      (std::isdigit(static_cast<unsigned char>(*digit)) || *digit == '.');
    const auto [rest, status] = std::from_chars(begin, end, value);
    EphyraThrowIf(!number || status == std::errc::invalid_argument,
                  InputError,
                  text::quote(clean) << " is not a number");
    EphyraThrowIf(status == std::errc::result_out_of_range,
                  InputError,
                  text::quote(clean) << " is too large or too small a number");
    const std::string unit_text(rest, end);
    const Unit        unit = parse_unit(unit_text);
    const double      si   = unit.to_si(value);
    EphyraThrowIf(!std::isfinite(si),
                  InputError,
                  text::quote(clean) << " is too large a number");
    return {si, unit.dimension, !text::normalize(unit_text).empty()};
  }
} // namespace ephyra
