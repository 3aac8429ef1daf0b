// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/conversion_log.h"

#include <vector>

namespace ogive::coupling
{
namespace
{
/// "mass_before [kg]" in its two parts; a pure number has no unit.
std::vector<io::HistoryWriter::Column> columns()
{
  std::vector<io::HistoryWriter::Column> columns;
  for (const std::string &name : ConversionEvent::columns())
  {
    const std::size_t at   = name.find(" [");
    const std::string unit = name.substr(at + 2, name.size() - at - 3);
    columns.push_back({name.substr(0, at), unit == "-" ? "" : unit});
  }
  return columns;
}
} // namespace

void ConversionLog::begin(const std::string &path)
{
  writer_.emplace(path, columns());
}

void ConversionLog::resume(const std::string &path, std::int64_t rows)
{
  writer_.emplace(io::HistoryWriter::resume(path, columns(), rows));
}

void ConversionLog::write(std::span<const ConversionEvent> events)
{
  for (const ConversionEvent &event : events)
    if (writer_)
      writer_->row(event.values());
}
} // namespace ogive::coupling
