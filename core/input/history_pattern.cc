// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/history_pattern.h"

#include "core/base/error.h"
#include "core/input/listing.h"

namespace ogive::input
{
History parse_history(const std::string &text)
{
  History     history;
  std::string previous;
  for (const std::string &row : split_list(text))
  {
    const std::size_t colon = row.find(':');
    if (row.empty())
      throw InputError("an empty entry stands between two commas");
    if (colon == std::string::npos)
      throw InputError("\"" + row + "\" has no \":\" between its time and its factor");
    const std::string when = trim(row.substr(0, colon)), what = trim(row.substr(colon + 1));
    if (when.empty() || what.empty())
      throw InputError("\"" + row + "\" lacks its " + (when.empty() ? "time" : "factor"));
    const double time = parse_scalar(when, units::time, bounds::not_negative);
    if (!history.time.empty() && !(time > history.time.back()))
      throw InputError("the times do not ascend: \"" + when + "\" follows \"" + previous + "\"");
    history.time.push_back(time);
    history.factor.push_back(parse_scalar(what, units::none));
    previous = when;
  }
  return history;
}

std::string format_history(const History &history)
{
  std::string text;
  for (std::size_t k = 0; k < history.time.size(); ++k)
    text += (k ? ", " : "") + units::format_quantity(history.time[k], units::time) + ": " +
            units::format_number(history.factor[k]);
  return text;
}

Pattern::Complaint HistoryPattern::complaint(const std::string &text) const
{
  return complaint_of([&] { parse_history(text); });
}

std::string HistoryPattern::expectation() const
{
  return "a table of \"TIME: FACTOR\" with ascending times, such as \"0 us: 0, 10 us: 1, 20 us: 1\"";
}

std::unique_ptr<dealii::Patterns::PatternBase> HistoryPattern::clone() const
{
  return std::make_unique<HistoryPattern>(*this);
}
} // namespace ogive::input
