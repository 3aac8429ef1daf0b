// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <string_view>

/// Quantities with units, as users write them: "340 MPa", "7.85 g/cm^3",
/// "383 J/(kg K)", "1e-3 1/s", "30 deg". Inside the program every number is SI.
namespace ogive::units
{
/// Exponents of the base units kilogram, metre, second, kelvin.
struct Dimension
{
  int kg = 0, m = 0, s = 0, K = 0;

  bool operator==(const Dimension &) const = default;
};

inline constexpr Dimension none{};
inline constexpr Dimension length{0, 1, 0, 0};
inline constexpr Dimension area{0, 2, 0, 0};
inline constexpr Dimension time{0, 0, 1, 0};
inline constexpr Dimension mass{1, 0, 0, 0};
inline constexpr Dimension velocity{0, 1, -1, 0};
inline constexpr Dimension acceleration{0, 1, -2, 0};
inline constexpr Dimension rate{0, 0, -1, 0};
inline constexpr Dimension density{1, -3, 0, 0};
inline constexpr Dimension pressure{1, -1, -2, 0};
inline constexpr Dimension force{1, 1, -2, 0};
inline constexpr Dimension energy{1, 2, -2, 0};
inline constexpr Dimension momentum{1, 1, -1, 0};
inline constexpr Dimension temperature{0, 0, 0, 1};
inline constexpr Dimension specific_heat{0, 2, -2, -1};

/// A number in SI and what it measures.
struct Quantity
{
  double    value = 0;
  Dimension dimension;
};

/// Reads a finite number followed by its unit; a bare number is dimensionless.
///
/// The decimal point is moved before the number is rounded, so "12 mm" is the
/// double nearest to 0.012. Products are written with a space, `*` or `.`,
/// powers with `^`, and a quotient by a product with parentheses: J/(kg K).
/// Throws InputError (without a place) saying what is wrong and, for a unit
/// that differs by case or one letter, what may have been meant.
Quantity parse_quantity(std::string_view text);

/// Shortest decimal text that reads back as the same double.
std::string format_number(double value);

/// `format_number` with the SI unit of the dimension: reads back to the same double.
std::string format_quantity(double value, Dimension);

/// SI unit of a dimension, "Pa", "kg/m^3", "J/(kg K)"; empty for none.
std::string si_unit(Dimension);

/// What a person calls it: "pressure", "length"; "number" for none; the unit
/// itself for a dimension without a common name.
std::string describe(Dimension);

/// A value as people write it, for messages: "340 MPa"; "0.5" for none.
std::string example(Dimension);
} // namespace ogive::units
