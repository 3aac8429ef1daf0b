// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/materials/started_material.h"
#include "sph/implementation.h"

#include <algorithm>
#include <numeric>

/// Who owns which particle. Particles move to the rank whose territory they
/// stand in when the lists are built anew, with every field of the store.
///
/// The territory is cut anew where the work is uneven. Work is counted, not
/// timed: a cut decides on the order of sums and so on their rounding, and the
/// same run must give the same bits again.
namespace ogive::sph
{
namespace
{
/// Work of a particle beside its pairs (its material, kick and records) in
/// directed pairs: an estimate. Rows have some 20 pairs in a plane and 80 in
/// space, nearly all of them the same number, so that little hangs on it.
constexpr double work_of_point = 24;
/// Share by which the number of particles may grow before space is cut anew.
constexpr double growth = .1;

constexpr std::size_t none = static_cast<std::size_t>(-1);

template <int dim>
std::vector<AlignedVector<double> *> arrays_of(Store<dim> &store)
{
  std::vector<AlignedVector<double> *> all;
  store.for_each_array([&](const std::string &, AlignedVector<double> &a) { all.push_back(&a); });
  return all;
}
} // namespace

/// Keeps of the bodies as they were filled what this rank owns; returns the ids
/// of what is left of each.
template <int dim>
std::vector<std::vector<std::int64_t>> Solver<dim>::Implementation::take_own(std::vector<BodyParticles<dim>> &filled)
{
  std::vector<std::vector<std::int64_t>> ids(filled.size());
  std::size_t                            total = 0;
  for (std::size_t k = 0; k < filled.size(); total += filled[k++].x.size())
  {
    ids[k].resize(filled[k].x.size());
    std::iota(ids[k].begin(), ids[k].end(), static_cast<std::int64_t>(total));
  }
  if (ranks.alone())
    return ids;
  // All ranks hold all of them: each names its share of the points to cut by.
  const std::size_t first = total * ranks.rank() / ranks.size(), last = total * (ranks.rank() + 1) / ranks.size();
  PerAxis<std::vector<double>> x;
  std::size_t                  at = 0;
  for (const auto &f : filled)
    for (const auto &point : f.x)
      if (const std::size_t i = at++; i >= first && i < last)
        for (int a = 0; a < dim; ++a)
          x[a].push_back(point[a]);
  cut(x, std::vector<double>(last - first, 1.), total);
  for (std::size_t k = 0; k < filled.size(); ++k)
  {
    auto       &f    = filled[k];
    std::size_t kept = 0;
    std::vector<std::size_t> points;
    for (std::size_t i = 0; i < f.x.size(); ++i)
      if (territory.at(f.x[i], ranks.rank()) == ranks.rank())
      {
        f.x[kept]    = f.x[i];
        f.v[kept]    = f.v[i];
        f.mass[kept] = f.mass[i];
        ids[k][kept] = ids[k][i];
        ++kept;
        points.push_back(i);
      }
    if (const auto started = std::dynamic_pointer_cast<const materials::StartedMaterial>(f.material))
      f.material = started->of_points(points);
    f.x.resize(kept);
    f.v.resize(kept);
    f.mass.resize(kept);
    ids[k].resize(kept);
  }
  return ids;
}

template <int dim>
void Solver<dim>::Implementation::cut(const PerAxis<std::vector<double>> &x, const std::vector<double> &weight,
                                      std::size_t of)
{
  std::array<std::span<const double>, dim> view;
  for (int a = 0; a < dim; ++a)
    view[a] = x[a];
  territory = Territory<dim>::cut(ranks, view, weight);
  cut_at    = of;
}

template <int dim>
double Solver<dim>::Implementation::work_of(std::size_t i) const
{
  return work_of_point + static_cast<double>(pairs.rows.row[i + 1] - pairs.rows.row[i]);
}

template <int dim>
double Solver<dim>::Implementation::own_work() const
{
  double work = 0;
  for (std::size_t i = 0; i < store.size() && i + 1 < pairs.rows.row.size(); ++i)
    work += work_of(i);
  return work;
}

/// Each interval: whether the work is so uneven that space is to be cut anew.
template <int dim>
bool Solver<dim>::Implementation::is_uneven()
{
  const auto interval = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(parameters.parallel.interval));
  if (ranks.alone() || reference.on || steps % interval != 0)
    return false;
  const auto   all  = ranks.gather_one(own_work());
  const double mean = std::accumulate(all.begin(), all.end(), 0.) / ranks.size();
  diagnostics.imbalance = mean > 0 ? *std::max_element(all.begin(), all.end()) / mean : 1.;
  return diagnostics.imbalance > parameters.parallel.imbalance;
}

