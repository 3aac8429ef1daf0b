// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/fields.h"
#include "core/input/listing.h"

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>
#include <vector>

namespace ogive::input
{
struct DeclaredEntry
{
  std::string section, name, preset, meaning;
  Need        need;
  Use         use;
  std::unique_ptr<dealii::Patterns::PatternBase> pattern;

  const Pattern &rule() const { return static_cast<const Pattern &>(*pattern); }
};

/// Declares every entry it is shown to a ParameterHandler.
class Declarations : public Fields
{
public:
  /// Strict pass: every subsection and entry of the listing must be declared,
  /// every value must match its pattern. Throws InputError with file and line
  /// for the first that does not; otherwise the handler holds all values.
  void admit(const Listing &);

  const std::vector<DeclaredEntry> &entries() const { return entries_; }
  const dealii::ParameterHandler   &handler() const { return handler_; }

protected:
  void entry(const About &, const Pattern &, const std::string &present, const Assign &) override;
  void entered() override;
  void left() override { handler_.leave_subsection(); }

private:
  void admit_section(const ListedSection &) const;
  void admit_entry(const ListedEntry &);
  [[noreturn]] void refuse_entry(const ListedEntry &) const;

  dealii::ParameterHandler   handler_;
  std::vector<DeclaredEntry> entries_;
  std::vector<std::string>   sections_{""};
};

/// Fills members from the values of a handler.
class Loader : public Fields
{
public:
  Loader(const dealii::ParameterHandler &handler, const Listing &listing)
    : handler_(handler)
    , listing_(listing)
  {}

protected:
  /// Throws InputError for a mandatory entry that is missing, and for one that
  /// is given where it does not apply.
  void entry(const About &, const Pattern &, const std::string &present, const Assign &) override;

private:
  const dealii::ParameterHandler &handler_;
  const Listing                  &listing_;
};

/// Writes members as a .prm text, every entry that applies and is set.
class Writer : public Fields
{
public:
  const std::string &text() const { return text_; }

protected:
  void entry(const About &, const Pattern &, const std::string &present, const Assign &) override;
  void entered() override;
  void left() override;

private:
  std::string indent() const { return std::string(2 * depth_, ' '); }

  std::string text_;
  std::size_t depth_ = 0;
};

/// Tables of all declared entries, subsection by subsection. Markdown.
std::string describe_entries(const Declarations &);

/// Collects the names of entries, "Strength/yield stress".
class Names : public Fields
{
public:
  const std::vector<std::string> &names() const { return names_; }

protected:
  void entry(const About &about, const Pattern &, const std::string &, const Assign &) override
  {
    names_.push_back(join_path(section(), about.name));
  }

private:
  std::vector<std::string> names_;
};
} // namespace ogive::input
