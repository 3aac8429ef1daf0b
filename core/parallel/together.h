// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/parallel/ranks.h"

#include <functional>
#include <string>

/// What ranks do about errors: one that all must know of is met by all, one that
/// a rank meets alone ends the others too. For a process alone all of this is a
/// plain call.
namespace ogive
{
/// Calls f on all ranks, which says nothing to the others, or the same whether it
/// fails or not. If it throws on any, all throw: each its own exception, those
/// without one that of the lowest rank that has one. An InputError stays an
/// InputError, anything else becomes a RunError.
void agreed(const Ranks &, const std::function<void()> &f);

/// Calls f on the first rank alone, for what one process must do for all, such as
/// writing a file. What it throws is thrown on all.
void on_first(const Ranks &, const std::function<void()> &f);

/// The text that f gives on the first rank, on all.
std::string told_by_first(const Ranks &, const std::function<std::string()> &f);

/// How a program ends.
struct Ending
{
  int         status = 0;
  std::string message; ///< to be printed by this rank; empty: another one does
};

/// Called by a rank whose program cannot go on, with what it would end with. If
/// all ranks come here within `patience_s` of wall time, they end alike: with the
/// common status, or with `failed` where they differ, and the first rank has the
/// message; different ones are told with their ranks. Otherwise this rank is in
/// trouble while others work or wait: it prints the message with its number and
/// ends all of them with `failed`; it does not return.
Ending end_together(const Ranks &, const Ending &own, int failed, double patience_s);
} // namespace ogive
