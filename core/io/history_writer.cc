// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/history_writer.h"

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/number_text.h"

namespace ogive::io
{
namespace
{
std::string header(const std::vector<HistoryWriter::Column> &columns)
{
  std::string line;
  for (const auto &column : columns)
    {
      require(column.name.find_first_of(",\"\n[") == std::string::npos, "a column's name is one plain word");
      line += (line.empty() ? "" : ",") + column.name + " [" + (column.unit.empty() ? "-" : column.unit) + "]";
    }
  return line + "\n";
}
} // namespace

HistoryWriter::HistoryWriter(const std::string &path, std::size_t n_columns, const std::string &text,
                             std::int64_t n_rows)
  : path_(path)
  , n_columns_(n_columns)
  , rows_(n_rows)
{
  write_whole(path, text);
  out_.open(path, std::ios::binary | std::ios::app);
  if (!out_)
    throw RunError(path + ": cannot be written");
}

HistoryWriter::HistoryWriter(const std::string &path, std::vector<Column> columns)
  : HistoryWriter(path, columns.size(), header(columns), 0)
{}

HistoryWriter HistoryWriter::resume(const std::string &path, std::vector<Column> columns, std::int64_t n_rows)
{
  const std::string text = read_whole(path);
  const std::string head = header(columns);
  if (!text.starts_with(head))
    throw InputError({.file = path, .line = 1, .entry = {}}, "other columns than this run writes",
                     head.substr(0, head.size() - 1), "restart it with the program that wrote it");
  std::size_t end = head.size();
  for (std::int64_t i = 0; i < n_rows; ++i)
    {
      const std::size_t line_end = text.find('\n', end);
      if (line_end == std::string::npos)
        throw InputError({.file = path, .line = 0, .entry = {}}, "holds " + std::to_string(i) + " rows",
                         "the " + std::to_string(n_rows) + " that the checkpoint counts");
      end = line_end + 1;
    }
  return {path, columns.size(), text.substr(0, end), n_rows};
}

void HistoryWriter::row(std::span<const double> values)
{
  require(values.size() == n_columns_, "a row has one value a column");
  std::string line;
  for (const double value : values)
    line += (line.empty() ? "" : ",") + number_text(value);
  out_ << line << '\n' << std::flush;
  if (!out_)
    throw RunError(path_ + ": cannot be written; is the disk full?");
  ++rows_;
}
} // namespace ogive::io
