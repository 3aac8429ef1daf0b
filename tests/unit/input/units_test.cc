// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "core/base/units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace ogive::units
{
namespace
{
struct Case
{
  const char *text;
  double      value; ///< the literal in SI: parsing must give this very double
  Dimension   dimension;
};

// values by the definition of the units (SI brochure)
const Case good[] = {{"340 MPa", 340e6, pressure},
                     {"227 m/s", 227, velocity},
                     {"7.85 g/cm^3", 7850, density},
                     {"383 J/(kg K)", 383, specific_heat},
                     {"383 J/kg/K", 383, specific_heat},
                     {"1e-3 1/s", 1e-3, rate},
                     {"5e-4 s^-1", 5e-4, rate},
                     {"12 mm", .012, length},
                     {"12mm", .012, length},
                     {"0.1 um", 1e-7, length},
                     {"80.1 mm", .0801, length},
                     {"3.3 \u00b5s", 3.3e-6, time},
                     {"3.3 \u03bcs", 3.3e-6, time},
                     {"-303.5 m/s", -303.5, velocity},
                     {"+.5 km/s", 500, velocity},
                     {"6.18 mm/us", 6180, velocity},
                     {"1.2 t/m^3", 1200, density},
                     {"0.3", .3, none},
                     {"2 %", .02, none},
                     {"2 bar", 2e5, pressure},
                     {"20 kN", 20e3, force},
                     {"1 N/mm^2", 1e6, pressure},
                     {"3 N*m", 3, energy},
                     {"3 N m", 3, energy},
                     {"2 min", 120, time},
                     {"1356 K", 1356, temperature},
                     {"10 Hz", 10, rate},
                     {"4 cm^2", 4e-4, area},
                     {"100 rad/s", 100, rate}};

TEST(Units, ReadToTheNearestDouble)
{
  for (const Case &c : good)
  {
    const Quantity q = parse_quantity(c.text);
    EXPECT_EQ(q.value, c.value) << c.text;
    EXPECT_TRUE(q.dimension == c.dimension) << c.text;
  }
}

TEST(Units, AnglesAreNumbers)
{
  EXPECT_DOUBLE_EQ(parse_quantity("30 deg").value, std::numbers::pi / 6);
  EXPECT_DOUBLE_EQ(parse_quantity("90 deg/s").value, std::numbers::pi / 2);
  EXPECT_TRUE(parse_quantity("90 deg/s").dimension == rate);
}

TEST(Units, SayWhatIsWrong)
{
  const std::pair<const char *, const char *> wrong[] = {
    {"", "empty"},
    {"MPa", "does not begin with a number"},
    {"nan MPa", "not a finite number"},
    {"inf m/s", "not a finite number"},
    {"-inf", "not a finite number"},
    {"1e400 m", "too large"},
    {"340 mpa", "did you mean \"MPa\"?"},
    {"12 MM", "did you mean \"mm\"?"},
    {"12 meters", "did you mean \"m\"?"},
    {"3 furlong", "unknown unit \"furlong\""},
    {"383 J/kg K", "two ways"},
    {"383 J/(kg K", "parenthesis"},
    {"3 m^", "integer"},
    {"3 m^x", "integer"},
    {"3 m)", "unexpected \")\""},
    {"3 4 m", "not a unit"},
    {"1,5 m", "not a unit"}};
  for (const auto &[text, part] : wrong)
    try
    {
      parse_quantity(text);
      ADD_FAILURE() << text << " was read";
    }
    catch (const InputError &e)
    {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << text << ": " << e.what();
    }
}

TEST(Units, WriteWhatReadsBackExactly)
{
  std::mt19937_64                        random(20261122);
  std::uniform_real_distribution<double> mantissa(-10, 10), exponent(-300, 300);
  const Dimension dimensions[] = {none,     length,  area,   time,   mass,     velocity,    rate,
                                  density,  pressure, force, energy, momentum, temperature, specific_heat,
                                  {1, 2, -1, 0}, {2, -3, 1, -2}, {0, 0, 0, -1}};
  for (int i = 0; i < 20000; ++i)
  {
    const double    value = mantissa(random) * std::pow(10, exponent(random));
    const Dimension d     = dimensions[i % std::size(dimensions)];
    const Quantity  q     = parse_quantity(format_quantity(value, d));
    ASSERT_EQ(q.value, value) << format_quantity(value, d);
    ASSERT_TRUE(q.dimension == d) << format_quantity(value, d);
  }
}

TEST(Units, ExamplesAreOfTheirDimension)
{
  for (const Dimension d : {none, length, area, time, mass, velocity, rate, density, pressure, force, energy, momentum,
                            temperature, specific_heat})
    EXPECT_TRUE(parse_quantity(example(d)).dimension == d) << example(d);
}
} // namespace
} // namespace ogive::units
