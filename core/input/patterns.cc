// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/patterns.h"

#include "core/base/error.h"
#include "core/input/listing.h"
#include "core/input/suggest.h"

#include <algorithm>
#include <set>
#include <utility>

namespace ogive::input
{
bool Bound::admits(double v) const
{
  return (low_open ? v > low : v >= low) && (high_open ? v < high : v <= high);
}

std::string Bound::describe(units::Dimension d) const
{
  const auto text = [d](double v) { return v == 0 ? "0" : units::format_quantity(v, d); };
  const bool has_low = low > -bounds::infinity, has_high = high < bounds::infinity;
  std::string s;
  if (has_low)
    s += (low_open ? " > " : " >= ") + text(low);
  if (has_high)
    s += std::string(has_low ? " and" : "") + (high_open ? " < " : " <= ") + text(high);
  return s;
}

namespace
{
constexpr std::string_view hint_marker = "; did you mean ";

/// The text of an exception, its suggestion parted from the rest.
Pattern::Complaint as_complaint(const InputError &e)
{
  const std::string text = e.what();
  const std::size_t at   = text.find(hint_marker);
  return at == std::string::npos ? Pattern::Complaint{text, {}} :
                                   Pattern::Complaint{text.substr(0, at), text.substr(at + 2)};
}

std::string article(const std::string &noun)
{
  return (std::string("aeiou").find(noun.front()) == std::string::npos ? "a " : "an ") + noun;
}

[[noreturn]] void refuse_dimension(const std::string &text, const units::Quantity &q, units::Dimension wanted)
{
  if (q.dimension == units::none)
    throw InputError("\"" + text + "\" has no unit");
  if (wanted == units::none)
    throw InputError("\"" + text + "\" has a unit where a pure number is wanted");
  throw InputError("\"" + text + "\" has the wrong unit: it is " + article(units::describe(q.dimension)));
}
} // namespace

Pattern::Complaint complaint_of(const std::function<void()> &parse)
{
  try
  {
    parse();
    return {};
  }
  catch (const InputError &e)
  {
    return as_complaint(e);
  }
}

double parse_scalar(const std::string &text, units::Dimension dimension, Bound bound)
{
  const units::Quantity q = units::parse_quantity(text);
  if (q.dimension != dimension)
    refuse_dimension(text, q, dimension);
  if (!bound.admits(q.value))
    throw InputError("\"" + text + "\" is out of bounds");
  return q.value;
}

std::size_t count_components(const std::string &text)
{
  return split_list(text).size();
}

Vec3 parse_vector(const std::string &text, units::Dimension dimension)
{
  const std::vector<std::string> parts = split_list(text);
  if (parts.empty() || parts.size() > 3)
    throw InputError("\"" + text + "\" has " + std::to_string(parts.size()) + " components");
  Vec3        v       = Vec3::Zero();
  std::size_t without = 0;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const units::Quantity q    = units::parse_quantity(parts[i]);
    const bool            last = i + 1 == parts.size();
    const bool            bare = q.dimension == units::none && dimension != units::none;
    without += bare;
    if ((bare && last) || (!bare && q.dimension != dimension))
      refuse_dimension(parts[i], q, dimension);
    v[static_cast<int>(i)] = q.value;
  }
  if (without > 0 && without + 1 != parts.size())
    throw InputError("\"" + text + "\" has units on some components only: give each its unit, or only the last");
  if (without > 0)
  {
    // the last component's unit is that of all
    const std::string &last = parts.back();
    const std::string  unit = last.substr(last.find_first_of(" \t") == std::string::npos ?
                                            last.find_first_not_of("+-.0123456789eE") :
                                            last.find_first_of(" \t"));
    for (std::size_t i = 0; i + 1 < parts.size(); ++i)
      v[static_cast<int>(i)] = units::parse_quantity(parts[i] + unit).value;
  }
  return v;
}

std::pair<double, double> parse_range(const std::string &text, units::Dimension dimension)
{
  const std::size_t dots = text.find("..");
  if (dots == std::string::npos)
    throw InputError("\"" + text + "\" has no \"..\"");
  const double low  = parse_scalar(trim(text.substr(0, dots)), dimension);
  const double high = parse_scalar(trim(text.substr(dots + 2)), dimension);
  if (low > high)
    throw InputError("\"" + text + "\" ends below its beginning");
  return {low, high};
}

std::string format_vector(const Vec3 &v, units::Dimension d)
{
  return units::format_number(v.x()) + ", " + units::format_number(v.y()) + ", " + units::format_quantity(v.z(), d);
}

std::string format_range(double low, double high, units::Dimension d)
{
  return units::format_quantity(low, d) + " .. " + units::format_quantity(high, d);
}

QuantityPattern::QuantityPattern(units::Dimension dimension, Bound bound)
  : dimension_(dimension)
  , bound_(bound)
{}

Pattern::Complaint QuantityPattern::complaint(const std::string &text) const
{
  return complaint_of([&] { parse_scalar(text, dimension_, bound_); });
}

std::string QuantityPattern::expectation() const
{
  const std::string what = article(units::describe(dimension_)) + bound_.describe(dimension_);
  return dimension_ == units::none ? what : what + ", such as \"" + units::example(dimension_) + "\"";
}

