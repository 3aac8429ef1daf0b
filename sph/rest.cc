// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/implementation.h"

#include <algorithm>
#include <cstring>

/// Sweeps left out where nothing has changed. Blocks of particles in the order of the
/// store; a block sees those of its own and of its neighbours' particles, images as
/// their parents. Where no record that the gradient reads has changed by a bit since the last
/// sweep, the sums of that sweep stand; where all that a block sees has no
/// velocity, or no viscous force to correct, energy and correction have nothing to
/// add. So the result is that of all sweeps, to the bit. Pair forces are
/// swept always: their sums are of both ends, and hold the damping rates.
namespace ogive::sph
{
template <int dim>
void Solver<dim>::Implementation::find_blocks()
{
  rest.on = joint && parameters.options.quiescent_skip == "on";
  if (!rest.on)
    return;
  const std::size_t n = store.size(), n_blocks = (n + Rest::block - 1) / Rest::block;
  rest.row.assign(1, 0);
  rest.sees.clear();
  rest.bound.assign(n_blocks, 0);
  rest.has_guests.assign(n_blocks, 0);
  rest.changed.assign(n_blocks, 1);
  std::vector<std::size_t> seen(n_blocks, n_blocks);
  for (std::size_t k = 0; k < n_blocks; ++k)
  {
    for (std::size_t i = k * Rest::block; i < std::min(n, (k + 1) * Rest::block); ++i)
    {
      for (std::size_t p = pairs.rows.row[i]; p < pairs.rows.row[i + 1]; ++p)
      {
        const std::size_t j = pairs.rows.index[p];
        if (j == n + ghosts.size()) // the filling
          continue;
        const std::size_t who = j < n ? j : ghosts.parent[j - n];
        if (who >= n) // of another rank, where nobody watches it for this one
        {
          rest.has_guests[k] = 1;
          continue;
        }
        const std::size_t other = who / Rest::block;
        if (seen[other] == k)
          continue;
        seen[other] = k;
        rest.sees.push_back(static_cast<std::uint32_t>(other));
      }
      for (const auto &m : images)
        if (m.pairs.rows.row.size() > i + 1 && m.pairs.rows.row[i] < m.pairs.rows.row[i + 1])
          rest.bound[k] = 1;
    }
    if (seen[k] != k)
      rest.sees.push_back(static_cast<std::uint32_t>(k));
    rest.row.push_back(rest.sees.size());
  }
}

template <int dim>
std::vector<char> Solver<dim>::Implementation::who_sees(const std::vector<char> &what) const
{
  std::vector<char> awake = rest.has_guests;
  for (std::size_t k = 0; k + 1 < rest.row.size(); ++k)
    for (std::size_t p = rest.row[k]; p < rest.row[k + 1] && !awake[k]; ++p)
      awake[k] = what[rest.sees[p]];
  return awake;
}

template <int dim>
std::vector<char> Solver<dim>::Implementation::blocks_with(const AlignedVector<double> &records, std::size_t stride,
                                                           std::size_t first) const
{
  std::vector<char> any((store.size() + Rest::block - 1) / Rest::block, 0);
  for (std::size_t i = 0; i < store.size(); ++i)
    for (int a = 0; a < dim; ++a)
      any[i / Rest::block] |= records[i * stride + first + a] != 0;
  return who_sees(any);
}

template <int dim>
void Solver<dim>::Implementation::note_motion(std::size_t i, const double *fresh)
{
  double *r = &force_records[i * L::force_stride];
  if (rest.on && std::memcmp(r, fresh, L::n_motion * sizeof(double)) != 0)
    rest.changed[i / Rest::block] = 1;
  std::copy(fresh, fresh + L::n_motion, r);
}

template <int dim>
void Solver<dim>::Implementation::sweep_awake(Function f, AlignedVector<double> &sums, const std::vector<char> *awake)
{
  for (const auto &b : bodies)
  {
    Sweep s = sweep_of(b, pairs, sums.data());
    if (!rest.on || awake == nullptr)
    {
      (b.sweeps.*f)(s);
      continue;
    }
    for (std::size_t first = b.first; first < b.last;)
    {
      const auto  at   = [&](std::size_t i) { return (*awake)[i / Rest::block] != 0; };
      const bool  now  = at(first);
      std::size_t last = first;
      while (last < b.last && at(last) == now)
        last = std::min(b.last, (last / Rest::block + 1) * Rest::block);
      if (now)
      {
        s.begin = first;
        s.end   = last;
        (b.sweeps.*f)(s);
      }
      else
        diagnostics.rows_skipped += last - first;
      diagnostics.rows += last - first;
      first = last;
    }
  }
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void Solver<d>::Implementation::find_blocks();                                                    \
  template std::vector<char> Solver<d>::Implementation::who_sees(const std::vector<char> &) const;           \
  template std::vector<char> Solver<d>::Implementation::blocks_with(const AlignedVector<double> &, std::size_t, std::size_t) const; \
  template void Solver<d>::Implementation::note_motion(std::size_t, const double *);                         \
  template void Solver<d>::Implementation::sweep_awake(Function, AlignedVector<double> &, const std::vector<char> *);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
