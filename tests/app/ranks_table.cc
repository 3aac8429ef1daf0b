// SPDX-License-Identifier: LGPL-2.1-or-later
// Tables of runs on ranks, as docs/ranks.md shows them:
//   ranks_table same [SECONDS [SCENE...]]   every shipped scene on 1, 2, 3, 4 and 7 ranks
//   ranks_table balance [RANKS...]          how ranks share the coupled plate
// Ends with status 1 if a run fails, or if one on ranks differs by more than 1e-9
// from the one on a single rank.
#include "tests/app/ranks_compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

using namespace ogive::test;
namespace fs = std::filesystem;

namespace
{
constexpr double same       = 1e-9;
const int        fewest     = 20; ///< steps
const int        counts[]   = {2, 3, 4, 7};
bool             all_is_well = true;

std::vector<std::string> shipped()
{
  std::vector<std::string> scenes;
  for (const auto &entry : fs::recursive_directory_iterator(scene("")))
    if (entry.path().extension() == ".prm")
      scenes.push_back(fs::relative(entry.path(), scene("")).string());
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

/// The line "to the end T s: about N steps, ... (S s a step" of a plan.
struct Course
{
  double end = 0, steps = 0, seconds_per_step = 0;
};
Course course_of(const std::string &name)
{
  const Outcome     check = ogive::test::ogive({"check", scene(name)});
  const std::size_t at    = check.out.find("to the end ");
  Course            c;
  double            total = 0;
  if (check.status != 0 || at == std::string::npos ||
      std::sscanf(check.out.c_str() + at, "to the end %lf s: about %lf steps, %lf s of processor time (%lf s", &c.end,
                  &c.steps, &total, &c.seconds_per_step) != 4)
    std::fprintf(stderr, "%s: no plan: %s\n", name.c_str(), check.err.c_str());
  return c;
}

std::string short_text(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, value == 0 ? "0" : "%.1e", value);
  return text;
}

double most(const Difference &d)
{
  return std::max({d.quantities.value, d.history.value, d.checks.value});
}

/// What differs most, if anything does.
std::string place(const Difference &d)
{
  for (const Largest *l : {&d.quantities, &d.history, &d.checks})
    if (l->value > 0 && l->value == most(d))
      return l->where;
  return {};
}

double check_of(const Numbers &n, const std::string &name)
{
  for (const auto &[each, value] : n.checks)
    if (each == name)
      return std::isfinite(value) ? std::abs(value) : 0.;
  return 0;
}

void compare(const std::string &name, double seconds)
{
  const Course c     = course_of(name);
  const double steps = std::min(c.steps, std::max<double>(fewest, seconds / std::max(c.seconds_per_step, 1e-6)));
  if (!(steps > 0))
  {
    all_is_well = false;
    return;
  }
  const std::vector<std::string> settings = {"end time=" + std::to_string(1e9 * c.end * steps / c.steps) + " ns"};
  const Scratch                  scratch;
  std::string                    row = "| `" + name + "` | " + std::to_string(std::lround(steps)) + " |";
  const Outcome                  alone = run_on(0, name, settings, scratch.path("1"));
  if (alone.status != 0)
  {
    std::printf("%s failed alone: %s\n", row.c_str(), alone.err.c_str());
    all_is_well = false;
    return;
  }
  const Numbers reference = numbers_of(scratch.path("1"));
  std::string   where;
  double        worst = 0, mass = check_of(reference, "mass_drift"), momentum = check_of(reference, "momentum_drift");
  for (const int n : counts)
  {
    const Outcome run = run_on(n, name, settings, scratch.path(std::to_string(n)));
    if (run.status != 0)
    {
      row += " failed |";
      std::fprintf(stderr, "%s on %d: %s\n", name.c_str(), n, run.err.c_str());
      all_is_well = false;
      continue;
    }
    const Numbers    numbers = numbers_of(scratch.path(std::to_string(n)));
    const Difference d       = difference(numbers, reference);
    row += " " + short_text(most(d)) + " |";
    mass     = std::max(mass, check_of(numbers, "mass_drift"));
    momentum = std::max(momentum, check_of(numbers, "momentum_drift"));
    if (most(d) > worst)
    {
      worst = most(d);
      where = place(d);
    }
  }
  all_is_well = all_is_well && worst <= same;
  std::printf("%s %s | %s | %s |\n", row.c_str(), where.c_str(), short_text(mass).c_str(), short_text(momentum).c_str());
  std::fflush(stdout);
}

void same_answers(double seconds, const std::vector<std::string> &scenes)
{
  std::printf("| scene | steps | 2 | 3 | 4 | 7 | most in | mass drift | momentum drift |\n"
              "|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string &name : scenes)
    compare(name, seconds);
}

struct Spread
{
  double mean = 0, most = 0;
};
Spread spread(const nlohmann::json &ranks, const char *name)
{
  Spread s;
  for (const auto &rank : ranks)
  {
    const double v = rank.at(name).get<double>();
    s.mean += v / static_cast<double>(ranks.size());
    s.most = std::max(s.most, v);
  }
  return s;
}

/// Particles around a cube of so many, as deep as the pairs reach: twice 1.3 spacings
/// and a skin, three layers.
double ideal_halo(double particles)
{
  return std::pow(std::cbrt(particles) + 6, 3) - particles;
}

void balance(const std::vector<int> &ranks)
{
  std::printf("| ranks | particles, mean | work of particles, most/mean | elements, mean | work of elements, most/mean | "
              "halo, mean | of a cube | messages | kB | joint operations |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const int n : ranks)
  {
    const Scratch scratch;
    const Outcome run = run_on(n, "plate-weldox-blunt/scene.prm", {"end time=6 us", "Parallel/interval=20"}, scratch.path("r"));
    if (run.status != 0)
    {
      std::printf("| %d | failed: %s\n", n, run.err.c_str());
      all_is_well = false;
      continue;
    }
    const auto   all       = summary(scratch.path("r")).at("parallel");
    const auto  &each      = all.at("ranks");
    const double particles = spread(each, "particles").mean;
    std::printf("| %d | %.0f | %.3f | %.0f | %.3f | %.0f | %.0f | %.1f | %.1f | %.1f |\n", n, particles,
                all.at("imbalance").at("particle_work").get<double>(), spread(each, "elements").mean,
                all.at("imbalance").at("element_work").get<double>(), spread(each, "halo_particles").mean,
                ideal_halo(particles), spread(each, "messages_per_step").mean, 1e-3 * spread(each, "bytes_per_step").mean,
                spread(each, "joint_operations_per_step").mean);
    std::fflush(stdout);
  }
}
} // namespace

int main(int argc, char *argv[])
{
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (!words.empty() && words[0] == "same")
    same_answers(words.size() > 1 ? std::atof(words[1].c_str()) : .5,
                 words.size() > 2 ? std::vector<std::string>(words.begin() + 2, words.end()) : shipped());
  else if (!words.empty() && words[0] == "balance")
  {
    std::vector<int> ranks;
    for (std::size_t k = 1; k < words.size(); ++k)
      ranks.push_back(std::atoi(words[k].c_str()));
    balance(ranks.empty() ? std::vector<int>{8, 16, 32} : ranks);
  }
  else
  {
    std::fprintf(stderr, "usage: ranks_table same [SECONDS [SCENE...]] | ranks_table balance [RANKS...]\n");
    return 2;
  }
  return all_is_well ? 0 : 1;
}
