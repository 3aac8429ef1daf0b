// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/history.h"
#include "core/input/patterns.h"

#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <vector>

/// One list of entries serves to declare, read, write and document them.
///
/// To add an entry to a scene: give the struct in scene.h a member whose
/// initialiser is the default (NaN for "not set"), and name it in the function
/// `*_fields` of its subject (fields_body.cc, fields_material.cc, ...):
///
///     f.quantity({"radius", "outer radius", Need::mandatory, {"shape", {"disc", "ring"}}},
///                body.shape.radius, units::length, bounds::positive);
///
/// Everything else follows: the strict reader knows it and suggests it for slips,
/// its dimension, bound and use are checked, the resolved scene and the reference
/// show it.
namespace ogive::input
{
enum class Need
{
  optional,
  mandatory ///< wherever it applies
};

/// The entry applies only where another entry of the same subsection has one of
/// these values; without values, where that entry is set at all.
struct Use
{
  std::string              entry;
  std::vector<std::string> values;
};

struct About
{
  std::string name, meaning;
  Need        need = Need::optional;
  Use         use{};
};

class Fields
{
public:
  using Assign = std::function<void(const std::string &)>;

  virtual ~Fields() = default;

  void enter(const std::string &subsection);
  void leave();

  void quantity(const About &, double &, units::Dimension, Bound = bounds::any);
  void number(const About &, double &, Bound = bounds::any);
  void vector(const About &, Vec3 &, units::Dimension);
  /// Scaled to unit length.
  void direction(const About &, Vec3 &);
  void text(const About &, std::string &, const std::string &expectation = "a text");
  void choice(const About &, std::string &, const std::vector<std::string> &choices);
  void names(const About &, std::vector<std::string> &, const NamesPattern & = NamesPattern());
  void source(const About &, std::string &kind, std::string &text);
  void history(const About &, History &);
  void range(const About &, double &low, double &high, units::Dimension);

  template <class Enum>
  using Words = std::initializer_list<std::pair<const char *, Enum>>;

  template <class Enum>
  void choice(const About &about, Enum &value, Words<Enum> words)
  {
    std::vector<std::string> choices;
    std::string              word;
    for (const auto &[name, v] : words)
    {
      choices.emplace_back(name);
      if (v == value)
        word = name;
    }
    entry(about, ChoicePattern(choices), word, [&](const std::string &chosen) {
      for (const auto &[name, v] : words)
        if (chosen == name)
          value = v;
    });
  }

protected:
  /// `present` is the value of the member as text, empty if it is not set;
  /// `assign` gives the member another one.
  virtual void entry(const About &, const Pattern &, const std::string &present, const Assign &assign) = 0;

  virtual void entered() {}
  virtual void left() {}

  std::string section() const;

  /// Whether the entry applies, by the values that `remember` was told.
  bool applies(const Use &) const;
  void remember(const std::string &name, const std::string &value) { values_[section()][name] = value; }

private:
  std::vector<std::string>                                  path_;
  std::map<std::string, std::map<std::string, std::string>> values_;
};
} // namespace ogive::input
