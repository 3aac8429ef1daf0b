// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/run.h"

#include "core/base/error.h"
#include "core/io/field_writer.h"
#include "core/io/history_writer.h"
#include "core/parallel/together.h"
#include "coupling/certificate.h"
#include "coupling/conversion_log.h"
#include "coupling/model.h"
#include "coupling/run_report.h"
#include "coupling/run_support.h"
#include "coupling/stop.h"

#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>

namespace ogive::coupling
{
namespace
{
/// Steps between the states that a rejected step goes back to.
constexpr std::int64_t mark_interval = 16;
/// Steps between two looks for elements that must turn into particles: each
/// time some do, lists are built anew and a state is kept.
constexpr std::int64_t conversion_interval = 10;

template <int dim>
class Run
{
public:
  Run(const input::Scene &scene, const std::function<io::RunDirectory()> &open, const RunLabels &labels, Log &log,
      const Ranks &ranks)
    : scene_(scene)
    , labels_(labels)
    , log_(log)
    , ranks_(ranks)
    , control_(step_control(scene))
    , model_(scene, Setup(), ranks)
    , directory_(open())
    , traffic_(ranks)
    , clock_(scene.end_time, control_)
    , mark_clock_(clock_)
    , history_due_(scene.output.history_interval)
    , fields_due_(scene.output.field_interval)
    , checkpoint_due_(scene.output.checkpoint_interval)
    , stop_(scene)
    , report_(scene)
  {}

  void certified(std::vector<io::Summary::Certificate> all) { certificates_ = std::move(all); }

  void begin()
  {
    on_first(ranks_, [this] {
      history_.emplace(directory_.history(), report_.columns());
      fields_.emplace(directory_.path());
      if (model_.converts())
        conversions_.begin(directory_.conversions());
    });
    for (const std::string &note : model_.mesh_notes())
      log_.warn(note);
    for (const InitialOverlap &o : model_.initial_overlaps())
      log_.warn(o.describe());
    if (const double bare = model_.ledger().gradient_fallbacks; bare > 0)
      log_.warn(std::to_string(static_cast<int>(bare)) + " particles begin without a corrected gradient: a body, or a " +
                "part of one, is a single particle thick there; its elastic energy is not to be trusted. Take a smaller spacing");
    for (const auto &[body, share] : added_mass<dim>(scene_, model_))
      if (share > .05)
        log_.warn("mass scaling adds " + engineering(100 * share) + " % to the mass of \"" + body +
                  "\": more than 5 % moves results; take a shorter FEM/mass scaling step");
    history_due_.due(clock_);
    fields_due_.due(clock_);
    checkpoint_due_.due(clock_);
    write_row();
    write_fields();
    mark();
  }

  void resume(const io::Hdf5ArchiveReader &archive);

  io::Summary go()
  {
    while (!clock_.done() && !stop_.stop())
    {
      traffic_.begin();
      const StepLimit  limit  = model_.stable_dt();
      const TimeStep   step   = clock_.plan(limit);
      const StepStatus status = model_.step(step);
      traffic_.end();
      if (!status.ok)
      {
        reject(status.culprit);
        continue;
      }
      clock_.advance();
      report_.limited_by(limit);
      convert();
      if (const std::string note = model_.review(); !note.empty())
        log_.warn(note);
      watch(step);
    }
    return finish();
  }

private:
  void mark()
  {
    model_.snapshot();
    mark_clock_ = clock_;
    mark_step_  = clock_.step();
  }

  /// Back to the last mark, with half the step it began with.
  void reject(const Culprit &culprit)
  {
    model_.restore();
    clock_ = mark_clock_;
    clock_.plan(model_.stable_dt());
    clock_.shrink(culprit);
    mark_clock_ = clock_;
    log_.warn("step rejected at " + engineering(clock_.time()) + " s: " + describe(culprit, control_.bodies) +
              "; going on with a smaller step");
  }

  void convert()
  {
    if (clock_.step() % conversion_interval != 0)
      return;
    const std::vector<ConversionEvent> events = model_.convert(clock_.step(), clock_.time());
    on_first(ranks_, [&] { conversions_.write(events); });
    if (!events.empty()) // no way back past it
      mark();
  }

