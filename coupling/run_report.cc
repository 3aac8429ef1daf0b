// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/run_report.h"

#include "core/base/log.h"
#include "core/input/quantities.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ogive::coupling
{
namespace
{
const char *word(input::ReferenceKind kind)
{
  switch (kind)
  {
    case input::ReferenceKind::exact:
      return "exact";
    case input::ReferenceKind::code:
      return "code";
    case input::ReferenceKind::test:
      return "test";
    default:
      return "memory";
  }
}

const char *word(input::Dimension dimension)
{
  switch (dimension)
  {
    case input::Dimension::uniaxial:
      return "uniaxial";
    case input::Dimension::plane_strain:
      return "plane-strain";
    case input::Dimension::axisymmetric:
      return "axisymmetric";
    default:
      return "3d";
  }
}

std::string unit_of(const input::Observer &o)
{
  return input::summary_unit(input::find_quantity(o.quantity)->dimension);
}

/// A length of the order of the scene's bodies, m.
double extent(const input::Scene &scene)
{
  double length = 0;
  for (const input::Body &b : scene.bodies)
    length = std::max({length, (b.shape.upper - b.shape.lower).norm(), b.shape.radius, b.shape.length});
  return length;
}

/// "kinetic [J]" in its two parts.
io::HistoryWriter::Column split(const std::string &column)
{
  const std::size_t at = column.find(" [");
  return {column.substr(0, at), column.substr(at + 2, column.size() - at - 3)};
}
} // namespace

RunReport::RunReport(const input::Scene &scene)
  : scene_(scene)
{
  for (const input::Observer &o : scene.observers)
    observers_.push_back(make_observer(o, scene));
}

std::vector<io::HistoryWriter::Column> RunReport::columns() const
{
  std::vector<io::HistoryWriter::Column> columns = {{"time", "s"}, {"step", ""}};
  for (const std::string &name : LedgerRow::columns())
    columns.push_back(split(name));
  for (const input::Observer &o : scene_.observers)
    columns.push_back({o.name, unit_of(o)});
  return columns;
}

void RunReport::every_step(const StepFrame &frame)
{
  for (const auto &observer : observers_)
    observer->every_step(frame);
}

void RunReport::limited_by(const StepLimit &limit)
{
  Limited &who = limited_[{limit.culprit.entity, limit.culprit.body}];
  ++who.steps;
  who.last = limit_ = limit;
  ++limited_steps_;
}

std::vector<double> RunReport::row(const RowFrame &frame, std::int64_t step, LedgerRow ledger)
{
  books_.enter(ledger);
  std::vector<double> values  = {frame.time, static_cast<double>(step)};
  const auto          numbers = ledger.values();
  values.insert(values.end(), numbers.begin(), numbers.end());
  for (const auto &observer : observers_)
  {
    observer->row(frame);
    values.push_back(observer->value());
  }
  return values;
}

std::string RunReport::limiter() const
{
  const int body = limit_.culprit.body;
  return std::string(limit_.culprit.entity) + " " + std::to_string(limit_.culprit.id) +
         (body < 0 ? std::string() : " of " + scene_.bodies[static_cast<std::size_t>(body)].name);
}

io::Summary::Checks RunReport::checks() const
{
  const LedgerRow    &first = books_.first(), &last = books_.last();
  io::Summary::Checks checks;
  checks.mass_drift         = (last.mass - first.mass) / first.mass;
  checks.energy_drift       = books_.drift();
  checks.hourglass_fraction = last.internal() > 0 ? (last.hourglass_fem + last.hourglass_sph) / last.internal() : 0.;
  checks.eroded_elements    = last.eroded_elements;
  checks.eroded_mass_share  = last.eroded_mass / first.mass;
  checks.gradient_fallbacks = books_.most_fallbacks();

  // measured against the momentum that the greatest energy of the run could carry
  const double scale    = std::sqrt(2 * first.mass * books_.reference());
  const Vec3   change   = last.momentum - last.external_impulse - (first.momentum - first.external_impulse);
  checks.momentum_drift = scale > 0 ? change.norm() / scale : change.norm();

  // walls, boundaries and symmetry planes give couples that no book holds
  const bool   free = scene_.walls.empty() && scene_.boundaries.empty() && scene_.symmetry.empty();
  const double spin = first.angular_momentum.norm();
  checks.angular_momentum_drift = free && spin > 1e-9 * scale * extent(scene_) ? (last.angular_momentum - first.angular_momentum).norm() / spin :
                                                     std::numeric_limits<double>::quiet_NaN();
  return checks;
}

io::Summary RunReport::summary() const
{
  io::Summary summary;
  summary.scene     = scene_.name;
  summary.title     = scene_.title;
  summary.dimension = word(scene_.dimension);
  summary.checks    = checks();
  for (std::size_t k = 0; k < observers_.size(); ++k)
  {
    const input::Observer &o = scene_.observers[k];
    io::Summary::Quantity  q{o.name, observers_[k]->value(), unit_of(o), {}, {}, {}};
    if (o.has_reference)
    {
      q.reference = o.reference;
      q.source    = o.source;
      q.kind      = word(o.kind);
    }
    summary.quantities.push_back(q);
  }
  const std::vector<std::string> names  = LedgerRow::columns();
  const std::vector<double>      values = books_.last().values();
  for (std::size_t k = 0; k < names.size(); ++k)
    if (const auto column = split(names[k]); column.unit == "J")
      summary.ledger.emplace_back(column.name, values[k]);

  const auto most = std::max_element(limited_.begin(), limited_.end(),
                                     [](auto &a, auto &b) { return a.second.steps < b.second.steps; });
  if (most != limited_.end())
  {
    const Culprit &c = most->second.last.culprit;
    summary.limiter  = {c.entity,
                        c.body < 0 ? std::string() : scene_.bodies[static_cast<std::size_t>(c.body)].name,
                        c.why,
                        c.id,
                        {c.where.x(), c.where.y(), c.where.z()},
                        most->second.last.dt,
                        static_cast<double>(most->second.steps) / static_cast<double>(limited_steps_)};
  }
  return summary;
}

void RunReport::save(ArchiveWriter &archive, const std::string &prefix) const
{
  books_.save(archive, prefix + "/books");
  for (std::size_t k = 0; k < observers_.size(); ++k)
    observers_[k]->save(archive, prefix + "/observer/" + scene_.observers[k].name);
}

void RunReport::load(const ArchiveReader &archive, const std::string &prefix)
{
  books_.load(archive, prefix + "/books");
  for (std::size_t k = 0; k < observers_.size(); ++k)
    observers_[k]->load(archive, prefix + "/observer/" + scene_.observers[k].name);
}

std::optional<double> rate(std::uint64_t work, double seconds)
{
  if (work == 0 || seconds <= 0)
    return {};
  return static_cast<double>(work) / seconds;
}
} // namespace ogive::coupling
