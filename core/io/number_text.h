// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace ogive::io
{
/// The shortest text that reads back as the same number, to the bit.
inline std::string number_text(double value)
{
  std::array<char, 32> text;
  const auto           end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}
} // namespace ogive::io
