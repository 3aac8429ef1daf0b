// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "core/base/log.h"
#include "coupling/model.h"
#include "coupling/stopwatch.h"

#include <algorithm>
#include <cmath>

/// The step of a model, whole or in parts.
namespace ogive::coupling
{
template <int dim>
void Model<dim>::begin_parts(const input::Scene &scene)
{
  input::Subcycling chosen = scene.subcycling;
  if (chosen.who == "auto" && !(fem_ && sph_))
    chosen.who = "none";
  if (fem_ && sph_)
    chosen = Subcycling::settled(chosen, fem_->stable_dt().dt, sph_->stable_dt().dt,
                                 !conversion_ && !fem_->steps_locally());
  subcycling_ = Subcycling(chosen, fem_ && sph_);
  parts_limit_ = scene.subcycling.energy_limit;
  if (subcycling_.on() || (fem_ && fem_->steps_locally()))
    parts_reference_ = local_reference_ = ledger().kinetic;
  if (subcycling_.mesh_is_coarse())
  {
    // What a node still has to get from its elements would leave with them.
    if (conversion_)
      throw InputError({"", 0, "Subcycling/who"}, "elements that turn into particles cannot step less often than these",
                       "none or elements, or no body of method auto");
    fem_->allow_parts();
  }
  if (subcycling_.particles_are_coarse())
    sph_->allow_parts();
  subcycling_.measure(parts_reference_);
}

/// Of what steps more often, contact among it.
template <int dim>
StepLimit Model<dim>::fine_limit() const
{
  StepLimit limit = coupler_->stable_dt();
  if (fem_ && !subcycling_.mesh_is_coarse())
    limit.tighten(fem_->stable_dt());
  if (sph_ && !subcycling_.particles_are_coarse())
    limit.tighten(sph_->stable_dt());
  return limit;
}

template <int dim>
StepLimit Model<dim>::coarse_limit() const
{
  return subcycling_.mesh_is_coarse()       ? fem_->stable_dt() :
         subcycling_.particles_are_coarse() ? sph_->stable_dt() :
                                              StepLimit();
}

template <int dim>
StepLimit Model<dim>::stable_dt() const
{
  return subcycling_.limit(fine_limit(), coarse_limit());
}

namespace
{
/// A part of a step: for a solver that steps finely a step, for the other one
/// the beginning, the middle or the end of one.
template <class Solver>
StepStatus take(Solver &solver, bool coarse, const TimeStep &whole, const TimeStep &part, bool first, bool last)
{
  if (!coarse)
    return solver.step(part);
  const StepStatus status = first ? solver.begin(whole, part) : solver.go_on(part);
  return last && status.ok ? solver.finish(whole) : status;
}
} // namespace

template <int dim>
StepStatus Model<dim>::step(const TimeStep &step)
{
  parts_ = subcycling_.on() ? subcycling_.parts(step, fine_limit().dt) : 1;
  StepStatus status;
  for (std::size_t j = 0; j < parts_ && status.ok; ++j)
    status = take_part(step, j);
  return status;
}

template <int dim>
StepStatus Model<dim>::take_part(const TimeStep &whole, std::size_t j)
{
  const bool     first = j == 0, last = j + 1 == parts_;
  const TimeStep part = subcycling_.part(whole, parts_, j);
  // Coarse particles push what carries them once, over their own kick.
  coupler_->gather(!subcycling_.particles_are_coarse() ? 1. : first ? whole.kick / part.kick : 0.);
  StepStatus status;
  if (fem_)
  {
    const Stopwatch watch(fem_seconds_);
    status = take(*fem_, subcycling_.mesh_is_coarse(), whole, part, first, last);
  }
  coupler_->drive();
  if (sph_ && status.ok)
  {
    const Stopwatch watch(sph_seconds_);
    status = take(*sph_, subcycling_.particles_are_coarse(), whole, part, first, last);
  }
  if (status.ok)
    coupler_->close(part);
  subcycling_.took(part);
  return status;
}

template <int dim>
RankShare Model<dim>::share() const
{
  RankShare share;
  share.solver_s = sph_seconds_ + fem_seconds_;
  if (sph_)
  {
    const sph::Diagnostics d = sph_->diagnostics();
    share.particles          = static_cast<std::int64_t>(d.own);
    share.halo_particles     = static_cast<std::int64_t>(d.halo);
    share.particle_work      = d.work;
  }
  if (fem_)
  {
    const auto own     = fem_->share();
    share.elements     = static_cast<std::int64_t>(own.elements);
    share.nodes        = static_cast<std::int64_t>(own.nodes);
    share.shared_nodes = static_cast<std::int64_t>(own.shared);
    share.element_work = own.work;
  }
  return share;
}

template <int dim>
double Model<dim>::parts_error(Party party) const
{
  return party == mesh_party ? (fem_ ? fem_->parts_error() : 0.) :
                               (subcycling_.particles_are_coarse() ? sph_->parts_error() : 0.);
}

/// Their error swings with the energy that passes between classes: it is held
/// against the most that there was, of all kinds.
template <int dim>
std::string Model<dim>::review_local_steps()
{
  if (!fem_ || !fem_->steps_locally())
    return {};
  const double error = fem_->parts_error();
  if (!(std::abs(error) > parts_limit_ * local_reference_))
    return {};
  const LedgerRow now = ledger();
  local_reference_    = std::max(local_reference_, now.kinetic + now.internal());
  if (!(std::abs(error) > parts_limit_ * local_reference_))
    return {};
  fem_->end_local_steps();
  return "the error of local steps has come to " + engineering(error) +
         " J, more than Subcycling/energy limit allows: all elements step alike from now on";
}

template <int dim>
std::string Model<dim>::review()
{
  if (std::string note = review_local_steps(); !note.empty())
    return note;
  if (!subcycling_.on())
    return {};
  const double error = coupler_->balance().interface_work + parts_error(particle_party) + parts_error(mesh_party);
  if (!subcycling_.review(error, [this] { return ledger().kinetic; }))
    return {};
  return "the error of the interfaces has come to " + engineering(error) +
         " J by steps in parts, more than Subcycling/energy limit allows: particles and elements step alike from now on";
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void        Model<d>::begin_parts(const input::Scene &);                                          \
  template StepLimit   Model<d>::fine_limit() const;                                                         \
  template StepLimit   Model<d>::coarse_limit() const;                                                       \
  template StepStatus  Model<d>::take_part(const TimeStep &, std::size_t);                                   \
  template StepLimit   Model<d>::stable_dt() const;                                                          \
  template StepStatus  Model<d>::step(const TimeStep &);                                                     \
  template double      Model<d>::parts_error(Party) const;                                                   \
  template RankShare   Model<d>::share() const;                                                              \
  template std::string Model<d>::review_local_steps();                                                       \
  template std::string Model<d>::review();
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::coupling
