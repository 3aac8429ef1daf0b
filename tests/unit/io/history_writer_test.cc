// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/history_writer.h"

#include "core/base/error.h"
#include "tests/unit/io/scratch.h"

#include <bit>
#include <random>

namespace
{
using namespace ogive;
using io::HistoryWriter;
using ogive::test::bytes_of;
using ogive::test::expect_parts;
using ogive::test::message_of;

using History = ogive::test::Scratch;

const std::vector<HistoryWriter::Column> columns{{"time", "s"}, {"kinetic", "J"}, {"contacts", ""}};

std::vector<double> row(int i)
{
  return {1e-8 * i, 3.21 / (1 + i), static_cast<double>(i % 7)};
}

TEST_F(History, HasUnitsAndReadsBackToTheBit)
{
  std::mt19937_64 random(5);
  HistoryWriter   history(in("history.csv"), columns);
  std::vector<double> written;
  for (int i = 0; i < 300; ++i)
    {
      double value = std::bit_cast<double>(random());
      if (value != value)
        value = .1 * i;
      written.push_back(value);
      history.row(std::vector<double>{1e-7 * i, value, 0});
    }
  // Read while the writer is still open: each row is out at once.
  std::istringstream text(bytes_of(in("history.csv")));
  std::string        line;
  std::getline(text, line);
  EXPECT_EQ(line, "time [s],kinetic [J],contacts [-]");
  for (const double value : written)
    {
      std::getline(text, line, ',');
      std::getline(text, line, ',');
      EXPECT_EQ(std::bit_cast<std::uint64_t>(std::strtod(line.c_str(), nullptr)), std::bit_cast<std::uint64_t>(value));
      std::getline(text, line);
    }
  EXPECT_EQ(history.rows(), 300);
}

TEST_F(History, ARestartedFileEqualsTheUnbrokenOne)
{
  const std::string whole = in("whole.csv"), broken = in("broken.csv");
  {
    HistoryWriter a(whole, columns), b(broken, columns);
    for (int i = 0; i < 20; ++i)
      a.row(row(i));
    for (int i = 0; i < 13; ++i)
      b.row(row(i));
  }
  // Killed in the middle of a row, long after the checkpoint at row 8.
  std::ofstream(broken, std::ios::app) << "1.3e-07,.2";
  HistoryWriter b = HistoryWriter::resume(broken, columns, 8);
  EXPECT_EQ(b.rows(), 8);
  for (int i = 8; i < 20; ++i)
    b.row(row(i));
  EXPECT_EQ(bytes_of(whole), bytes_of(broken));
}

TEST_F(History, RefusesAFileThatDoesNotFit)
{
  {
    HistoryWriter history(in("h.csv"), columns);
    history.row(row(0));
  }
  const std::string before = bytes_of(in("h.csv"));
  expect_parts(message_of<InputError>([&] { HistoryWriter::resume(in("h.csv"), columns, 2); }), {"h.csv", "1 rows", "expected the 2"});
  expect_parts(message_of<InputError>([&] { HistoryWriter::resume(in("h.csv"), {{"time", "s"}}, 1); }), {"h.csv:1", "expected time [s]"});
  expect_parts(message_of<InputError>([&] { HistoryWriter::resume(in("none.csv"), columns, 0); }), {"none.csv"});
  EXPECT_EQ(bytes_of(in("h.csv")), before);
}

TEST_F(History, ARowOfAnotherWidthIsAMistake)
{
  HistoryWriter history(in("h.csv"), columns);
  EXPECT_THROW(history.row(std::vector<double>{1, 2}), std::logic_error);
}
} // namespace
