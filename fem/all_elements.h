// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/distribution.h"
#include "fem/element_group.h"

#include <memory>
#include <vector>

namespace ogive::fem
{
/// The cells of all bodies, wherever their elements are kept: those of body g
/// counted from 0.
template <int dim>
class AllElements
{
public:
  using Groups = std::vector<std::unique_ptr<ElementGroup<dim>>>;

  AllElements(const Groups &groups, const Distribution<dim> &distribution)
      : groups_(groups), distribution_(distribution)
  {
  }

  std::size_t bodies() const { return groups_.size(); }
  std::size_t cells(std::size_t g) const
  {
    return distribution_.alone() ? groups_[g]->cells() : distribution_.bodies()[g].alive.size();
  }
  std::size_t elements(std::size_t g) const
  {
    return distribution_.alone() ? groups_[g]->size() : distribution_.bodies()[g].owner.size();
  }
  bool alive(std::size_t g, std::size_t cell) const
  {
    return distribution_.alone() ? groups_[g]->alive(cell) : distribution_.bodies()[g].alive[cell] != 0;
  }
  std::array<std::uint32_t, ElementGroup<dim>::corners> nodes(std::size_t g, std::size_t cell) const
  {
    return distribution_.alone() ? groups_[g]->nodes(cell) : distribution_.nodes(g, cell);
  }

private:
  const Groups            &groups_;
  const Distribution<dim> &distribution_;
};
} // namespace ogive::fem
