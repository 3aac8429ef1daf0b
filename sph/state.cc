// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/state.h"

#include "core/base/error.h"

#include <algorithm>

namespace ogive::sph
{
/// Lists from the positions they were built at, then gradients and forces at
/// the state in place: every number that a step reads comes back to the bit.
template <int dim>
void Solver<dim>::Implementation::follow(bool lists)
{
  if (lists)
    rebuild_lists();
  if (store.in_parts)
    store.v.swap(store.v_strain);
  advance_material(0);
  list_contact_points();
  surface_stale = false;
  forces();
  if (store.in_parts)
    store.v.swap(store.v_strain);
}

template <int dim>
void Solver<dim>::Implementation::keep()
{
  if (!kept)
    kept = std::make_unique<State>();
  *kept = {store, reference.deformation, near_surface, works, time, time_listed, wall_forces, updates, topology, diagnostics.rebuilds, pieces};
}

template <int dim>
void Solver<dim>::Implementation::go_back()
{
  require(kept != nullptr, "restore without a snapshot");
  const bool lists = diagnostics.rebuilds != kept->rebuilds;
  store            = kept->store;
  reference.deformation = kept->deformation;
  near_surface     = kept->near_surface;
  works            = kept->works;
  time             = kept->time;
  time_listed      = kept->time_listed;
  wall_forces      = kept->wall_forces;
  updates          = kept->updates;
  pieces           = kept->pieces;
  if (topology != kept->topology)
    kept->topology = ++topology;
  follow(lists);
  kept->rebuilds = diagnostics.rebuilds;
}

template <int dim>
void Solver<dim>::Implementation::write(ArchiveWriter &out, const std::string &prefix)
{
  store.for_each_array([&](const std::string &name, const auto &a) {
    out.write(prefix + "/" + name, std::span<const double>(a.data(), a.size()));
  });
  const auto &f = reference.deformation;
  if (reference.on)
    out.write(prefix + "/deformation", std::span<const double>(f.data(), f.size()));
  std::vector<std::int64_t> ranges;
  for (const auto &b : bodies)
    for (const std::size_t end : {b.first, b.last, b.first_rider, b.last_rider})
      ranges.push_back(static_cast<std::int64_t>(end));
  out.write(prefix + "/ranges", std::span<const std::int64_t>(ranges));
  out.write(prefix + "/seam_work", std::span<const double>(works.seam));
  out.write(prefix + "/id", std::span<const std::int64_t>(store.id));
  out.write(prefix + "/fixed", std::span<const std::int64_t>(store.fixed));
  out.write(prefix + "/near_surface", std::span<const std::int64_t>(near_surface));
  std::vector<std::int64_t> parts{static_cast<std::int64_t>(pieces.size())};
  parts.insert(parts.end(), pieces.begin(), pieces.end());
  out.write(prefix + "/pieces", std::span<const std::int64_t>(parts));
  out.write(prefix + "/touch", std::span<const std::int64_t>(store.touch));
  const double work[8] = {works.external,   works.wall_loss,  works.friction, works.impulse[0],
                          works.impulse[1], works.impulse[2], time,           time_listed};
  out.write(prefix + "/works", std::span<const double>(work, 8));
  if (store.in_parts)
    out.write(prefix + "/parts_error", works.parts_error);
  out.write(prefix + "/wall_pull", std::span<const double>(works.pull));
  out.write(prefix + "/wall_forces", std::span<const double>(wall_forces));
  out.write(prefix + "/updates", static_cast<std::int64_t>(updates));
}

/// Makes room for the particles of the checkpoint where the scene's own number
/// may have changed.
template <int dim>
void Solver<dim>::Implementation::read_ranges(const ArchiveReader &in, const std::string &prefix)
{
  const auto ranges = in.integers(prefix + "/ranges");
  if (ranges.size() != 4 * bodies.size())
    throw InputError({"", 0, prefix + "/ranges"}, "the checkpoint holds other bodies of particles than the scene");
  std::size_t n = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k)
  {
    const auto at   = [&](std::size_t c) { return static_cast<std::size_t>(ranges[4 * k + c]); };
    auto      &body = bodies[k];
    if (!body.grows && at(1) - at(0) != body.last - body.first)
      throw InputError({"", 0, prefix + "/id"}, "the checkpoint holds " + std::to_string(at(1) - at(0)) +
                                                  " particles of a body, the scene makes " +
                                                  std::to_string(body.last - body.first));
    body.first       = at(0);
    body.last        = at(1);
    body.first_rider = at(2);
    body.last_rider  = at(3);
    n                = std::max({n, body.last, body.last_rider});
  }
  store.resize(n);
  size_arrays();
  for (auto &body : bodies)
  {
    std::fill(store.body.begin() + static_cast<std::ptrdiff_t>(body.first),
              store.body.begin() + static_cast<std::ptrdiff_t>(body.last), body.scene);
    std::fill(store.body.begin() + static_cast<std::ptrdiff_t>(body.first_rider),
              store.body.begin() + static_cast<std::ptrdiff_t>(body.last_rider), -1);
    prepare_riders(body);
  }
}

