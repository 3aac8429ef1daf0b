// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/declarations.h"
#include "core/input/quantities.h"
#include "core/input/reader.h"
#include "core/input/scene_fields.h"

namespace ogive::input
{
namespace
{
/// One of everything, so that every subsection is declared once.
Scene specimen()
{
  Scene s;
  s.materials.emplace_back().name  = "NAME";
  s.bodies.emplace_back().name     = "NAME";
  s.walls.emplace_back().name      = "NAME";
  s.boundaries.emplace_back().name = "NAME";
  s.interfaces.emplace_back().name = "NAME";
  s.contacts.emplace_back().name   = "NAME";
  Observer &o                      = s.observers.emplace_back();
  o.name                           = "NAME";
  o.quantity                       = "plastic_shock_speed";
  return s;
}

std::string describe_default(const DeclaredEntry &e)
{
  std::string s;
  if (e.need == Need::mandatory)
    s = "**mandatory**";
  else if (e.preset.empty() || e.preset == "NAME")
    s = "not set";
  else
    s = "`" + e.preset + "`";
  if (!e.use.entry.empty())
    s += e.use.values.empty() ? ", with " + e.use.entry : ", for " + e.use.entry + " " + join(e.use.values, " or ");
  return s;
}

/// A bar would end the cell.
std::string in_table(std::string text)
{
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2))
    text.insert(at, "\\");
  return text;
}

std::string quantity_table()
{
  std::string s = "\n## Quantities of observers\n\n| quantity | unit | parameter | meaning |\n|---|---|---|---|\n";
  for (const ObservedQuantity &q : observed_quantities())
    s += "| `" + std::string(q.name) + "` | " + summary_unit(q.dimension) + " | " +
         (q.needs_parameter ? summary_unit(q.parameter) : "") + " | " + q.meaning + " |\n";
  return s;
}
} // namespace

std::string describe_entries(const Declarations &declarations)
{
  std::string text, section = "-";
  for (const DeclaredEntry &e : declarations.entries())
  {
    // each value of a material may have a source: one line says so for all
    const bool source = e.section.ends_with("/Sources");
    if (e.section != section)
    {
      section = e.section;
      text += "\n## " + (section.empty() ? "At the top" : section) + "\n\n";
      if (source)
        text += "Where each value comes from, by its entry's name such as `Strength/yield stress`: " +
                e.rule().expectation() + ".\n";
      else
        text += "| entry | expects | default | meaning |\n|---|---|---|---|\n";
    }
    if (!source)
      text += "| `" + e.name + "` | " + in_table(e.rule().expectation()) + " | " + describe_default(e) + " | " +
              e.meaning + " |\n";
  }
  return text;
}

std::string reference()
{
  Scene        s = specimen();
  Declarations declarations;
  scene_fields(declarations, s, 1);
  return "# Entries of a scene\n\n"
         "Every value with a dimension carries its unit. NAME stands for a name of the list of that kind.\n"
         "An observer's `reference` and `parameter` have the dimension that its quantity asks for.\n" +
         describe_entries(declarations) + quantity_table();
}
} // namespace ogive::input
