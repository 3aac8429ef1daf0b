// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "tests/app/command.h"

#include <string>
#include <vector>

/// What a run on several ranks gives against one on a single rank.
namespace ogive::test
{
/// The numbers of a run: its quantities and checks by name, its history by column.
struct Numbers
{
  using Named = std::vector<std::pair<std::string, double>>;

  int                              ranks = 0;
  Named                            quantities, checks;
  std::vector<double>              scales; ///< of quantities: their size, 1 of those without a unit
  std::vector<std::string>         columns;
  std::vector<std::vector<double>> history; ///< by column
};

/// Reads summary.json and history.csv.
Numbers numbers_of(const std::string &directory);

/// A largest difference, and where it is.
struct Largest
{
  double      value = 0;
  std::string where;
  void        take(double difference, const std::string &name);
};

/// Relative differences: a quantity against its own size (1 without a unit), a column of the history
/// against its greatest magnitude, of energies against that of all of them, of
/// momenta too. What is infinite or not a number must be so in both, else the
/// difference is infinite. Drifts are relative already: their plain difference.
struct Difference
{
  Largest quantities, history, checks;
};
Difference difference(const Numbers &, const Numbers &reference);

/// Runs a shipped scene on so many ranks into a directory, 0: without -n.
Outcome run_on(int ranks, const std::string &scene, const std::vector<std::string> &settings,
               const std::string &directory);
} // namespace ogive::test
