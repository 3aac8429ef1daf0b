// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/quantities.h"
#include "core/input/scene_fields.h"

#include <cmath>

namespace ogive::input
{
void observer_fields(Fields &f, Observer &o)
{
  const ObservedQuantity *quantity = find_quantity(o.quantity);
  // an observer named as its quantity need not say so again
  f.choice({"quantity", "what it measures; by default the observer's name",
            quantity ? Need::optional : Need::mandatory},
           o.quantity, quantity_names());
  const bool             needs_body      = quantity && quantity->needs_body;
  const bool             needs_parameter = quantity && quantity->needs_parameter;
  const units::Dimension dimension       = quantity ? quantity->dimension : units::none;

  f.text({"body", "the body that it watches", needs_body ? Need::mandatory : Need::optional}, o.body,
         "the name of a body");
  f.direction({"direction", "axis along which it measures"}, o.direction);
  f.vector({"point", "place of a gauge, or where distances begin"}, o.point, units::length);
  if (needs_parameter)
    f.quantity({"parameter", "level of the quantity, see the list of quantities", Need::mandatory}, o.parameter,
               quantity->parameter, bounds::not_negative);

  double reference = o.has_reference ? o.reference : materials::none;
  f.quantity({"reference", "what the value is compared with"}, reference, dimension);
  o.has_reference = !std::isnan(reference);
  if (o.has_reference)
  {
    o.reference      = reference;
    o.reference_unit = summary_unit(dimension);
  }
  f.choice({"kind", "what the reference is worth", Need::mandatory, {"reference", {}}}, o.kind,
           {{"exact", ReferenceKind::exact},
            {"code", ReferenceKind::code},
            {"test", ReferenceKind::test},
            {"memory", ReferenceKind::memory}});
  f.text({"source", "where the reference comes from", Need::mandatory, {"reference", {}}}, o.source);
}
} // namespace ogive::input
