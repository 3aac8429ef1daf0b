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
  *kept = {store, reference.deformation, near_surface, works, time, time_listed, wall_forces, updates, topology,
           diagnostics.rebuilds, pieces, bodies, territory, cut_at, steps};
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
  territory        = kept->territory;
  cut_at           = kept->cut_at;
  steps            = kept->steps;
  for (std::size_t k = 0; k < bodies.size(); ++k) // particles came and went
  {
    bodies[k].first       = kept->bodies[k].first;
    bodies[k].last        = kept->bodies[k].last;
    bodies[k].first_rider = kept->bodies[k].first_rider;
    bodies[k].last_rider  = kept->bodies[k].last_rider;
  }
  size_arrays();
  if (topology != kept->topology)
    kept->topology = ++topology;
  follow(lists);
  kept->rebuilds = diagnostics.rebuilds;
}

/// Arrays of particles, and what each rank booked, stand rank after rank.
template <int dim>
void Solver<dim>::Implementation::write(ArchiveWriter &out, const std::string &prefix)
{
  const auto write_parts = [&](const std::string &name, const auto &own) {
    out.write_parts(ranks, prefix + "/" + name, std::span(own.data(), own.size()));
  };
  store.for_each_array(write_parts);
  if (reference.on)
    write_parts("deformation", reference.deformation);
  std::vector<std::int64_t> ranges;
  for (const auto &b : bodies)
    for (const std::size_t end : {b.first, b.last, b.first_rider, b.last_rider})
      ranges.push_back(static_cast<std::int64_t>(end));
  write_parts("ranges", ranges);
  write_parts("seam_work", works.seam);
  write_parts("id", store.id);
  write_parts("fixed", store.fixed);
  write_parts("near_surface", near_surface);
  std::vector<std::int64_t> parts{static_cast<std::int64_t>(pieces.size())};
  parts.insert(parts.end(), pieces.begin(), pieces.end());
  out.write(prefix + "/pieces", std::span<const std::int64_t>(parts));
  write_parts("touch", store.touch);
  write_parts("works", std::array{works.external,   works.wall_loss,  works.friction, works.impulse[0],
                                  works.impulse[1], works.impulse[2], time,           time_listed});
  if (store.in_parts)
    write_parts("parts_error", std::array{works.parts_error});
  out.write(prefix + "/wall_pull", std::span<const double>(works.pull)); // the same on all ranks
  write_parts("wall_forces", wall_forces);
  write_parts("updates", std::array{static_cast<std::int64_t>(updates)});
  if (ranks.alone())
    return;
  std::vector<double> boxes;
  for (const auto &box : territory.boxes)
    for (const auto *corner : {&box.lower, &box.upper})
      boxes.insert(boxes.end(), corner->begin(), corner->end());
  boxes.push_back(0); // no archive keeps nothing
  out.write(prefix + "/territory", std::span<const double>(boxes));
  const std::int64_t course[] = {static_cast<std::int64_t>(cut_at), static_cast<std::int64_t>(steps)};
  out.write(prefix + "/course", std::span<const std::int64_t>(course));
}

