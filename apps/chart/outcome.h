// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "apps/chart/study.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ogive::chart
{
enum class Status
{
  done,
  failed,
  too_long
};
const char *describe(Status);

/// What became of a row.
struct Outcome
{
  struct Quantity
  {
    std::string           name, unit, kind;
    std::optional<double> value, reference;
    std::string           source = {};
  };
  struct Check
  {
    std::string           name;
    std::optional<double> value;
  };

  Status                status = Status::failed;
  std::string           reason; ///< why it is not done
  double                wall_s  = 0;
  std::optional<double> core_s;
  std::int64_t          steps = 0, particles = 0, elements = 0;
  std::vector<Quantity> quantities;
  std::vector<Check>    checks;

  const Quantity       *find(const std::string &quantity) const;
  std::optional<double> check(const std::string &name) const;
  std::optional<double> work() const; ///< particle-steps and element-steps; nothing unless done
};

/// Fills in what summary.json says. Throws InputError if it cannot be read.
void read_summary(const std::string &file, Outcome &);

/// The commit that summary.json names.
std::string commit_of_summary(const std::string &file);

/// A quantity or check of a case in one outcome; nothing unless it is there.
std::optional<double> value_of(const Outcome &, const std::string &name);
/// The reference that the case gives, else that of the scene.
std::optional<double> reference_of(const Case &, const Outcome &, const std::string &name);
/// (value - reference)/|reference|; nothing without either, or if the reference is 0.
std::optional<double> error_of(const Case &, const Outcome &, const std::string &name);
/// SI unit, "1" for a pure number.
std::string unit_of(const Case &, const std::string &name);

/// Whether the row is done and within all bounds of the case, and if not, why.
struct Verdict
{
  bool        survived = true;
  std::string why    = {};
  std::string broken = {}; ///< the quantity whose bound it breaks, if that is why
};
Verdict judge(const Case &, const Outcome &);
} // namespace ogive::chart
