// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/units.h"

#include "core/base/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace ogive::units
{
namespace
{
/// SI value of a unit: 10^decimal * factor. The decimal part is kept apart so
/// that it can move the decimal point of the number without rounding.
struct Unit
{
  int       decimal = 0;
  double    factor  = 1;
  Dimension dimension;
};

struct Symbol
{
  std::string_view name;
  Unit             unit;
  bool             takes_prefix;
};

constexpr double degree = std::numbers::pi / 180;

constexpr std::array<Symbol, 15> symbols{{{"m", {0, 1, length}, true},
                                          {"g", {-3, 1, mass}, true},
                                          {"t", {3, 1, mass}, false},
                                          {"s", {0, 1, time}, true},
                                          {"min", {0, 60, time}, false},
                                          {"K", {0, 1, temperature}, true},
                                          {"N", {0, 1, force}, true},
                                          {"Pa", {0, 1, pressure}, true},
                                          {"bar", {5, 1, pressure}, true},
                                          {"J", {0, 1, energy}, true},
                                          {"W", {0, 1, {1, 2, -3, 0}}, true},
                                          {"Hz", {0, 1, rate}, true},
                                          {"rad", {0, 1, none}, true},
                                          {"deg", {0, degree, none}, false},
                                          {"%", {-2, 1, none}, false}}};

constexpr std::array<std::pair<std::string_view, int>, 10> prefixes{{{"T", 12},
                                                                     {"G", 9},
                                                                     {"M", 6},
                                                                     {"k", 3},
                                                                     {"c", -2},
                                                                     {"m", -3},
                                                                     {"u", -6},
                                                                     {"\u00b5", -6},
                                                                     {"n", -9},
                                                                     {"p", -12}}};

bool find_symbol(std::string_view name, Unit &unit)
{
  for (const Symbol &s : symbols)
    if (s.name == name)
    {
      unit = s.unit;
      return true;
    }
  for (const auto &[prefix, power] : prefixes)
    if (name.starts_with(prefix))
      for (const Symbol &s : symbols)
        if (s.takes_prefix && s.name == name.substr(prefix.size()))
        {
          unit = s.unit;
          unit.decimal += power;
          return true;
        }
  return false;
}

std::string lower(std::string_view s)
{
  std::string r(s);
  std::transform(r.begin(), r.end(), r.begin(), [](unsigned char c) { return std::tolower(c); });
  return r;
}

/// A known unit that differs from `name` by case only, or by a written-out name.
std::string similar_symbol(std::string_view name)
{
  constexpr std::array<std::pair<std::string_view, std::string_view>, 9> long_names{
    {{"meter", "m"},
     {"metre", "m"},
     {"sec", "s"},
     {"second", "s"},
     {"kelvin", "K"},
     {"pascal", "Pa"},
     {"degree", "deg"},
     {"psi", "Pa"},
     {"celsius", "K"}}};
  const std::string wanted = lower(name);
  for (const auto &[word, unit] : long_names)
    if (wanted == word || wanted == std::string(word) + "s")
      return std::string(unit);
  // what engineers write most comes first: "mpa" is no millipascal, "MM" no megametre
  for (const std::string_view common : {"mm", "MPa", "GPa", "kPa", "us", "ms"})
    if (lower(common) == wanted)
      return std::string(common);
  for (const Symbol &s : symbols)
    if (lower(s.name) == wanted)
      return std::string(s.name);
  for (const auto &[prefix, power] : prefixes)
    for (const Symbol &s : symbols)
      if (s.takes_prefix && lower(std::string(prefix) + std::string(s.name)) == wanted)
        return std::string(prefix) + std::string(s.name);
  return {};
}

/// Recursive descent over: product of powers, quotients, parentheses.
class UnitParser
{
public:
  explicit UnitParser(std::string_view text)
    : text_(text)
  {}

  Unit parse()
  {
    const Unit u = expression();
    if (at_ < text_.size())
      throw InputError("\"" + std::string(text_) + "\" is not a unit: unexpected \"" +
                       std::string(text_.substr(at_)) + "\"");
    return u;
  }

private:
  void skip_blanks()
  {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t'))
      ++at_;
  }

  static void multiply(Unit &u, const Unit &v, int power)
  {
    u.decimal += power * v.decimal;
    u.factor *= std::pow(v.factor, power);
    u.dimension.kg += power * v.dimension.kg;
    u.dimension.m += power * v.dimension.m;
    u.dimension.s += power * v.dimension.s;
    u.dimension.K += power * v.dimension.K;
  }

  Unit expression()
  {
    Unit u        = power();
    bool divided  = false;
    for (;;)
    {
      skip_blanks();
      if (at_ >= text_.size() || text_[at_] == ')')
        return u;
      const bool divide  = text_[at_] == '/';
      const bool product = text_[at_] == '*' || text_[at_] == '.';
      if (divided && !divide)
        throw InputError("\"" + std::string(text_) +
                         "\" can be read in two ways; write parentheses, as in \"J/(kg K)\"");
      if (divide || product)
        ++at_;
      divided = divided || divide;
      multiply(u, power(), divide ? -1 : 1);
    }
  }

  Unit power()
  {
    Unit base = primary();
    if (at_ >= text_.size() || text_[at_] != '^')
      return base;
    int         exponent = 0;
    const char *first    = text_.data() + at_ + 1;
    const auto [end, error] = std::from_chars(first, text_.data() + text_.size(), exponent);
    if (error != std::errc() || std::abs(exponent) > 12)
      throw InputError("\"" + std::string(text_) + "\" is not a unit: \"^\" wants an integer after it");
    at_ = end - text_.data();
    Unit u;
    multiply(u, base, exponent);
    return u;
  }

  Unit primary()
  {
    skip_blanks();
    if (at_ < text_.size() && text_[at_] == '(')
    {
      ++at_;
      const Unit u = expression();
      if (at_ >= text_.size())
        throw InputError("\"" + std::string(text_) + "\" is not a unit: a parenthesis is not closed");
      ++at_;
      return u;
    }
    if (at_ < text_.size() && text_[at_] == '1')
    {
      ++at_;
      return {};
    }
    return symbol();
  }

  Unit symbol()
  {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalpha(static_cast<unsigned char>(text_[at_])) ||
                                  text_[at_] == '%' || (text_[at_] & 0x80)))
      ++at_;
    std::string name(text_.substr(begin, at_ - begin));
    // the Greek letter mu stands for micro just as the micro sign does
    if (name.starts_with("\u03bc"))
      name.replace(0, 2, "\u00b5");
    if (name.empty())
      throw InputError("\"" + std::string(text_) + "\" is not a unit");
    Unit u;
    if (find_symbol(name, u))
      return u;
    const std::string hint = similar_symbol(name);
    throw InputError("unknown unit \"" + name + "\"" +
                     (hint.empty() ? "" : "; did you mean \"" + hint + "\"?"));
  }

  std::string_view text_;
  std::size_t      at_ = 0;
};