/// Makes room for the particles of the checkpoint where the scene's own number
/// may have changed. Returns for each particle of this rank its place in the
/// arrays of the file: where as many ranks wrote it the part of this rank, else
/// what stands on its ground once that is cut anew.
template <int dim>
std::vector<std::size_t> Solver<dim>::Implementation::read_ranges(const ArchiveReader &in, const std::string &prefix)
{
  const auto ranges = in.integers(prefix + "/ranges");
  if (ranges.empty() || ranges.size() % (4 * bodies.size()) != 0)
    throw InputError({"", 0, prefix + "/ranges"}, "the checkpoint holds other bodies of particles than the scene");
  const std::size_t written = ranges.size() / (4 * bodies.size()); // ranks that wrote it
  // Places in the file of each body's particles, then of its riders, by the rank that wrote them.
  std::vector<std::vector<std::vector<std::size_t>>> place(2 * bodies.size(), std::vector<std::vector<std::size_t>>(written));
  std::size_t                                        total = 0;
  for (std::size_t r = 0; r < written; ++r)
  {
    const std::size_t first = total;
    for (std::size_t part = 0; part < 2 * bodies.size(); ++part)
    {
      const auto *range = &ranges[4 * bodies.size() * r + 4 * (part % bodies.size()) + (part < bodies.size() ? 0 : 2)];
      for (auto i = range[0]; i < range[1]; ++i, ++total)
        place[part][r].push_back(first + static_cast<std::size_t>(i));
    }
  }
  const bool as_written = written == static_cast<std::size_t>(ranks.size());
  place_territory(in, prefix, as_written, total);
  PerAxis<std::vector<double>> x;
  for (int a = 0; a < dim && !as_written; ++a)
    x[a] = in.doubles(prefix + "/x" + std::array{"_x", "_y", "_z"}[a]);
  const auto is_own = [&](std::size_t r, std::size_t i) {
    if (as_written)
      return r == static_cast<std::size_t>(ranks.rank());
    std::array<double, dim> where;
    for (int a = 0; a < dim; ++a)
      where[a] = x[a].at(i);
    return territory.at(where, ranks.rank()) == ranks.rank();
  };
  std::vector<std::size_t> own;
  for (std::size_t part = 0; part < 2 * bodies.size(); ++part)
  {
    auto             &body  = bodies[part % bodies.size()];
    const bool        rides = part >= bodies.size();
    const std::size_t begin = own.size();
    std::size_t       all   = 0;
    for (std::size_t r = 0; r < written; all += place[part][r++].size())
      for (const std::size_t i : place[part][r])
        if (is_own(r, i))
          own.push_back(i);
    if (!rides && !body.grows && all != body.all)
      throw InputError({"", 0, prefix + "/id"}, "the checkpoint holds " + std::to_string(all) +
                                                  " particles of a body, the scene makes " + std::to_string(body.all));
    (rides ? body.first_rider : body.first) = begin;
    (rides ? body.last_rider : body.last)   = own.size();
    (rides ? body.all_riders : body.all)    = all;
  }
  store.resize(own.size());
  size_arrays();
  for (auto &body : bodies)
  {
    std::fill(store.body.begin() + static_cast<std::ptrdiff_t>(body.first),
              store.body.begin() + static_cast<std::ptrdiff_t>(body.last), body.scene);
    std::fill(store.body.begin() + static_cast<std::ptrdiff_t>(body.first_rider),
              store.body.begin() + static_cast<std::ptrdiff_t>(body.last_rider), -1);
    prepare_riders(body);
  }
  return own;
}

/// The territory of the checkpoint, or one for another number of ranks.
template <int dim>
void Solver<dim>::Implementation::place_territory(const ArchiveReader &in, const std::string &prefix, bool as_written,
                                                  std::size_t total)
{
  if (ranks.alone())
    return;
  if (!as_written)
  {
    const std::size_t            first = total * ranks.rank() / ranks.size(), last = total * (ranks.rank() + 1) / ranks.size();
    PerAxis<std::vector<double>> x;
    for (int a = 0; a < dim; ++a)
    {
      const auto all = in.doubles(prefix + "/x" + std::array{"_x", "_y", "_z"}[a]);
      x[a].assign(all.begin() + static_cast<std::ptrdiff_t>(first), all.begin() + static_cast<std::ptrdiff_t>(last));
    }
    cut(x, std::vector<double>(last - first, 1.), total);
    return;
  }
  const auto boxes = in.doubles(prefix + "/territory");
  territory.boxes.resize(boxes.size() / (2 * dim));
  for (std::size_t r = 0; r < territory.boxes.size(); ++r)
  {
    std::copy_n(&boxes[2 * dim * r], dim, territory.boxes[r].lower.begin());
    std::copy_n(&boxes[2 * dim * r + dim], dim, territory.boxes[r].upper.begin());
  }
  territory.find_overlaps();
  const auto course = in.integers(prefix + "/course");
  cut_at            = static_cast<std::size_t>(course.at(0));
  steps             = static_cast<std::uint64_t>(course.at(1));
}