  void watch(const TimeStep &step)
  {
    const std::vector<double> wall = model_.wall_forces();
    const StepFrame           frame{clock_.time(), wall, model_.contact_force(), step.drift};
    stop_.every_step(frame);
    report_.every_step(frame);

    const bool row = history_due_.due(clock_), state = fields_due_.due(clock_), save = checkpoint_due_.due(clock_);
    if (row)
      write_row();
    if (state)
      write_fields();
    if (save)
      write_checkpoint();
    if (row || state || save || clock_.step() - mark_step_ >= mark_interval)
      mark();
  }

  /// Ranks all come here, as to all of what follows, and see the same: samples are
  /// of all of them, so observers, the rule to stop and the books decide alike.
  void write_row()
  {
    const LedgerRow ledger = model_.ledger();
    std::map<int, Sample> samples;
    RowFrame              frame{clock_.time(),
                   [&](int body) -> const Sample & {
                     const auto at = samples.find(body);
                     return at != samples.end() ? at->second : samples.emplace(body, model_.sample(body)).first->second;
                   },
                   ledger.kinetic, ledger.elastic, ledger.angular_momentum, ledger.viscosity_heat,
                   ledger.plastic_work};
    stop_.row(frame);
    const std::vector<double> values = report_.row(frame, clock_.step(), ledger);
    on_first(ranks_, [&] { history_->row(values); });
    row_step_ = clock_.step();
    log_.progress({clock_.time(), clock_.end_time(), start_time_, seconds(), clock_.step(), report_.limiter(),
                   report_.drift()});
    if (std::string fault = report_.fault(scene_.limits.energy_drift); !fault.empty())
      throw RunError("at " + engineering(clock_.time()) + " s: " + fault);
  }

  void write_fields()
  {
    std::vector<io::FieldBlock> blocks; // of the first rank
    const auto                  add = [&](const std::string &name, int body, const Sample &sample) {
      if (!ranks_.first())
        return;
      blocks.push_back(io::make_block(name, sample));
      blocks.back().body = body;
    };
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b)
    {
      const int         body     = static_cast<int>(b);
      const std::string name     = scene_.bodies[b].name;
      const bool        converts = scene_.bodies[b].method == input::Method::automatic;
      add(name, body, converts ? model_.mesh_sample(body) : model_.sample(body));
      if (converts)
        add(name + "-particles", body, model_.particle_sample(body));
    }
    on_first(ranks_, [&] { fields_->write(clock_.time(), blocks); });
    fields_step_ = clock_.step();
  }

  void write_checkpoint();
  io::Summary finish();

  double seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  }

  const input::Scene                   &scene_;
  const RunLabels                      &labels_;
  Log                                  &log_;
  Ranks                                 ranks_;
  StepControl                           control_;
  Model<dim>                            model_;
  io::RunDirectory                      directory_;
  TrafficMeter                          traffic_; ///< of the steps
  Clock                                 clock_, mark_clock_;
  Schedule                              history_due_, fields_due_, checkpoint_due_;
  StopWatch                             stop_;
  RunReport                             report_;
  std::optional<io::HistoryWriter>      history_; ///< of the first rank, like the next
  std::optional<io::FieldWriter>        fields_;
  std::vector<io::Summary::Certificate> certificates_;
  ConversionLog                         conversions_;
  std::int64_t                          mark_step_ = 0, row_step_ = -1, fields_step_ = -1, checkpoint_step_ = -1;
  double                                start_time_ = 0;
  std::chrono::steady_clock::time_point began_      = std::chrono::steady_clock::now();
};

template <int dim>
void Run<dim>::write_checkpoint()
{
  std::array<std::int64_t, 3> written{}; // by the first rank
  if (ranks_.first())
    written = {history_->rows(), static_cast<std::int64_t>(fields_->count()), conversions_.rows()};
  ranks_.broadcast(std::span<std::int64_t>(written), 0);

  io::Hdf5ArchiveWriter archive(directory_.checkpoint(clock_.step()), ranks_);
  archive.write_text("scene", labels_.resolved);
  archive.write_text("commit", labels_.commit);
  clock_.save(archive, "clock");
  history_due_.save(archive, "schedule/history");
  fields_due_.save(archive, "schedule/fields");
  checkpoint_due_.save(archive, "schedule/checkpoint");
  archive.write("rows", written[0]);
  archive.write("states", written[1]);
  archive.write("conversions", written[2]);
  archive.write("row_step", row_step_);
  archive.write("fields_step", fields_step_);
  stop_.save(archive, "stop");
  report_.save(archive, "report");
  model_.save(archive);
  archive.commit();
  checkpoint_step_ = clock_.step();
}

