// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/commands.h"

#include "commit.h"

#include "core/base/error.h"
#include "core/base/log.h"
#include "core/input/reader.h"
#include "core/io/files.h"
#include "core/parallel/together.h"
#include "coupling/run.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <ostream>

namespace ogive::apps
{
namespace
{
/// Messages of the first rank; the others keep still.
struct Voice
{
  explicit Voice(const Ranks &ranks)
    : log(ranks.first() ? Log() : Log(nowhere, false))
  {}

  std::ostream nowhere{nullptr};
  Log          log;
};

void print_quantities(const io::Summary &summary)
{
  std::printf("\n%s\n", summary.title.c_str());
  if (!summary.quantities.empty())
    std::printf("  %-26s %14s %14s %10s  %s\n", "quantity", "value", "reference", "error", "unit, kind of reference");
  for (const io::Summary::Quantity &q : summary.quantities)
  {
    std::printf("  %-26s %14.6g", q.name.c_str(), q.value);
    if (q.reference)
      std::printf(" %14.6g", *q.reference);
    else
      std::printf(" %14s", "-");
    if (const auto error = q.relative_error())
      std::printf(" %+9.3f%%", 100 * *error);
    else
      std::printf(" %10s", "-");
    std::printf("  %s%s%s\n", q.unit.c_str(), q.kind.empty() ? "" : ", ", q.kind.c_str());
  }
}

void print_shares(const std::vector<RankShare> &shares)
{
  double messages = 0, bytes = 0, halo = 0, particles = 0;
  for (const RankShare &s : shares)
  {
    messages += s.messages / static_cast<double>(shares.size());
    bytes += s.bytes / static_cast<double>(shares.size());
    halo += static_cast<double>(s.halo_particles);
    particles += static_cast<double>(s.particles);
  }
  std::printf("  most over mean work of %zu ranks: particles %.3f, elements %.3f", shares.size(),
              imbalance(shares, [](auto &s) { return s.particle_work; }),
              imbalance(shares, [](auto &s) { return s.element_work; }));
  if (particles > 0)
    std::printf("; halo %.0f %% of the particles", 100 * halo / particles);
  std::printf("; a rank and step: %.1f messages, %.3g kB\n", messages, 1e-3 * bytes);
}

void print_checks(const io::Summary &summary)
{
  const io::Summary::Checks &c = summary.checks;
  std::printf("  drift: mass %.2e, momentum %.2e, energy %.2e", c.mass_drift, c.momentum_drift, c.energy_drift);
  if (std::isfinite(c.angular_momentum_drift)) // only free bodies have one
    std::printf(", angular momentum %.2e", c.angular_momentum_drift);
  std::printf("; hourglass/internal %.2e\n", c.hourglass_fraction);
  if (c.eroded_elements > 0)
    std::printf("  %.0f elements died, with %.3g %% of the mass\n", c.eroded_elements, 100 * c.eroded_mass_share);
  for (const auto &[body, share] : c.added_mass_fraction)
    std::printf("  mass scaling added %.3g %% to the mass of \"%s\"\n", 100 * share, body.c_str());
  if (c.gradient_fallbacks > 0)
    std::printf("  gradients of up to %.0f particles at once fell back to the uncorrected form\n", c.gradient_fallbacks);
  std::printf("  %lld steps to %.6g s, %lld particles, %lld elements, %.1f s wall, %.1f s in the solvers",
              static_cast<long long>(summary.steps), summary.end_time_s, static_cast<long long>(summary.particles),
              static_cast<long long>(summary.elements), summary.wall_s, summary.core_s);
  std::printf(summary.ranks > 1 ? " of all %d ranks\n" : "\n", summary.ranks);
  if (!summary.shares.empty())
    print_shares(summary.shares);
  if (summary.sph_particle_steps_per_core_s)
    std::printf("  particles: %.3g particle-steps/s\n", *summary.sph_particle_steps_per_core_s);
  if (summary.fem_element_steps_per_core_s)
    std::printf("  elements: %.3g element-steps/s, %.0f %% of them left out: nothing had reached the element\n",
                *summary.fem_element_steps_per_core_s, 100 * summary.fem_share_skipped.value_or(0));
  if (summary.limiter)
    std::printf("  the step was set by the %s of \"%s\" in %.0f %% of the steps (%s)\n",
                summary.limiter->entity.c_str(), summary.limiter->body.c_str(), 100 * summary.limiter->share,
                summary.limiter->why.c_str());
}

void print_files(const io::RunDirectory &directory)
{
  std::printf("  written to %s: summary.json, history.csv, results.xdmf (open in ParaView), resolved.prm, %s\n",
              directory.path().c_str(),
              std::filesystem::path(directory.last_checkpoint()).filename().string().c_str());
}

void print(const io::Summary &summary, const io::RunDirectory &directory)
{
  print_quantities(summary);
  print_checks(summary);
  print_files(directory);
}
} // namespace

void run(const RunArguments &a, const Ranks &ranks)
{
  std::optional<input::Scene> scene;
  agreed(ranks, [&] { scene = input::read_scene(a.scene, a.overrides); });
  const std::string resolved = input::write_resolved(*scene);
  const std::string path     = told_by_first(ranks, [&] {
    return a.directory.empty() ? io::RunDirectory::default_name(scene->name) : a.directory;
  });
  const auto        open     = [&] {
    on_first(ranks, [&] {
      const io::RunDirectory directory = io::RunDirectory::create(path, a.force);
      io::write_whole(directory.resolved_scene(), resolved);
    });
    return io::RunDirectory::made(path);
  };
  Voice voice(ranks);
  try
  {
    const io::Summary summary =
      coupling::run_scene(*scene, open, {resolved, OGIVE_VERSION, OGIVE_COMMIT}, voice.log, ranks);
    if (ranks.first())
      print(summary, io::RunDirectory::open(path));
  }
  catch (const InputError &e)
  {
    // the directory's own complaints speak of no entry
    if (e.where().entry.empty())
      throw;
    input::rethrow_in_scene(a.scene, e);
  }
}

namespace
{
/// Makes sure that a run goes on with the scene that it began with.
void match_scenes(const io::RunDirectory &directory, const std::string &file, const std::string &resolved)
{
  if (!std::filesystem::exists(directory.resolved_scene()))
    io::write_whole(directory.resolved_scene(), resolved);
  if (io::read_whole(directory.resolved_scene()) != resolved)
    throw InputError(directory.resolved_scene() + ": differs from the scene in " + file +
                     "; a run goes on with the scene it began with: remove the file, or start a new run from it");
}
} // namespace

void restart(const RestartArguments &a, const Ranks &ranks)
{
  std::optional<io::RunDirectory>        directory;
  std::optional<io::Hdf5ArchiveReader>   checkpoint;
  std::string                            file, resolved;
  agreed(ranks, [&] {
    directory = io::RunDirectory::open(a.directory);
    file      = a.from.empty() ? directory->last_checkpoint() : a.from;
    checkpoint.emplace(file);
    resolved = checkpoint->text("scene");
  });
  on_first(ranks, [&] { match_scenes(*directory, file, resolved); });

  std::optional<input::Scene> scene;
  agreed(ranks, [&] { scene = input::read_scene(directory->resolved_scene()); });
  Voice voice(ranks);
  if (checkpoint->text("commit") != OGIVE_COMMIT)
    voice.log.warn("the checkpoint was written by commit " + checkpoint->text("commit") + ", this is " + OGIVE_COMMIT +
                   ": the rest need not be equal to the bit");
  const io::Summary summary = coupling::restart_scene(*scene, *directory, *checkpoint,
                                                      {resolved, OGIVE_VERSION, OGIVE_COMMIT}, voice.log, ranks);
  if (ranks.first())
    print(summary, *directory);
}
} // namespace ogive::apps
