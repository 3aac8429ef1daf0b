// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/common_particles.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

/// What the ranks tell each other of their particles.
namespace ogive::coupling
{
namespace
{
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// All that is told of a particle as it comes in.
template <int dim>
struct Told
{
  std::int64_t            id = 0;
  std::array<double, dim> x, v;
  double                  mass = 0, radius = 0, damage = 0;
  std::int32_t            body = 0, may_touch = 0;
};

template <int dim>
struct State
{
  std::uint64_t           number = 0;
  std::array<double, dim> x, v;
  double                  damage = 0;
};

template <int dim>
struct Vector
{
  std::uint64_t           number = 0;
  std::array<double, dim> v;
};
} // namespace

template <int dim>
CommonParticles<dim>::CommonParticles(const Ranks &ranks, std::unique_ptr<ParticlePort<dim>> own)
  : ranks_(ranks)
  , own_(std::move(own))
{}

template <int dim>
Surface<dim> CommonParticles<dim>::surface()
{
  Surface<dim> s;
  s.n = id_.size();
  for (int a = 0; a < dim; ++a)
  {
    s.x[a]     = x_[a];
    s.v[a]     = v_[a];
    s.force[a] = force_[a];
  }
  s.mass           = mass_;
  s.body           = body_;
  s.id             = id_;
  s.contact_points = contact_points_;
  s.radius         = radius_;
  s.topology       = topology_;
  return s;
}

template <int dim>
std::uint64_t CommonParticles<dim>::lists()
{
  const std::uint64_t now = own_->surface().topology;
  if (ranks_.any(now != own_lists_))
  {
    ++lists_;
    stale_ = true;
  }
  own_lists_ = now;
  return lists_;
}

template <int dim>
void CommonParticles<dim>::meet(const Surface<dim> &mesh)
{
  if (idle() && !stale_)
    return;
  const Surface<dim> own  = own_->surface();
  const bool         news = own.topology != own_lists_;
  double             told[2] = {news ? 1. : 0., stale_ || moved(own, mesh) ? 1. : 0.};
  ranks_.max(std::span<double>(told));
  own_lists_ = own.topology;
  lists_ += told[0] > 0;
  if (told[0] > 0 || told[1] > 0)
  {
    settle(own, mesh);
    return;
  }
  share(own, true);
}

template <int dim>
void CommonParticles<dim>::meet_again()
{
  if (idle())
    return;
  share(own_->surface(), false);
}

// Told at each look.
template <int dim>
void CommonParticles<dim>::share(const Surface<dim> &own, bool places)
{
  find_own(own);
  if (!places)
  {
    std::vector<Vector<dim>> out;
    for (const auto &[i, number] : of_own_)
    {
      auto &o = out.emplace_back();
      o.number = number;
      for (int a = 0; a < dim; ++a)
        o.v[a] = own.v[a][i];
    }
    for (const auto &in : ranks_.gather(out))
      for (int a = 0; a < dim; ++a)
        v_[a][in.number] = in.v[a];
    return;
  }
  const auto              damage = own_->damage();
  std::vector<State<dim>> out;
  for (const auto &[i, number] : of_own_)
  {
    auto &o = out.emplace_back();
    o.number = number;
    o.damage = damage.empty() ? 0 : damage[i];
    for (int a = 0; a < dim; ++a)
    {
      o.x[a] = own.x[a][i];
      o.v[a] = own.v[a][i];
    }
  }
  for (const auto &in : ranks_.gather(out))
  {
    for (int a = 0; a < dim; ++a)
    {
      x_[a][in.number] = in.x[a];
      v_[a][in.number] = in.v[a];
    }
    if (watches_damage_)
      damage_[in.number] = in.damage;
  }
}

template <int dim>
void CommonParticles<dim>::settle(const Surface<dim> &own, const Surface<dim> &mesh)
{
  collect(own, everyone_ ? std::vector<char>(own.n, 1) : chosen(own, mesh));
  note_places(own, mesh);
  stale_  = false;
  paired_ = 0;
  ++settled_;
}

template <int dim>
void CommonParticles<dim>::collect(const Surface<dim> &own, const std::vector<char> &take)
{
  const auto        damage = own_->damage();
  std::vector<char> touches(own.n, 0);
  for (const std::uint32_t i : own.contact_points)
    touches[i] = 1;
  std::vector<Told<dim>> out;
  for (std::uint32_t i = 0; i < own.n; ++i)
  {
    if (own.id[i] < 0 || (!take[i] && !std::binary_search(slaves_.begin(), slaves_.end(), own.id[i])))
      continue;
    auto &o = out.emplace_back();
    o.id        = own.id[i];
    o.mass      = own.mass[i];
    o.radius    = own.radius.empty() ? 0 : own.radius[i];
    o.damage    = damage.empty() ? 0 : damage[i];
    o.body      = own.body[i];
    o.may_touch = touches[i];
    for (int a = 0; a < dim; ++a)
    {
      o.x[a] = own.x[a][i];
      o.v[a] = own.v[a][i];
    }
  }
  auto all = ranks_.gather(out);
  std::sort(all.begin(), all.end(), [](const auto &a, const auto &b) { return a.id < b.id; });
  const std::size_t n = all.size();
  for (int a = 0; a < dim; ++a)
  {
    x_[a].resize(n);
    v_[a].resize(n);
    force_[a].assign(n, 0.);
  }
  mass_.resize(n), radius_.resize(n), body_.resize(n), id_.resize(n);
  damage_.assign(watches_damage_ ? n : 0, 0.);
  contact_points_.clear();
  for (std::uint32_t k = 0; k < n; ++k)
  {
    const auto &in = all[k];
    for (int a = 0; a < dim; ++a)
    {
      x_[a][k] = in.x[a];
      v_[a][k] = in.v[a];
    }
    id_[k] = in.id, mass_[k] = in.mass, radius_[k] = in.radius, body_[k] = in.body;
    if (watches_damage_)
      damage_[k] = in.damage;
    if (in.may_touch)
      contact_points_.push_back(k);
    widest_.resize(std::max<std::size_t>(widest_.size(), static_cast<std::size_t>(in.body) + 1), 0.);
    widest_[static_cast<std::size_t>(in.body)] = std::max(widest_[static_cast<std::size_t>(in.body)], in.radius);
  }
  ++topology_;
  renew_index();
}

template <int dim>
void CommonParticles<dim>::renew_index()
{
  index_.assign(id_.empty() ? 0 : static_cast<std::size_t>(id_.back()) + 1, none);
  for (std::uint32_t k = 0; k < id_.size(); ++k)
    index_[static_cast<std::size_t>(id_[k])] = k;
}

template <int dim>
void CommonParticles<dim>::find_own(const Surface<dim> &own) const
{
  if (paired_ != 0 && paired_ == topology_ && paired_with_ == own.topology)
    return;
  of_own_.clear();
  for (std::uint32_t i = 0; i < own.n; ++i)
    if (const auto id = own.id[i]; id >= 0 && static_cast<std::size_t>(id) < index_.size() &&
                                   index_[static_cast<std::size_t>(id)] != none)
      of_own_.emplace_back(i, index_[static_cast<std::size_t>(id)]);
  paired_      = topology_;
  paired_with_ = own.topology;
}

template <int dim>
void CommonParticles<dim>::give_forces()
{
  const Surface<dim> own = own_->surface();
  find_own(own);
  for (int a = 0; a < dim; ++a)
  {
    std::fill(own.force[a].begin(), own.force[a].end(), 0.);
    for (const auto &[i, number] : of_own_)
      own.force[a][i] = force_[a][number];
  }
}

template <int dim>
void CommonParticles<dim>::set_slaves(std::span<const std::int64_t> ids)
{
  own_->set_slaves(ids);
  slaves_.assign(ids.begin(), ids.end());
  std::sort(slaves_.begin(), slaves_.end());
  stale_ = true;
}

template <int dim>
void CommonParticles<dim>::set_riders(const sph::Newcomers<dim> &in)
{
  own_->set_riders(in);
  stale_ = true;
}

// Numbers that each rank has of its own particles, to all.
template <int dim>
void CommonParticles<dim>::spread(const std::array<std::vector<double>, dim> &of_own,
                                  const std::array<std::span<double>, dim> &to, const Surface<dim> &own) const
{
  find_own(own);
  std::vector<Vector<dim>> out;
  std::size_t              nonzero = 0;
  const auto               any     = [&](std::size_t i) {
    return std::any_of(of_own.begin(), of_own.end(), [&](const auto &component) { return component[i] != 0; });
  };
  for (std::size_t i = 0; i < own.n; ++i)
    nonzero += any(i);
  for (const auto &[i, number] : of_own_)
    if (any(i))
    {
      auto &o = out.emplace_back();
      o.number = number;
      for (int a = 0; a < dim; ++a)
        o.v[a] = of_own[a][i];
    }
  require(out.size() == nonzero, "each particle that a rider presses is common to all ranks");
  for (const auto &in : ranks_.gather(out))
    for (int a = 0; a < dim; ++a)
      to[a][in.number] = in.v[a];
}

template <int dim>
void CommonParticles<dim>::seam_forces(int body, const std::array<std::span<double>, dim> &force) const
{
  const Surface<dim>                   own = own_->surface();
  std::array<std::vector<double>, dim> of_own;
  std::array<std::span<double>, dim>   view;
  for (int a = 0; a < dim; ++a)
  {
    of_own[a].assign(own.n, 0.);
    view[a] = of_own[a];
  }
  own_->seam_forces(body, view);
  spread(of_own, force, own);
}

template <int dim>
void CommonParticles<dim>::seam_normals(int body, const std::array<std::span<double>, dim> &area)
{
  const Surface<dim>                   own = own_->surface();
  std::array<std::vector<double>, dim> of_own;
  std::array<std::span<double>, dim>   view;
  for (int a = 0; a < dim; ++a)
  {
    of_own[a].assign(own.n, 0.);
    view[a] = of_own[a];
  }
  own_->seam_normals(body, view);
  spread(of_own, area, own);
}

template class CommonParticles<1>;
template class CommonParticles<2>;
template class CommonParticles<3>;
} // namespace ogive::coupling