/// What ranks booked: each its own, or the first the sum of all where others wrote it.
template <int dim>
void Solver<dim>::Implementation::read_works(const ArchiveReader &in, const std::string &prefix)
{
  const auto own_of = [&](const std::string &name, const auto &all, std::size_t want) {
    if (want == 0 ? !all.empty() : all.empty() || all.size() % want != 0)
      throw InputError({"", 0, prefix + "/" + name}, "the checkpoint holds " + std::to_string(all.size()) +
                                                       " entries, the scene makes " + std::to_string(want) + " a rank");
    auto              own     = all;
    const std::size_t written = want == 0 ? 0 : all.size() / want;
    own.assign(want, 0);
    if (written == static_cast<std::size_t>(ranks.size()))
      std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(want * ranks.rank()), want, own.begin());
    else if (ranks.first())
      for (std::size_t k = 0; k < all.size(); ++k)
        own[k % want] += all[k];
    return own;
  };
  const auto doubles = [&](const std::string &name, std::size_t want) {
    return own_of(name, in.doubles(prefix + "/" + name), want);
  };
  const auto work = doubles("works", 8);
  works           = {work[0], work[1], work[2], Vec3(work[3], work[4], work[5]), in.doubles(prefix + "/wall_pull")};
  if (works.pull.size() != parameters.walls.size())
    throw InputError({"", 0, prefix + "/wall_pull"}, "the checkpoint knows " + std::to_string(works.pull.size()) +
                                                       " rigid walls, the scene " + std::to_string(parameters.walls.size()));
  const auto times = in.doubles(prefix + "/works");
  time             = times[6];
  time_listed      = times[7];
  if (store.in_parts)
    works.parts_error = doubles("parts_error", 1)[0];
  works.seam  = doubles("seam_work", bodies.size());
  wall_forces = doubles("wall_forces", parameters.walls.size());
  updates     = static_cast<std::uint64_t>(own_of("updates", in.integers(prefix + "/updates"), 1)[0]);
}

template <int dim>
void Solver<dim>::Implementation::read(const ArchiveReader &in, const std::string &prefix)
{
  const ReferenceState first = reference; // by the particles that this rank has had
  const auto           ids   = reference.on ? ranks.gather(store.id) : std::vector<std::int64_t>();
  const auto           own   = read_ranges(in, prefix);
  const auto           total = static_cast<std::size_t>(ranks.gather(own).size());
  const auto           take  = [&](const std::string &name, const auto &from, auto &to, std::size_t each = 1) {
    if (to.size() != each * own.size())
      to.resize(each * own.size());
    if (from.size() != each * total)
      throw InputError({"", 0, prefix + "/" + name}, "the checkpoint holds " + std::to_string(from.size()) +
                                                       " entries, the scene makes " + std::to_string(each * total));
    for (std::size_t k = 0; k < own.size(); ++k)
      for (std::size_t c = 0; c < each; ++c)
        to[each * k + c] = from.at(each * own[k] + c);
  };
  store.for_each_array([&](const std::string &name, auto &a) { take(name, in.doubles(prefix + "/" + name), a); });
  const auto integers = [&](const std::string &name, std::vector<std::int64_t> &to) {
    take(name, in.integers(prefix + "/" + name), to);
  };
  integers("id", store.id);
  integers("fixed", store.fixed);
  integers("touch", store.touch);
  integers("near_surface", near_surface);
  if (reference.on)
  {
    begin_reference_again(first, ids);
    take("deformation", in.doubles(prefix + "/deformation"), reference.deformation, dim * dim);
  }
  read_works(in, prefix);
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
  template void Solver<d>::Implementation::read(const ArchiveReader &, const std::string &);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
