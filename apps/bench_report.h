// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/machine_limits.h"

#include <string>
#include <vector>

namespace ogive::apps
{
/// What one core does of one thing, and what it costs at least.
struct Kernel
{
  std::string name;           ///< snake_case, stable: kept results are compared by it
  std::string unit;           ///< what is counted, e.g. "particle-steps"
  std::string what;           ///< settings, for people
  double      per_second = 0; ///< 1/s of processor time
  double      bytes = 0, operations = 0; ///< of one; 0: not counted

  double by_memory(const MachineLimits &) const;     ///< 1/s at most; infinite if not counted
  double by_arithmetic(const MachineLimits &) const; ///< the same
  /// Of the nearer limit; 0 if nothing is counted.
  double share_of_limit(const MachineLimits &) const;
};

/// One run of `ogive bench`.
struct BenchReport
{
  std::string         commit, processor;
  MachineLimits       limits;
  std::vector<Kernel> kernels;
  /// Other figures by name, such as bytes held a particle.
  std::vector<std::pair<std::string, double>> figures;
};

/// Text of the report, beside the last result of `kept` where there is one.
std::string describe(const BenchReport &, const std::vector<BenchReport> &kept);

std::string to_json(const BenchReport &);
/// Results that were kept in a file, oldest first; none if there is no file.
/// InputError if it is not such a file.
std::vector<BenchReport> read_kept(const std::string &path);
/// Adds a result to the file, which it makes if there is none.
void keep(const std::string &path, const BenchReport &);

/// Model name of the processor, as the system tells it.
std::string processor_name();
} // namespace ogive::apps
