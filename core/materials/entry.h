// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/error.h"

#include <cmath>
#include <string>

/// How a law takes its numbers when it is built: a missing or impossible one is
/// an InputError that names the entry as it stands in a material file.
namespace ogive::materials
{
[[noreturn]] inline void reject(const char *entry, const std::string &wrong,
                                const std::string &expected)
{
  throw InputError(InputError::Where{"", 0, entry}, wrong, expected);
}

/// A finite number.
inline double given(double value, const char *entry, const char *needed_by)
{
  if (std::isnan(value))
    reject(entry, "is missing", std::string("a value, because ") + needed_by + " needs it");
  if (std::isinf(value))
    reject(entry, "is infinite", "a finite value");
  return value;
}

inline double positive(double value, const char *entry, const char *needed_by)
{
  if (given(value, entry, needed_by) <= 0)
    reject(entry, "is " + std::to_string(value), "a value > 0");
  return value;
}

inline double not_negative(double value, const char *entry, const char *needed_by)
{
  if (given(value, entry, needed_by) < 0)
    reject(entry, "is " + std::to_string(value), "a value >= 0");
  return value;
}

inline double fraction(double value, const char *entry, const char *needed_by)
{
  if (not_negative(value, entry, needed_by) > 1)
    reject(entry, "is " + std::to_string(value), "a value between 0 and 1");
  return value;
}
} // namespace ogive::materials
