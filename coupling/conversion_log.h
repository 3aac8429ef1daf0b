// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/io/history_writer.h"
#include "coupling/conversion_cluster.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace ogive::coupling
{
/// conversions.csv: a row an event. Does nothing until begun or resumed.
class ConversionLog
{
public:
  void begin(const std::string &path);
  /// Goes on after the first `rows` rows (io::HistoryWriter::resume).
  void resume(const std::string &path, std::int64_t rows);

  void         write(std::span<const ConversionEvent>);
  std::int64_t rows() const { return writer_ ? writer_->rows() : 0; }

private:
  std::optional<io::HistoryWriter> writer_;
};
} // namespace ogive::coupling