std::unique_ptr<dealii::Patterns::PatternBase> QuantityPattern::clone() const
{
  return std::make_unique<QuantityPattern>(*this);
}

VectorPattern::VectorPattern(units::Dimension dimension, bool nonzero)
  : dimension_(dimension)
  , nonzero_(nonzero)
{}

Pattern::Complaint VectorPattern::complaint(const std::string &text) const
{
  return complaint_of([&] {
    if (parse_vector(text, dimension_).isZero(0) && nonzero_)
      throw InputError("\"" + text + "\" is the zero vector");
  });
}

std::string VectorPattern::expectation() const
{
  if (dimension_ == units::none)
    return std::string("one to three numbers") + (nonzero_ ? ", not all 0" : "") + ", such as \"0, 0, -1\"";
  return "one to three components of " + article(units::describe(dimension_)) + ", such as \"0, 0, " +
         units::example(dimension_) + "\"";
}

std::unique_ptr<dealii::Patterns::PatternBase> VectorPattern::clone() const
{
  return std::make_unique<VectorPattern>(*this);
}

ChoicePattern::ChoicePattern(std::vector<std::string> choices)
  : choices_(std::move(choices))
{}

Pattern::Complaint ChoicePattern::complaint(const std::string &text) const
{
  if (std::find(choices_.begin(), choices_.end(), text) != choices_.end())
    return {};
  return {"\"" + text + "\" is not known here", did_you_mean(text, choices_)};
}

std::string ChoicePattern::expectation() const
{
  return choices_.size() == 1 ? "\"" + choices_.front() + "\"" : "one of " + join(choices_);
}

std::unique_ptr<dealii::Patterns::PatternBase> ChoicePattern::clone() const
{
  return std::make_unique<ChoicePattern>(*this);
}

NamesPattern::NamesPattern(std::vector<std::string> choices, std::size_t count)
  : choices_(std::move(choices))
  , count_(count)
{}

Pattern::Complaint NamesPattern::complaint(const std::string &text) const
{
  const std::vector<std::string> names = split_list(text);
  std::set<std::string>          seen;
  for (const std::string &name : names)
  {
    if (name.empty())
      return {"an empty name stands between two commas", {}};
    for (const char c : name)
      if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_' && c != '.')
        return {"\"" + name + "\" is not a name", {}};
    if (!seen.insert(name).second && count_ == 0) // a pair may be one twice
      return {"\"" + name + "\" is listed twice", {}};
    if (!choices_.empty() && std::find(choices_.begin(), choices_.end(), name) == choices_.end())
      return {"\"" + name + "\" is not known here", did_you_mean(name, choices_)};
  }
  if (count_ > 0 && names.size() != count_)
    return {"there are " + std::to_string(names.size()) + " names instead of " + std::to_string(count_), {}};
  return {};
}

std::string NamesPattern::expectation() const
{
  const std::string count = count_ > 0 ? std::to_string(count_) + " " : "";
  if (!choices_.empty())
    return "a list out of " + join(choices_);
  return (count_ > 0 ? count + "names" : "a list of names") + " of letters, digits, \"-\", \"_\" and \".\", parted by commas";
}

std::unique_ptr<dealii::Patterns::PatternBase> NamesPattern::clone() const
{
  return std::make_unique<NamesPattern>(*this);
}

TextPattern::TextPattern(std::string expectation)
  : expectation_(std::move(expectation))
{}

Pattern::Complaint TextPattern::complaint(const std::string &) const
{
  return {};
}

std::string TextPattern::expectation() const
{
  return expectation_;
}

std::unique_ptr<dealii::Patterns::PatternBase> TextPattern::clone() const
{
  return std::make_unique<TextPattern>(*this);
}

const std::vector<std::string> &SourcePattern::kinds()
{
  static const std::vector<std::string> k{"exact", "test", "code", "handbook", "memory"};
  return k;
}

Pattern::Complaint SourcePattern::complaint(const std::string &text) const
{
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || trim(text.substr(colon + 1)).empty())
    return {"the source lacks its kind or its text", {}};
  return ChoicePattern(kinds()).complaint(trim(text.substr(0, colon)));
}

std::string SourcePattern::expectation() const
{
  return "\"KIND: text\" with KIND one of " + join(kinds());
}

std::unique_ptr<dealii::Patterns::PatternBase> SourcePattern::clone() const
{
  return std::make_unique<SourcePattern>(*this);
}

RangePattern::RangePattern(units::Dimension dimension)
  : dimension_(dimension)
{}

Pattern::Complaint RangePattern::complaint(const std::string &text) const
{
  return complaint_of([&] { parse_range(text, dimension_); });
}

std::string RangePattern::expectation() const
{
  const std::string e = units::example(dimension_);
  return "\"LOW .. HIGH\", each " + article(units::describe(dimension_)) + " such as \"" + e + "\"";
}

std::unique_ptr<dealii::Patterns::PatternBase> RangePattern::clone() const
{
  return std::make_unique<RangePattern>(*this);
}
} // namespace ogive::input
