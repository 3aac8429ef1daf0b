// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/ledger.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace ogive::coupling
{
namespace
{
/// Every column once: name, unit, and where it stands in a row. `Row` is
/// LedgerRow or const LedgerRow.
template <class Row, class F>
void for_each_column(Row &row, F &&f)
{
  f("kinetic [J]", row.kinetic);
  f("elastic [J]", row.elastic);
  f("plastic_work [J]", row.plastic_work);
  f("thermal [J]", row.thermal);
  f("viscosity_heat [J]", row.viscosity_heat);
  f("bulk_viscosity_heat [J]", row.bulk_viscosity_heat);
  f("hourglass_fem [J]", row.hourglass_fem);
  f("hourglass_sph [J]", row.hourglass_sph);
  f("contact [J]", row.contact);
  f("contact_loss [J]", row.contact_loss);
  f("friction [J]", row.friction);
  f("interface_work [J]", row.interface_work);
  f("conversion_heat [J]", row.conversion_heat);
  f("external_work [J]", row.external_work);
  f("absorbed [J]", row.absorbed);
  f("wall_loss [J]", row.wall_loss);
  f("eroded_energy [J]", row.eroded_energy);
  f("total [J]", row.total);
  f("drift [1]", row.drift);
  f("mass [kg]", row.mass);
  f("momentum_x [N s]", row.momentum[0]);
  f("momentum_y [N s]", row.momentum[1]);
  f("momentum_z [N s]", row.momentum[2]);
  f("angular_momentum_x [N m s]", row.angular_momentum[0]);
  f("angular_momentum_y [N m s]", row.angular_momentum[1]);
  f("angular_momentum_z [N m s]", row.angular_momentum[2]);
  f("external_impulse_x [N s]", row.external_impulse[0]);
  f("external_impulse_y [N s]", row.external_impulse[1]);
  f("external_impulse_z [N s]", row.external_impulse[2]);
  f("eroded_mass [kg]", row.eroded_mass);
  f("eroded_elements [1]", row.eroded_elements);
  f("gradient_fallbacks [1]", row.gradient_fallbacks);
}

double books(const Balance &b, double work_of_coupling)
{
  return b.kinetic + b.internal() + b.friction_heat + b.wall_loss + b.absorbed + b.eroded_energy - b.external_work -
         work_of_coupling;
}

double kept(const LedgerRow &row)
{
  return row.total - row.external_work;
}
} // namespace

std::vector<std::string> LedgerRow::columns()
{
  std::vector<std::string> names;
  const LedgerRow          row;
  for_each_column(row, [&](const char *name, double) { names.emplace_back(name); });
  return names;
}

std::vector<double> LedgerRow::values() const
{
  std::vector<double> numbers;
  for_each_column(*this, [&](const char *, double value) { numbers.push_back(value); });
  return numbers;
}

LedgerRow ledger_row(const Balance &fem, const Balance &sph, const CouplingBalance &coupling)
{
  Balance sum = fem;
  sum += sph;

  LedgerRow row;
  row.kinetic             = sum.kinetic;
  row.elastic             = sum.elastic;
  row.plastic_work        = sum.plastic_work;
  row.thermal             = sum.thermal;
  row.viscosity_heat      = sum.viscosity_heat;
  row.bulk_viscosity_heat = sum.bulk_viscosity_heat;
  row.hourglass_fem       = sum.hourglass_fem;
  row.hourglass_sph       = sum.hourglass_sph;
  row.contact             = coupling.contact_stored;
  row.contact_loss        = coupling.contact_loss;
  row.friction            = sum.friction_heat + coupling.friction_heat;
  row.interface_work      = coupling.interface_work;
  row.conversion_heat     = coupling.conversion_heat;
  row.external_work       = sum.external_work;
  row.absorbed            = sum.absorbed;
  row.wall_loss           = sum.wall_loss;
  row.eroded_energy       = sum.eroded_energy + coupling.contact_eroded;
  row.total = row.kinetic + row.internal() + row.contact + row.friction + row.conversion_heat + row.absorbed +
              row.wall_loss + row.eroded_energy;
  row.mass             = sum.mass + sum.eroded_mass;
  row.momentum         = sum.momentum + sum.eroded_momentum;
  row.angular_momentum = sum.angular_momentum + sum.eroded_angular_momentum;
  row.eroded_mass      = sum.eroded_mass;
  row.eroded_elements  = sum.eroded_elements;
  row.external_impulse = sum.external_impulse + coupling.plane_impulse;
  row.gradient_fallbacks = sum.gradient_fallbacks;
  row.mesh_books       = books(fem, coupling.work_on_mesh);
  row.particle_books   = books(sph, coupling.work_on_particles);
  return row;
}

void Ledger::enter(LedgerRow &row)
{
  if (!std::exchange(begun_, true))
    first_ = row;
  reference_ =
    std::max({reference_, row.kinetic, std::abs(row.internal()), std::abs(row.external_work)});
  row.drift = reference_ > 0 ? (kept(row) - kept(first_)) / reference_ : kept(row) - kept(first_);
  if (!(std::abs(row.drift) <= std::abs(worst_)))
    worst_ = row.drift;
  most_fallbacks_ = std::max(most_fallbacks_, row.gradient_fallbacks);
  last_           = row;
}

std::string Ledger::fault(double limit) const
{
  std::ostringstream message;
  std::string        unusable;
  for_each_column(last_, [&](const char *name, double value) {
    if (unusable.empty() && !std::isfinite(value))
      unusable = name;
  });
  if (!unusable.empty())
  {
    message << "the ledger's column " << unusable << " is not a number";
    return message.str();
  }
  if (std::abs(last_.drift) <= limit)
    return {};

  const std::pair<const char *, double> parts[] = {
    {"the elements (fem)", last_.mesh_books - first_.mesh_books},
    {"the particles (sph)", last_.particle_books - first_.particle_books},
    {"contact (contact_loss)", first_.contact_loss - last_.contact_loss},
    {"the interfaces (interface_work)", first_.interface_work - last_.interface_work}};
  const auto culprit = *std::max_element(std::begin(parts), std::end(parts), [](auto &a, auto &b) {
    return std::abs(a.second) < std::abs(b.second);
  });
  message << "energy drift " << 100 * last_.drift << " % passes the limit of " << 100 * limit
          << " %; the largest error is in " << culprit.first << ": " << culprit.second << " J of "
          << kept(last_) - kept(first_) << " J in all (reference energy " << reference_ << " J)";
  return message.str();
}

void Ledger::save(ArchiveWriter &archive, const std::string &prefix) const
{
  std::vector<double> numbers{begun_ ? 1. : 0., reference_, worst_, most_fallbacks_};
  for (const LedgerRow *row : {&first_, &last_})
  {
    const auto values = row->values();
    numbers.insert(numbers.end(), values.begin(), values.end());
    numbers.insert(numbers.end(), {row->mesh_books, row->particle_books});
  }
  archive.write(prefix + "/ledger", numbers);
}

void Ledger::load(const ArchiveReader &archive, const std::string &prefix)
{
  const auto numbers = archive.doubles(prefix + "/ledger");
  const auto width   = LedgerRow::columns().size() + 2;
  if (numbers.size() != 4 + 2 * width)
    throw InputError("the checkpoint's ledger has other columns than this version");
  begun_           = numbers[0] != 0;
  reference_       = numbers[1];
  worst_           = numbers[2];
  most_fallbacks_  = numbers[3];
  std::size_t next = 4;
  for (LedgerRow *row : {&first_, &last_})
  {
    for_each_column(*row, [&](const char *, double &value) { value = numbers[next++]; });
    row->mesh_books     = numbers[next++];
    row->particle_books = numbers[next++];
  }
}
} // namespace ogive::coupling