/// Whether so many came in that the old cut says little.
template <int dim>
bool Solver<dim>::Implementation::has_grown() const
{
  return !ranks.alone() && static_cast<double>(n_all()) > (1 + growth) * static_cast<double>(cut_at);
}

/// Moves what stands in another rank's territory there. `anew`: cuts first.
template <int dim>
void Solver<dim>::Implementation::share_out(bool anew)
{
  if (ranks.alone() || reference.on)
    return;
  const std::size_t n = store.size();
  if (anew)
  {
    std::vector<double> weight(n, 1.); // lists of before newcomers tell nothing
    for (std::size_t i = 0; i < n && pairs.rows.row.size() == n + 1; ++i)
      weight[i] = work_of(i);
    PerAxis<std::vector<double>> x;
    for (int a = 0; a < dim; ++a)
      x[a].assign(store.x[a].begin(), store.x[a].end());
    cut(x, weight, n_all());
  }
  std::vector<int> owner(n);
  std::size_t      leave = 0;
  for (std::size_t i = 0; i < n; ++i)
  {
    std::array<double, dim> where;
    for (int a = 0; a < dim; ++a)
      where[a] = store.x[a][i];
    owner[i] = territory.at(where, ranks.rank());
    leave += owner[i] != ranks.rank();
  }
  diagnostics.migrated += leave;
  if (ranks.any(leave > 0))
    move_to(owner);
}

/// Sends particles to their owners and takes in what comes.
template <int dim>
void Solver<dim>::Implementation::move_to(const std::vector<int> &owner)
{
  std::vector<std::vector<double>>       numbers(ranks.size());
  std::vector<std::vector<std::int64_t>> integers(ranks.size());
  const auto                             fields = arrays_of(store);
  const auto for_each_range = [&](auto &&f) { // particles of all bodies, then riders
    for (const bool rides : {false, true})
      for (std::size_t k = 0; k < bodies.size(); ++k)
        f(k, rides, rides ? bodies[k].first_rider : bodies[k].first, rides ? bodies[k].last_rider : bodies[k].last);
  };
  for_each_range([&](std::size_t k, bool rides, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      if (const int to = owner[i]; to != ranks.rank())
      {
        for (const auto *field : fields)
          numbers[to].push_back(field->empty() ? 0. : (*field)[i]);
        auto &whole = integers[to];
        whole.insert(whole.end(), {static_cast<std::int64_t>(k), rides, near_surface[i]});
        store.for_each_integer([&](const char *, auto &a) { whole.push_back(a[i]); });
      }
  });
  numbers  = ranks.swap(numbers);
  integers = ranks.swap(integers);
  std::size_t width = 3;
  store.for_each_integer([&](const char *, auto &) { ++width; });

  // Where each goes: those that stay, then those that came.
  std::vector<std::size_t>              from;
  std::vector<std::array<std::size_t, 3>> seats; // index, rank, number among its own
  auto                                  then = bodies;
  for_each_range([&](std::size_t k, bool rides, std::size_t first, std::size_t last) {
    (rides ? then[k].first_rider : then[k].first) = from.size();
    for (std::size_t i = first; i < last; ++i)
      if (owner[i] == ranks.rank())
        from.push_back(i);
    for (std::size_t r = 0; r < integers.size(); ++r)
      for (std::size_t q = 0; q < integers[r].size() / width; ++q)
        if (integers[r][q * width] == static_cast<std::int64_t>(k) && integers[r][q * width + 1] == rides)
        {
          seats.push_back({from.size(), r, q});
          from.push_back(none);
        }
    (rides ? then[k].last_rider : then[k].last) = from.size();
  });
  rearrange(from);
  bodies             = std::move(then);
  const auto targets = arrays_of(store);
  for (const auto &[i, r, q] : seats)
  {
    for (std::size_t f = 0; f < targets.size(); ++f)
      if (!targets[f]->empty())
        (*targets[f])[i] = numbers[r][q * targets.size() + f];
    const std::int64_t *whole = &integers[r][q * width];
    near_surface[i]           = whole[2];
    std::size_t at            = 3;
    store.for_each_integer([&](const char *, auto &a) { a[i] = static_cast<std::decay_t<decltype(a[i])>>(whole[at++]); });
  }
  size_arrays();
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template std::vector<std::vector<std::int64_t>> Solver<d>::Implementation::take_own(                       \
    std::vector<BodyParticles<d>> &);                                                                        \
  template void Solver<d>::Implementation::cut(const std::array<std::vector<double>, d> &,                   \
                                               const std::vector<double> &, std::size_t);                    \
  template double Solver<d>::Implementation::own_work() const;                                               \
  template bool Solver<d>::Implementation::is_uneven();                                                      \
  template bool Solver<d>::Implementation::has_grown() const;                                                \
  template void Solver<d>::Implementation::share_out(bool);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
