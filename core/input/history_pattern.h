// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/history.h"
#include "core/input/patterns.h"

namespace ogive::input
{
/// A table of factors in time: "0 us: 0, 10 us: 1, 20 us: 1".
class HistoryPattern : public Pattern
{
public:
  Complaint                                      complaint(const std::string &) const override;
  std::string                                    expectation() const override;
  std::unique_ptr<dealii::Patterns::PatternBase> clone() const override;
};

/// Throws InputError (without a place) saying which entry of the table is wrong.
History     parse_history(const std::string &);
std::string format_history(const History &); ///< empty for a history without entries
} // namespace ogive::input
