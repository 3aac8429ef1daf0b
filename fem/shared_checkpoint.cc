// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "fem/solver_implementation.h"

#include <algorithm>

/// Checkpoints that several ranks wrote or read. A file of one process has elements in
/// packs, one of several has them element after element, those of a rank after those of
/// the one before, with the rank of each in "owners".
namespace ogive::fem
{
namespace
{
enum class Kind
{
  same,  ///< on all ranks
  parts, ///< of a sum over the ranks
  other  ///< of groups, or not in the file
};
Kind kind_of(const std::string &name)
{
  if (name == "work" || name == "wall_force" || name == "parts_error")
    return Kind::parts;
  return name.find('/') != std::string::npos || name.starts_with("element_force_") || name == "age"
             ? Kind::other
             : Kind::same;
}
} // namespace

template <int dim>
void Solver<dim>::Implementation::save_shared(ArchiveWriter &archive, const std::string &prefix)
{
  const Ranks &ranks = distribution.ranks();
  complete_nodes();
  const auto stores = take_state();
  const auto write  = [&](const std::string &name, std::span<const double> values)
  { archive.write(prefix + "/" + name, values); };
  for_each_state(
      [&](const std::string &name, AlignedVector<double> &a)
      {
        if (kind_of(name) == Kind::same)
          write(name, a);
        else if (kind_of(name) == Kind::parts)
        {
          std::vector<double> all(a.begin(), a.end());
          ranks.sum(std::span<double>(all));
          write(name, all);
        }
      });
  write("age", age);
  const std::vector<int>          owners = distribution.owners();
  const std::vector<std::int64_t> rank_of(owners.begin(), owners.end());
  archive.write(prefix + "/owners", std::span<const std::int64_t>(rank_of));
  for (std::size_t g = 0; g < stores.size(); ++g)
  {
    const std::string group = "group" + std::to_string(g) + "/";
    for (const auto &array : stores[g].arrays)
      archive.write_parts(ranks, prefix + "/" + group + array.name, std::span<const double>(array.values));
    for (const auto &array : stores[g].nodes)
      write(group + array.name, array.values);
    const double limit[] = {stores[g].bound, stores[g].element};
    write(group + "limit", limit);
  }
  archive.write(prefix + "/updates", ranks.sum(static_cast<std::int64_t>(updates)));
}

template <int dim>
void Solver<dim>::Implementation::load_shared(const ArchiveReader &archive, const std::string &prefix)
{
  const std::int64_t written_by = archive.integer(prefix + "/ranks");
  for_each_state(
      [&](const std::string &name, AlignedVector<double> &a)
      {
        if (kind_of(name) == Kind::other)
          return;
        const std::vector<double> values = archive.doubles(prefix + "/" + name);
        if (values.size() != a.size())
          throw InputError("checkpoint entry \"" + prefix + "/" + name + "\" has " +
                           std::to_string(values.size()) + " values where the scene's mesh needs " +
                           std::to_string(a.size()));
        std::copy(values.begin(), values.end(), a.begin());
        if (kind_of(name) == Kind::parts && !distribution.ranks().first())
          std::fill(a.begin(), a.end(), 0.);
      });
  age[0] = written_by > 1 ? archive.number(prefix + "/age") : 0.;
  if (!distribution.alone())
  {
    std::vector<int> owners;
    if (written_by == distribution.ranks().size())
    {
      const auto rank_of = archive.integers(prefix + "/owners");
      owners.assign(rank_of.begin(), rank_of.end());
    }
    else
      owners = partition();
    rebuild_groups(owners);
  }
  give_state(read_stores(archive, prefix));
  const auto all = static_cast<std::uint64_t>(archive.integer(prefix + "/updates"));
  updates        = distribution.ranks().first() ? all : 0;
  state_was_changed();
  review_erosion();
}

template <int dim>
std::vector<ElementStore> Solver<dim>::Implementation::read_stores(const ArchiveReader &archive,
                                                                   const std::string   &prefix)
{
  const std::int64_t        written_by = archive.integer(prefix + "/ranks");
  std::vector<std::int64_t> rank_of;
  if (written_by > 1)
    rank_of = archive.integers(prefix + "/owners");
  auto        stores = layout();
  std::size_t before = 0; // elements of the bodies before
  for (std::size_t g = 0; g < stores.size(); ++g)
  {
    const std::size_t n     = all().elements(g);
    const auto        own   = own_elements(g);
    const std::string group = prefix + "/group" + std::to_string(g) + "/";
    // Where each element is in the file.
    std::vector<std::size_t> next(static_cast<std::size_t>(written_by) + 1, 0), place(n);
    for (std::size_t e = 0; e < n && written_by > 1; ++e)
      ++next.at(static_cast<std::size_t>(rank_of.at(before + e)) + 1);
    for (std::size_t r = 1; r < next.size(); ++r)
      next[r] += next[r - 1];
    for (std::size_t e = 0; e < n; ++e)
      place[e] = written_by > 1 ? next[static_cast<std::size_t>(rank_of[before + e])]++ : e;
    for (auto &array : stores[g].arrays)
    {
      const auto        values = archive.doubles(group + array.name);
      const std::size_t rows = written_by > 1 ? n : padded(n), w = array.width;
      if (values.size() != rows * w)
        throw InputError("checkpoint entry \"" + group + array.name + "\" has " +
                         std::to_string(values.size()) + " values where the scene's mesh needs " +
                         std::to_string(rows * w));
      for (const std::uint32_t e : own)
        for (std::size_t j = 0; j < w; ++j)
          array.values.push_back(written_by > 1
                                     ? values[place[e] * w + j]
                                     : values[(e / simd_width * w + j) * simd_width + e % simd_width]);
    }
    for (auto &array : stores[g].nodes)
      array.values = archive.doubles(group + array.name);
    const auto limit  = archive.doubles(group + "limit");
    stores[g].bound   = limit.at(0);
    stores[g].element = limit.at(1);
    before += n;
  }
  return stores;
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void Solver<d>::Implementation::save_shared(ArchiveWriter &, const std::string &);                \
  template void Solver<d>::Implementation::load_shared(const ArchiveReader &, const std::string &);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::fem
