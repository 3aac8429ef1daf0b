// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace ogive::io
{
/// Writes history.csv: a header such as "time [s],kinetic [J]" and rows of
/// numbers that read back to the bit. Each row is handed to the system at once.
/// Throws RunError when the disk refuses.
class HistoryWriter
{
public:
  struct Column
  {
    std::string name;
    std::string unit; ///< empty for a pure number, shown as "-"
  };

  /// Begins the file, replacing what is there.
  HistoryWriter(const std::string &path, std::vector<Column> columns);

  /// Goes on with the file after its first `n_rows` rows; later ones are
  /// dropped. Throws InputError if there are fewer, or for other columns.
  static HistoryWriter resume(const std::string &path, std::vector<Column> columns, std::int64_t n_rows);

  void row(std::span<const double> values);

  /// Rows written so far, without the header; a checkpoint keeps it for resume().
  std::int64_t rows() const { return rows_; }

private:
  HistoryWriter(const std::string &path, std::size_t n_columns, const std::string &text, std::int64_t n_rows);

  std::string   path_;
  std::size_t   n_columns_;
  std::int64_t  rows_;
  std::ofstream out_;
};
} // namespace ogive::io
