// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/commands.h"
#include "apps/processes.h"
#include "commit.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <sstream>

namespace
{
void add_scene(CLI::App &command, ogive::apps::SceneArguments &a)
{
  command.add_option("SCENE", a.scene, "scene file (.prm or .json)")->required();
  command.add_option("--set", a.overrides, "\"Section/entry=value\", may be given several times");
}

void add_ranks(CLI::App &command, int &ranks)
{
  command.add_option("-n,--ranks", ranks, "processes, started by mpirun (1, or as many as mpirun has started)")
    ->check(CLI::Range(1, 1 << 20));
}
} // namespace

int main(int argc, char *argv[])
{
  using namespace ogive;

  CLI::App app("Ogive: impact simulation that couples smoothed particles with finite elements", "ogive");
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("ogive ") + OGIVE_VERSION + " (" + OGIVE_COMMIT + ")");

  apps::CheckArguments check_arguments;
  CLI::App *check = app.add_subcommand("check", "validate a scene and print the plan");
  add_scene(*check, check_arguments);
  CLI::Option *certificate =
    check->add_flag("--certificate", check_arguments.certificate, "measure what its seams reflect, at several wavelengths");
  check
    ->add_option("-o,--output", check_arguments.directory,
                 "directory of certificate.csv and certificate.svg (results/certificate-<scene>)")
    ->needs(certificate);
  check->add_flag("--force", check_arguments.force, "replace an earlier certificate in the directory")
    ->needs(certificate);

  apps::RunArguments run_arguments;
  CLI::App *run = app.add_subcommand("run", "run a scene");
  add_scene(*run, run_arguments);
  run->add_option("-o,--output", run_arguments.directory, "directory of the results (results/<scene>-<n>)");
  add_ranks(*run, run_arguments.ranks);
  run->add_flag("--force", run_arguments.force, "replace earlier results in the directory");

  apps::RestartArguments restart_arguments;
  CLI::App *restart = app.add_subcommand("restart", "continue a run from a checkpoint");
  restart->add_option("DIR", restart_arguments.directory, "directory of the results")->required();
  restart->add_option("--from", restart_arguments.from, "checkpoint file (the last one of DIR)");
  add_ranks(*restart, restart_arguments.ranks);

  apps::ChartArguments chart_arguments;
  CLI::App *chart = app.add_subcommand("chart", "run the variants of a study and draw accuracy against cost");
  chart->add_option("STUDY", chart_arguments.study, "study file (.prm or .json)")->required();
  chart->add_option("-o,--output", chart_arguments.directory, "directory of the results (results/chart-<study>)");
  chart->add_option("-j,--jobs", chart_arguments.jobs, "runs side by side (one a core)")->check(CLI::Range(1, 1024));
  chart->add_flag("--force", chart_arguments.force, "run every row again, replace other results in the directory");

  std::string material;
  CLI::App   *materials = app.add_subcommand("materials", "the library, with sources and valid ranges");
  materials->add_option("NAME", material, "one material in full");

  CLI::App *reference = app.add_subcommand("reference", "every entry of scenes and studies: unit, bounds, default, meaning");

  apps::BenchArguments bench_arguments;
  CLI::App *bench = app.add_subcommand("bench", "throughput per kernel on this machine");
  bench->add_option("--sph-edge", bench_arguments.sph_edge, "particles along an edge")->check(CLI::Range(8, 200));
  bench->add_option("--fem-edge", bench_arguments.fem_edge, "elements along an edge")->check(CLI::Range(4, 300));
  bench->add_option("--steps", bench_arguments.steps, "steps to time")->check(CLI::Range(2, 100000));
  bench->add_option("--json", bench_arguments.json, "write the figures to this file");
  bench->add_option("--kept", bench_arguments.kept, "file of kept results; the last one is compared with")
    ->capture_default_str();
  bench->add_flag("--keep", bench_arguments.keep, "add this result to the kept ones");

  const Ranks ranks = Ranks::world();
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError &e)
  {
    std::ostringstream unheard; // of all ranks but one
    const int          status = ranks.first() ? app.exit(e) : app.exit(e, unheard, unheard);
    return status == 0 ? apps::done : apps::bad_input;
  }

  const int wanted = std::max(run_arguments.ranks, restart_arguments.ranks);
  return apps::finish(ranks, [&]() -> int {
    if (wanted > 1 && !Ranks::started_together())
      return apps::start_ranks(wanted, argv);
    if (*run || *restart)
      apps::expect_ranks(ranks, wanted);
    else
      apps::expect_alone(ranks, app.get_subcommands().front()->get_name().c_str());
    if (*check)
      apps::check(check_arguments);
    else if (*run)
      apps::run(run_arguments, ranks);
    else if (*restart)
      apps::restart(restart_arguments, ranks);
    else if (*chart)
      apps::chart(chart_arguments);
    else if (*materials)
      apps::materials(material);
    else if (*reference)
      apps::reference();
    else if (*bench)
      apps::bench(bench_arguments);
    return apps::done;
  });
}
