// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "apps/chart/outcome.h"
#include "apps/chart/rows.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ogive::chart
{
/// A study with what became of its rows.
struct Results
{
  const Study                &study;
  const std::vector<Row>     &rows;
  const std::vector<Outcome> &outcomes;
};

/// What a measure gives for one row; nothing where it has no value. A spread is
/// one of many rows: see spreads().
std::optional<double> measure(const Results &, std::size_t row, const Measure &);

/// Rows of a case that satisfy the condition, by index.
std::vector<std::size_t> rows_of(const Results &, const std::string &case_name, const Condition & = {});

/// Rows that differ along one axis alone, in the order of its levels.
std::vector<std::vector<std::size_t>> groups_along(const Results &, std::span<const std::size_t> rows,
                                                   const std::string &axis);

struct Spread
{
  std::size_t           rows = 0, with_value = 0;
  std::optional<double> least, greatest; ///< of the quantity
  std::optional<double> value() const;   ///< greatest - least; nothing for one row, or where a row has no value
};
Spread spread_of(const Results &, std::span<const std::size_t> rows, const std::string &quantity);

/// The axes along which the rows differ, in the study's order.
std::vector<std::string> varied_axes(const Results &, std::span<const std::size_t> rows);
} // namespace ogive::chart
