#pragma once

#include <array>
#include <string>

namespace ephyra
{
  /// Exponents of the base units m, kg, s, A, K. Angles have no dimension.
  struct Dimension
  {
    std::array<int, 5> exponents{{0, 0, 0, 0, 0}};

    bool
    operator==(const Dimension &other) const;
    bool
    operator!=(const Dimension &other) const;

    /// In words with an article: "a length", "a pressure", "a number"; where
    /// there is no common word: "a quantity in kg m^2/s".
    std::string
    description() const;
    /// In base units: "kg/(m s^2)"; "1" for a number.
    std::string
    base_units() const;
  };

  /// A unit is factor * 10^power_of_ten in SI; the power is kept apart so that
  /// "30 mm" becomes 30 / 1000, rounded once.
  struct Unit
  {
    double    factor       = 1;
    int       power_of_ten = 0;
    Dimension dimension;

    /// @p x in this unit, converted to SI.
    double
    to_si(double x) const;
  };

  struct Quantity
  {
    double    value; ///< SI
    Dimension dimension;
    bool      has_unit; ///< false for a bare number
  };

  /// Reads a unit: products ("mPa s", "mPa*s"), one or more divisions
  /// ("kg/m^3", "nA/(mm mV)"), integer powers and parentheses of
  ///   m g s A K N Pa Hz J W V S F C Ohm L rad with SI prefixes,
  ///   deg, %, min, h, 1.
  /// Micro may be written u or µ, ohm also Ω. A product after a division
  /// ("W/m K") is refused as ambiguous. "" is the unit of a number.
  /// Throws InputError with what is wrong.
  Unit
  parse_unit(const std::string &text);

  /// Reads a finite number with an optional unit: "30 mm", "1.1e3 kg/m^3".
  /// Throws InputError with what is wrong.
  Quantity
  parse_quantity(const std::string &text);
} // namespace ephyra