template <int dim>
void Run<dim>::resume(const io::Hdf5ArchiveReader &archive)
{
  clock_.load(archive, "clock");
  history_due_.load(archive, "schedule/history");
  fields_due_.load(archive, "schedule/fields");
  checkpoint_due_.load(archive, "schedule/checkpoint");
  row_step_    = archive.integer("row_step");
  fields_step_ = archive.integer("fields_step");
  stop_.load(archive, "stop");
  report_.load(archive, "report");
  model_.load(archive);
  on_first(ranks_, [&] {
    history_.emplace(io::HistoryWriter::resume(directory_.history(), report_.columns(), archive.integer("rows")));
    fields_.emplace(
      io::FieldWriter::resume(directory_.path(), static_cast<std::size_t>(archive.integer("states"))));
    if (model_.converts())
      conversions_.resume(directory_.conversions(), archive.integer("conversions"));
  });
  start_time_      = clock_.time();
  checkpoint_step_ = clock_.step();
  mark();
}

template <int dim>
io::Summary Run<dim>::finish()
{
  if (row_step_ != clock_.step())
    write_row();
  if (fields_step_ != clock_.step())
    write_fields();
  if (checkpoint_step_ != clock_.step())
    write_checkpoint();
  log_.finish();
  if (const std::int64_t lost = model_.lost_contacts(); lost > 0)
    log_.warn(std::to_string(lost) + " contacts went deeper than two facets and were given up: what their springs held "
                                     "is in contact_loss; a finer step or equal spacings of the two bodies may help");

  io::Summary summary                  = report_.summary();
  summary.checks.added_mass_fraction   = added_mass<dim>(scene_, model_);
  summary.version                      = labels_.version;
  summary.commit                       = labels_.commit;
  summary.wall_s                       = seconds();
  summary.ranks                        = ranks_.size();
  const double sph_seconds = model_.sph_seconds(), fem_seconds = model_.fem_seconds();
  summary.core_s                       = sph_seconds + fem_seconds;
  summary.steps                        = clock_.step();
  summary.end_time_s                   = clock_.time();
  summary.particles                    = static_cast<std::int64_t>(model_.particles());
  summary.elements                     = static_cast<std::int64_t>(model_.elements());
  summary.sph_particle_steps_per_core_s = rate(model_.particle_updates(), sph_seconds);
  summary.fem_element_steps_per_core_s  = rate(model_.element_updates(), fem_seconds);
  if (!ranks_.alone())
  {
    RankShare own = model_.share();
    traffic_.tell(own);
    own.memory = peak_memory();
    summary.shares = ranks_.gather_one(own);
  }
  if (const std::uint64_t updates = model_.element_updates(); updates > 0)
    summary.fem_share_skipped = double(model_.element_skips()) / double(updates);
  summary.certificates                 = certificates_;
  summary.warnings                     = log_.warnings();
  on_first(ranks_, [&] { io::write_summary(directory_.summary(), summary); });
  return summary;
}
} // namespace

io::Summary run_scene(const input::Scene &scene, const std::function<io::RunDirectory()> &open,
                      const RunLabels &labels, Log &log, const Ranks &ranks)
{
  std::vector<io::Summary::Certificate> certificates; // for the summary, which the first rank writes
  on_first(ranks, [&] { certificates = certify_before_run(scene, log); });
  return with_dimension(scene, [&]<int dim>() {
    Run<dim> run(scene, open, labels, log, ranks);
    run.certified(std::move(certificates));
    run.begin();
    return run.go();
  });
}

io::Summary restart_scene(const input::Scene &scene, const io::RunDirectory &directory,
                          const io::Hdf5ArchiveReader &checkpoint, const RunLabels &labels, Log &log,
                          const Ranks &ranks)
{
  return with_dimension(scene, [&]<int dim>() {
    Run<dim> run(scene, [&] { return directory; }, labels, log, ranks);
    run.resume(checkpoint);
    return run.go();
  });
}
} // namespace ogive::coupling