/// The double nearest to mantissa * 10^shift, `text` being a plain decimal number.
double parse_shifted(std::string_view text, int shift)
{
  const std::size_t e        = text.find_first_of("eE");
  int               exponent = 0;
  if (e != std::string_view::npos)
  {
    std::string_view digits = text.substr(e + 1);
    if (digits.starts_with('+'))
      digits.remove_prefix(1);
    std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
  }
  const std::string moved =
    std::string(text.substr(0, e)) + "e" + std::to_string(exponent + shift);
  double value = 0;
  const auto [end, error] = std::from_chars(moved.data(), moved.data() + moved.size(), value);
  if (error == std::errc::result_out_of_range)
    throw InputError("\"" + std::string(text) + "\" is too large or too small for a number");
  return value;
}

struct Named
{
  Dimension        dimension;
  std::string_view unit, name, example;
};

constexpr std::array<Named, 16> named{
  {{none, "", "number", "0.5"},
   {length, "m", "length", "12 mm"},
   {area, "m^2", "area", "4 mm^2"},
   {time, "s", "time", "80 us"},
   {mass, "kg", "mass", "197 g"},
   {velocity, "m/s", "velocity", "227 m/s"},
   {acceleration, "m/s^2", "acceleration", "9.81 m/s^2"},
   {rate, "1/s", "rate", "100 rad/s"},
   {density, "kg/m^3", "density", "7.85 g/cm^3"},
   {pressure, "Pa", "pressure", "340 MPa"},
   {force, "N", "force", "20 kN"},
   {energy, "J", "energy", "9 kJ"},
   {momentum, "N s", "momentum", "60 N s"},
   {temperature, "K", "temperature", "294 K"},
   {specific_heat, "J/(kg K)", "specific heat", "383 J/(kg K)"},
   {{1, 2, -1, 0}, "N m s", "angular momentum", "2 N m s"}}};

const Named *find_named(Dimension d)
{
  const auto it =
    std::find_if(named.begin(), named.end(), [d](const Named &n) { return n.dimension == d; });
  return it == named.end() ? nullptr : &*it;
}
} // namespace

Quantity parse_quantity(std::string_view text)
{
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos)
    throw InputError("the value is empty");
  text = text.substr(first, text.find_last_not_of(" \t") + 1 - first);

  const char *begin = text.data(), *end = begin + text.size();
  double      number = 0;
  const char *start  = begin + (*begin == '+' ? 1 : 0);
  const auto [rest, error] = std::from_chars(start, end, number);
  if (error == std::errc::invalid_argument)
    throw InputError("\"" + std::string(text) + "\" does not begin with a number");
  // from_chars also reads "nan" and "inf", and stops before units that begin so
  if (error == std::errc() && !std::isfinite(number))
    throw InputError("\"" + std::string(text) + "\" is not a finite number");

  std::string_view unit_text(rest, end - rest);
  const std::size_t u = unit_text.find_first_not_of(" \t");
  const Unit unit = u == std::string_view::npos ? Unit() : UnitParser(unit_text.substr(u)).parse();
  const double value = parse_shifted({start, static_cast<std::size_t>(rest - start)}, unit.decimal);
  return {unit.factor == 1 ? value : value * unit.factor, unit.dimension};
}

std::string format_number(double value)
{
  std::array<char, 32> buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end};
}

std::string format_quantity(double value, Dimension d)
{
  const std::string unit = si_unit(d);
  return format_number(value) + (unit.empty() ? "" : " " + unit);
}

std::string si_unit(Dimension d)
{
  if (const Named *n = find_named(d))
    return std::string(n->unit);
  std::string s;
  for (const auto &[symbol, power] :
       {std::pair{"kg", d.kg}, std::pair{"m", d.m}, std::pair{"s", d.s}, std::pair{"K", d.K}})
    if (power != 0)
      s += (s.empty() ? "" : " ") + std::string(symbol) + (power == 1 ? "" : "^" + std::to_string(power));
  return s;
}

std::string describe(Dimension d)
{
  const Named *n = find_named(d);
  return n ? std::string(n->name) : "quantity in " + si_unit(d);
}

std::string example(Dimension d)
{
  const Named *n = find_named(d);
  return n ? std::string(n->example) : "1 " + si_unit(d);
}
} // namespace ogive::units
