// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/tensor.h"
#include "core/base/units.h"

#include <deal.II/base/patterns.h>

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

/// What values an entry may have. Each pattern can say what is wrong with a
/// value, what it expects, and what was probably meant.
namespace ogive::input
{
/// Limits of a number, SI.
struct Bound
{
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool   low_open = false, high_open = false; ///< whether the limit itself is excluded

  bool        admits(double) const;
  std::string describe(units::Dimension) const; ///< " > 0", " between 0 and 1", or nothing
};
namespace bounds
{
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr Bound  any{};
inline constexpr Bound  positive{0, infinity, true, false};
inline constexpr Bound  not_negative{0, infinity, false, false};
inline constexpr Bound  fraction{0, 1, false, false};
inline constexpr Bound  positive_fraction{0, 1, true, false};
} // namespace bounds

/// Base of the patterns below.
class Pattern : public dealii::Patterns::PatternBase
{
public:
  struct Complaint
  {
    std::string wrong, suggestion; ///< both empty if the value is good
  };

  /// What is wrong with a value that is not empty.
  virtual Complaint complaint(const std::string &value) const = 0;

  /// "a pressure > 0, such as \"340 MPa\"".
  virtual std::string expectation() const = 0;

  /// An empty value is that of an entry which is not set, and matches.
  bool        match(const std::string &value) const final { return value.empty() || complaint(value).wrong.empty(); }
  std::string description(OutputStyle = Machine) const final { return expectation(); }
};

/// A number with a dimension and a bound.
class QuantityPattern : public Pattern
{
public:
  QuantityPattern(units::Dimension, Bound);
  Complaint                                     complaint(const std::string &) const override;
  std::string                                   expectation() const override;
  std::unique_ptr<dealii::Patterns::PatternBase> clone() const override;

private:
  units::Dimension dimension_;
  Bound            bound_;
};

/// One to three components of one dimension, each with its unit or all with
/// that of the last: "0 m/s, -227 m/s" or "0, -227 m/s".
class VectorPattern : public Pattern
{
public:
  explicit VectorPattern(units::Dimension, bool nonzero = false);
  Complaint                                     complaint(const std::string &) const override;
  std::string                                   expectation() const override;
  std::unique_ptr<dealii::Patterns::PatternBase> clone() const override;

private:
  units::Dimension dimension_;
  bool             nonzero_;
};

/// One of a few words.
class ChoicePattern : public Pattern
{
public:
  explicit ChoicePattern(std::vector<std::string> choices);
  Complaint                                     complaint(const std::string &) const override;
  std::string                                   expectation() const override;
  std::unique_ptr<dealii::Patterns::PatternBase> clone() const override;

private:
  std::vector<std::string> choices_;
};

/// A comma-separated list of different names, each of letters, digits, "-", "_"
/// and "."; with `choices`, only those; with `count`, exactly as many.
class NamesPattern : public Pattern
{
public:
  explicit NamesPattern(std::vector<std::string> choices = {}, std::size_t count = 0);
  Complaint                                     complaint(const std::string &) const override;
  std::string                                   expectation() const override;
  std::unique_ptr<dealii::Patterns::PatternBase> clone() const override;

private:
  std::vector<std::string> choices_;
  std::size_t              count_;
};

/// Any text.
class TextPattern : public Pattern
{
public:
  explicit TextPattern(std::string expectation = "a text");
  Complaint                                     complaint(const std::string &) const override;
  std::string                                   expectation() const override;
  std::unique_ptr<dealii::Patterns::PatternBase> clone() const override;

private:
  std::string expectation_;
};

/// Where a number comes from: "KIND: one sentence".
class SourcePattern : public Pattern
{
public:
  static const std::vector<std::string> &kinds();
  Complaint                              complaint(const std::string &) const override;
  std::string                            expectation() const override;
  std::unique_ptr<dealii::Patterns::PatternBase> clone() const override;
};

/// "LOW .. HIGH" with units, LOW <= HIGH.
class RangePattern : public Pattern
{
public:
  explicit RangePattern(units::Dimension);
  Complaint                                     complaint(const std::string &) const override;
  std::string                                   expectation() const override;
  std::unique_ptr<dealii::Patterns::PatternBase> clone() const override;

private:
  units::Dimension dimension_;
};

/// What an InputError of `parse` complains of, its suggestion parted from the rest.
Pattern::Complaint complaint_of(const std::function<void()> &parse);

/// The values of texts that match the patterns above. SI.
double                    parse_scalar(const std::string &, units::Dimension, Bound = bounds::any);
Vec3                      parse_vector(const std::string &, units::Dimension);
std::pair<double, double> parse_range(const std::string &, units::Dimension);
std::string               format_vector(const Vec3 &, units::Dimension);
std::string               format_range(double low, double high, units::Dimension);

/// Components that a vector's text gives.
std::size_t count_components(const std::string &);
} // namespace ogive::input
