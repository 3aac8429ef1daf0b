// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/implementation.h"

#include <algorithm>
#include <bit>
#include <limits>

/// Particles of other ranks that pairs of this rank need: guests. They stand among
/// the ghosts, before the images of their body, as images of themselves: what
/// reflects a record array leaves theirs as it is, and the images of a guest are
/// made here from its record, as those of an own particle. The records come in
/// with exchange(), once each array is packed and before it is reflected.
namespace ogive::sph
{
namespace
{
/// Boxes are grown by this much more than the reach, so that rounding parts no pair.
constexpr double clear_of_rounding = 1 + 1e-6;

template <int dim>
struct Box
{
  std::array<double, dim> lower, upper;

  Box()
  {
    lower.fill(std::numeric_limits<double>::infinity());
    upper.fill(-std::numeric_limits<double>::infinity());
  }
  void hold(const std::array<AlignedVector<double>, dim> &x, std::size_t first, std::size_t last)
  {
    for (int a = 0; a < dim; ++a)
      for (std::size_t i = first; i < last; ++i)
      {
        lower[a] = std::min(lower[a], x[a][i]);
        upper[a] = std::max(upper[a], x[a][i]);
      }
  }
  bool meets(const Box &other, double reach) const
  {
    bool near = true;
    for (int a = 0; a < dim; ++a)
      near = near && lower[a] - reach <= other.upper[a] && other.lower[a] <= upper[a] + reach;
    return near;
  }
  bool has_near(const std::array<AlignedVector<double>, dim> &x, std::size_t i, double reach) const
  {
    bool near = true;
    for (int a = 0; a < dim; ++a)
      near = near && lower[a] - reach <= x[a][i] && x[a][i] <= upper[a] + reach;
    return near;
  }
};
} // namespace

/// Tells every rank which particles of this one are in reach of the box of its
/// particles and riders of the same body; from the positions of the lists.
template <int dim>
void Solver<dim>::Implementation::call_guests()
{
  guest_id.clear();
  guests.assign(ranks.size(), {});
  give.assign(ranks.size(), {});
  if (ranks.alone())
    return;
  std::vector<Box<dim>> own(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k)
  {
    own[k].hold(store.x_listed, bodies[k].first, bodies[k].last);
    own[k].hold(store.x_listed, bodies[k].first_rider, bodies[k].last_rider);
  }
  const auto all = ranks.gather(own);
  for (int r = 0; r < ranks.size(); ++r)
    for (std::size_t k = 0; k < bodies.size() && r != ranks.rank(); ++k)
    {
      const auto     &b     = bodies[k];
      const Box<dim> &there = all[r * bodies.size() + k];
      const double    reach = b.list_radius * clear_of_rounding;
      if (!there.meets(own[k], reach))
        continue;
      for (const bool rides : {false, true})
        for (std::size_t i = rides ? b.first_rider : b.first; i < (rides ? b.last_rider : b.last); ++i)
          if (there.has_near(store.x_listed, i, reach))
          {
            Guest g;
            for (int a = 0; a < dim; ++a)
              g.x[a] = store.x_listed[a][i];
            g.id    = store.id[i];
            g.body  = static_cast<std::int32_t>(k);
            g.rides = rides;
            guests[r].push_back(g);
            give[r].push_back(static_cast<std::uint32_t>(i));
          }
    }
  guests = ranks.swap(guests);
  take.resize(ranks.size());
  for (int r = 0; r < ranks.size(); ++r)
    take[r].resize(guests[r].size());
}

/// Makes ghosts of the guests of one body, with their positions at the end of x.
/// Returns the range of their records.
template <int dim>
auto Solver<dim>::Implementation::place_guests(std::size_t body, bool rides, PerAxis<std::vector<double>> &x)
  -> std::array<std::size_t, 2>
{
  const std::size_t begin = x[0].size();
  for (std::size_t r = 0; r < guests.size(); ++r)
    for (std::size_t k = 0; k < guests[r].size(); ++k)
      if (const Guest &g = guests[r][k]; g.body == static_cast<std::int32_t>(body) && g.rides == rides)
      {
        const auto record = static_cast<std::uint32_t>(x[0].size());
        take[r][k]        = record;
        guest_id.resize(ghosts.size(), 0);
        guest_id.push_back(g.id);
        ghosts.push_back(record, {1, 1, 1}, -1);
        for (int a = 0; a < dim; ++a)
          x[a].push_back(g.x[a]);
      }
  return {begin, x[0].size()};
}

template <int dim>
void Solver<dim>::Implementation::seat_guests()
{
  diagnostics.halo = 0;
  guests.clear();
  if (ranks.alone())
    return;
  halo = Halo(ranks, std::move(give), std::move(take));
  give.clear();
  take.clear();
  diagnostics.halo = halo.taken();
}

template <int dim>
std::int64_t Solver<dim>::Implementation::id_of_record(std::uint32_t record) const
{
  const std::size_t n   = store.size();
  const std::size_t who = record < n ? record : ghosts.parent[record - n];
  return who < n ? store.id[who] : guest_id[who - n];
}

template <int dim>
void Solver<dim>::Implementation::exchange(AlignedVector<double> &records, std::size_t stride, std::size_t first,
                                           std::size_t last) const
{
  if (!ranks.alone())
    halo.copy(records.data(), stride, first, last);
}

template <int dim>
void Solver<dim>::Implementation::exchange(std::vector<std::int64_t> &bits) const
{
  if (ranks.alone())
    return;
  static_assert(sizeof(double) == sizeof(std::int64_t));
  std::vector<double> as_doubles(bits.size());
  std::transform(bits.begin(), bits.end(), as_doubles.begin(), [](std::int64_t b) { return std::bit_cast<double>(b); });
  double *const array[] = {as_doubles.data()};
  halo.copy(std::span<double *const>(array));
  std::transform(as_doubles.begin(), as_doubles.end(), bits.begin(), [](double d) { return std::bit_cast<std::int64_t>(d); });
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void Solver<d>::Implementation::call_guests();                                                    \
  template std::array<std::size_t, 2> Solver<d>::Implementation::place_guests(                               \
    std::size_t, bool, std::array<std::vector<double>, d> &);                                                \
  template void         Solver<d>::Implementation::seat_guests();                                            \
  template std::int64_t Solver<d>::Implementation::id_of_record(std::uint32_t) const;                        \
  template void Solver<d>::Implementation::exchange(AlignedVector<double> &, std::size_t, std::size_t,       \
                                                    std::size_t) const;                                      \
  template void Solver<d>::Implementation::exchange(std::vector<std::int64_t> &) const;
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
