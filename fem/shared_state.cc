// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "fem/solver_implementation.h"

#include <algorithm>
#include <numeric>
#include <sstream>

/// The state of elements outside their groups, and the way to other ranks.
namespace ogive::fem
{
namespace
{
/// See ElementGroup::for_each_state.
bool of_nodes(const std::string &name)
{
  return name.starts_with("nodal_") || name.starts_with("weak_acceleration_");
}
bool of_elements(const std::string &name)
{
  return !of_nodes(name) && name != "limit";
}

/// Entry j of `width` of element e in packs.
std::size_t slot(std::size_t e, std::size_t j, std::size_t width)
{
  return (e / simd_width * width + j) * simd_width + e % simd_width;
}
} // namespace

template <int dim>
std::vector<std::uint32_t> Solver<dim>::Implementation::own_elements(std::size_t g) const
{
  if (!distribution.alone())
    return distribution.bodies()[g].own;
  std::vector<std::uint32_t> every(groups[g]->size());
  std::iota(every.begin(), every.end(), 0u);
  return every;
}

/// Names and widths of the arrays of each group, agreed on: a rank without elements of a
/// body has none of some arrays.
template <int dim>
std::vector<ElementStore> Solver<dim>::Implementation::layout()
{
  std::ostringstream own;
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    const std::size_t n = groups[g]->size();
    groups[g]->for_each_state(
        [&](const std::string &name, AlignedVector<double> &a)
        {
          if (of_nodes(name))
            own << g << " 0 " << name << '\n';
          else if (of_elements(name) && n > 0)
            own << g << ' ' << a.size() / padded(n) << ' ' << name << '\n';
        });
  }
  const std::string         words = own.str();
  const auto                each = distribution.ranks().gather(std::vector<char>(words.begin(), words.end()));
  std::istringstream        in(std::string(each.begin(), each.end()));
  std::vector<ElementStore> stores(groups.size());
  std::size_t               g, width;
  for (std::string name; in >> g >> width >> name;)
  {
    auto &arrays = of_nodes(name) ? stores.at(g).nodes : stores.at(g).arrays;
    if (std::none_of(arrays.begin(), arrays.end(), [&](const auto &a) { return a.name == name; }))
      arrays.push_back({name, width, {}});
  }
  return stores;
}

template <int dim>
std::vector<ElementStore> Solver<dim>::Implementation::take_state()
{
  auto stores = layout();
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    ElementStore         &store = stores[g];
    const auto            own   = own_elements(g);
    std::array<double, 2> limit{};
    const auto            find = [&](auto &arrays, const std::string &name) -> ElementStore::Array &
    { return *std::find_if(arrays.begin(), arrays.end(), [&](const auto &a) { return a.name == name; }); };
    groups[g]->for_each_state(
        [&](const std::string &name, AlignedVector<double> &a)
        {
          if (name == "limit")
            limit = {a[0], a[0] > 0 ? double(own.at(static_cast<std::size_t>(a[1]))) : -1.};
          else if (of_nodes(name))
            find(store.nodes, name).values.assign(a.begin(), a.end());
          else if (!own.empty())
          {
            auto &array = find(store.arrays, name);
            for (std::size_t e = 0; e < own.size(); ++e)
              for (std::size_t j = 0; j < array.width; ++j)
                array.values.push_back(a[slot(e, j, array.width)]);
          }
        });
    for (const auto &other : distribution.ranks().gather_one(limit))
      if (other[0] > store.bound || (other[0] == store.bound && other[1] < store.element))
      {
        store.bound   = other[0];
        store.element = other[1];
      }
    complete_nodes_of(g, store);
  }
  return stores;
}

/// Arrays of the nodes of a body as their owners have them; forces those of all ranks' elements.
template <int dim>
void Solver<dim>::Implementation::complete_nodes_of(std::size_t g, ElementStore &store) const
{
  if (distribution.alone())
    return;
  const std::size_t          first = parts[g].first_node, n = parts[g].last_node - first;
  std::vector<std::uint32_t> every(n);
  std::iota(every.begin(), every.end(), static_cast<std::uint32_t>(first));
  const auto          list = distribution.list(every);
  std::vector<double> whole(nodes.size());
  for (auto &array : store.nodes)
  {
    std::copy(array.values.begin(), array.values.end(), whole.begin() + static_cast<std::ptrdiff_t>(first));
    for (int i = 0; i < dim; ++i)
      if (array.name == std::string("nodal_force_") + "xyz"[i])
        std::copy_n(total[i].begin() + static_cast<std::ptrdiff_t>(first), n,
                    whole.begin() + static_cast<std::ptrdiff_t>(first));
    double *const arrays[] = {whole.data()};
    distribution.tell(list, arrays);
    array.values.assign(whole.begin() + static_cast<std::ptrdiff_t>(first),
                        whole.begin() + static_cast<std::ptrdiff_t>(first + n));
  }
}