template <int dim>
void Solver<dim>::Implementation::read(const ArchiveReader &in, const std::string &prefix)
{
  const auto fit = [&](const std::string &name, std::size_t have, std::size_t want) {
    if (have != want)
      throw InputError({"", 0, prefix + "/" + name}, "the checkpoint holds " + std::to_string(have) +
                                                       " entries, the scene makes " + std::to_string(want));
  };
  const auto integers = [&](const std::string &name, std::vector<std::int64_t> &to) {
    const auto from = in.integers(prefix + "/" + name);
    fit(name, from.size(), to.size());
    to = from;
  };
  read_ranges(in, prefix);
  store.for_each_array([&](const std::string &name, auto &a) {
    const auto from = in.doubles(prefix + "/" + name);
    fit(name, from.size(), a.size());
    a.assign(from.begin(), from.end());
  });
  if (reference.on)
  {
    const auto from = in.doubles(prefix + "/deformation");
    fit("deformation", from.size(), reference.deformation.size());
    reference.deformation.assign(from.begin(), from.end());
  }
  integers("id", store.id);
  integers("fixed", store.fixed);
  integers("touch", store.touch);
  integers("near_surface", near_surface);
  const auto work = in.doubles(prefix + "/works");
  fit("works", work.size(), 8);
  works           = {work[0], work[1], work[2], Vec3(work[3], work[4], work[5]), in.doubles(prefix + "/wall_pull")};
  if (store.in_parts)
    works.parts_error = in.number(prefix + "/parts_error");
  const auto seam = in.doubles(prefix + "/seam_work");
  fit("seam_work", seam.size(), bodies.size());
  works.seam = seam;
  fit("wall_pull", works.pull.size(), parameters.walls.size());
  time            = work[6];
  time_listed     = work[7];
  wall_forces     = in.doubles(prefix + "/wall_forces");
  fit("wall_forces", wall_forces.size(), parameters.walls.size());
  updates = static_cast<std::uint64_t>(in.integer(prefix + "/updates"));
  const auto parts = in.integers(prefix + "/pieces");
  pieces.assign(parts.begin() + 1, parts.end());
  ++topology;
  follow(true);
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void Solver<d>::Implementation::follow(bool);                                                     \
  template void Solver<d>::Implementation::keep();                                                           \
  template void Solver<d>::Implementation::go_back();                                                        \
  template void Solver<d>::Implementation::write(ArchiveWriter &, const std::string &);                      \
  template void Solver<d>::Implementation::read_ranges(const ArchiveReader &, const std::string &);          \
  template void Solver<d>::Implementation::read(const ArchiveReader &, const std::string &);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
