// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/parallel/ranks.h"

#include <string>
#include <vector>

/// The commands of `ogive`. Each throws InputError (exit status 2) or RunError
/// (exit status 1) and prints what the user asked for to standard output.
namespace ogive::apps
{
struct SceneArguments
{
  std::string              scene;     ///< a .prm or .json file
  std::vector<std::string> overrides; ///< "Section/entry=value"
};

struct CheckArguments : SceneArguments
{
  bool        certificate = false; ///< measure what the seams reflect
  std::string directory;           ///< of the certificate; empty: results/certificate-<scene>
  bool        force = false;
};

struct RunArguments : SceneArguments
{
  std::string directory; ///< empty: results/<scene>-<n>
  bool        force = false;
  int         ranks = 0; ///< 0: not asked for
};

struct RestartArguments
{
  std::string directory;
  std::string from;      ///< a checkpoint file; empty: the last one of the directory
  int         ranks = 0; ///< 0: not asked for
};

struct ChartArguments
{
  std::string study;     ///< a .prm or .json file
  std::string directory; ///< empty: results/chart-<study>
  int         jobs  = 0; ///< runs side by side; 0: as many as cores
  bool        force = false;
};

struct BenchArguments
{
  int    sph_edge = 40; ///< particles along an edge of the block
  int    fem_edge = 48; ///< elements along an edge of the block
  int    steps    = 20;
  std::string json; ///< file for the figures, empty for none
  std::string kept = "results/bench.json"; ///< results of before, to compare with
  bool        keep = false;                ///< adds this one to them
};

void check(const CheckArguments &);
/// On several ranks called by all; the first one prints.
void run(const RunArguments &, const Ranks & = {});
void restart(const RestartArguments &, const Ranks & = {});
void chart(const ChartArguments &);
void materials(const std::string &name);
void reference();
void bench(const BenchArguments &);
} // namespace ogive::apps