/// Into the groups as they are. The owner of a node gets the forces of all, so that sums
/// over the ranks stay what they are.
template <int dim>
void Solver<dim>::Implementation::give_state(const std::vector<ElementStore> &stores)
{
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    const std::size_t first = parts[g].first_node, n = groups[g]->size();
    const auto        own  = own_elements(g);
    const auto        find = [&](const auto &arrays, const std::string &name) -> const ElementStore::Array &
    {
      const auto at =
          std::find_if(arrays.begin(), arrays.end(), [&](const auto &a) { return a.name == name; });
      require(at != arrays.end(), "the state of elements lacks an array");
      return *at;
    };
    groups[g]->for_each_state(
        [&](const std::string &name, AlignedVector<double> &a)
        {
          if (name == "limit")
          {
            const auto at   = std::lower_bound(own.begin(), own.end(), stores[g].element);
            const bool here = at != own.end() && *at == stores[g].element;
            a[0]            = here ? stores[g].bound : 0.;
            a[1]            = here ? static_cast<double>(at - own.begin()) : 0.;
          }
          else if (of_nodes(name))
          {
            const auto &values = find(stores[g].nodes, name).values;
            const bool  force  = name.starts_with("nodal_force_");
            for (std::size_t k = 0; k < a.size(); ++k)
              a[k] = force && !nodes.counts(first + k) ? 0. : values.at(k);
            for (int i = 0; i < dim && force && !distribution.alone(); ++i)
              if (name.back() == "xyz"[i])
                std::copy(values.begin(), values.end(),
                          total[i].begin() + static_cast<std::ptrdiff_t>(first));
          }
          else if (n > 0)
          {
            const auto &array = find(stores[g].arrays, name);
            require(a.size() == array.width * padded(n), "arrays of elements are of one width");
            for (std::size_t e = 0; e < padded(n); ++e) // copies of the last fill up the pack
              for (std::size_t j = 0; j < array.width; ++j)
                a[slot(e, j, array.width)] = array.values.at(std::min(e, n - 1) * array.width + j);
          }
        });
  }
  if (!distribution.alone())
    fold_total();
}

/// From those who had the elements to those who have them now.
template <int dim>
std::vector<ElementStore> Solver<dim>::Implementation::move_state(const std::vector<ElementStore> &stores,
                                                                  const std::vector<int>          &from) const
{
  const Ranks                     &ranks = distribution.ranks();
  std::vector<std::vector<double>> to(ranks.size());
  std::size_t                      at = 0; // element, body after body
  for (std::size_t g = 0; g < stores.size(); ++g)
  {
    std::size_t row = 0;
    for (const int owner : distribution.bodies()[g].owner)
      if (from[at++] == ranks.rank())
      {
        for (const auto &array : stores[g].arrays)
          to[owner].insert(to[owner].end(),
                           array.values.begin() + static_cast<std::ptrdiff_t>(row * array.width),
                           array.values.begin() + static_cast<std::ptrdiff_t>((row + 1) * array.width));
        ++row;
      }
  }
  const auto                come = ranks.swap(to);
  std::vector<std::size_t>  read(come.size(), 0);
  std::vector<ElementStore> moved = stores;
  at                              = 0;
  for (std::size_t g = 0; g < stores.size(); ++g)
  {
    for (auto &array : moved[g].arrays)
      array.values.clear();
    for (const int owner : distribution.bodies()[g].owner)
    {
      const int source = from[at++];
      if (owner != ranks.rank())
        continue;
      for (auto &array : moved[g].arrays)
      {
        const double *values = come[source].data() + read[source];
        array.values.insert(array.values.end(), values, values + array.width);
        read[source] += array.width;
      }
    }
  }
  return moved;
}

/// All that the state has of nodes, on all ranks.
template <int dim>
void Solver<dim>::Implementation::complete_nodes()
{
  if (distribution.alone())
    return;
  std::vector<double *> arrays;
  for (int i = 0; i < dim; ++i)
  {
    for (auto *field : {&nodes.x[i], &nodes.v[i], &total[i]})
      arrays.push_back(field->data());
    if (parts_of_step.on())
      for (auto *field : {&parts_of_step.shift[i], &parts_of_step.owed[i]})
        arrays.push_back(field->data());
  }
  critical.for_each_state(
      [&](int, AlignedVector<double> &u)
      {
        if (u.size() == nodes.size())
          arrays.push_back(u.data());
      });
  distribution.tell(distribution.all_nodes(), arrays);
}

#define OGIVE_INSTANTIATE(d)                                                                                   \
  template std::vector<std::uint32_t> Solver<d>::Implementation::own_elements(std::size_t) const;              \
  template std::vector<ElementStore>  Solver<d>::Implementation::layout();                                     \
  template std::vector<ElementStore>  Solver<d>::Implementation::take_state();                                 \
  template void                      Solver<d>::Implementation::give_state(const std::vector<ElementStore> &); \
  template std::vector<ElementStore> Solver<d>::Implementation::move_state(                                    \
      const std::vector<ElementStore> &, const std::vector<int> &) const;                                      \
  template void Solver<d>::Implementation::complete_nodes();
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::fem
