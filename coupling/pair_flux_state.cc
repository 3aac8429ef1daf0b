// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "coupling/interface_pair_flux.h"

/// What a pair flux remembers.
namespace ogive::coupling
{
// Lists that were renewed in the last step have no feet yet: the next gather finds them.
template <int dim>
bool PairFluxInterface<dim>::feet_are_current() const
{
  return adopt_ || topology_ == particles_.lists();
}

template <int dim>
void PairFluxInterface<dim>::adopt_feet(bool current)
{
  adopt_    = current;
  topology_ = 0; // of no lists
}

template <int dim>
void PairFluxInterface<dim>::snapshot()
{
  kept_      = energy_;
  kept_feet_ = feet_;
  kept_current_ = feet_are_current();
  kept_edges_ = edges_;
}

template <int dim>
void PairFluxInterface<dim>::restore()
{
  energy_ = kept_;
  feet_   = kept_feet_;
  edges_  = kept_edges_;
  adopt_feet(kept_current_);
}

template <int dim>
void PairFluxInterface<dim>::save(ArchiveWriter &archive, const std::string &prefix) const
{
  std::vector<double>       numbers{energy_.work_on_mesh, energy_.work_on_particles};
  std::vector<std::int64_t> names;
  for (const auto &foot : feet_)
  {
    numbers.insert(numbers.end(), foot.weight.begin(), foot.weight.end());
    names.push_back(foot.id);
    names.insert(names.end(), foot.node.begin(), foot.node.end());
  }
  save_riders(archive, prefix);
  std::vector<double>       areas;
  std::vector<std::int64_t> ends;
  for (const auto &edge : edges_)
  {
    areas.insert(areas.end(), edge.area.begin(), edge.area.end());
    ends.insert(ends.end(), {edge.node[0], edge.node[1], edge.element[0], edge.element[1]});
  }
  archive.write(prefix + "/edges", areas);
  archive.write(prefix + "/edges_ends", ends);
  archive.write(prefix + "/feet", numbers);
  archive.write(prefix + "/feet_current", static_cast<std::int64_t>(feet_are_current()));
  archive.write(prefix + "/feet_names", names);
}

template <int dim>
void PairFluxInterface<dim>::load(const ArchiveReader &archive, const std::string &prefix)
{
  const auto     numbers = archive.doubles(prefix + "/feet");
  const auto     names   = archive.integers(prefix + "/feet_names");
  constexpr auto n       = static_cast<std::size_t>(n_nodes);
  if (names.size() % (n + 1) != 0 || numbers.size() != 2 + names.size() / (n + 1) * n)
    throw InputError("the checkpoint's seam (" + prefix + ") is not that of this scene");
  feet_.resize(names.size() / (n + 1));
  for (std::size_t s = 0; s < feet_.size(); ++s)
  {
    feet_[s].id = names[s * (n + 1)];
    for (std::size_t k = 0; k < n; ++k)
    {
      feet_[s].node[k]   = static_cast<std::uint32_t>(names[s * (n + 1) + 1 + k]);
      feet_[s].weight[k] = numbers[2 + s * n + k];
    }
  }
  load_riders(archive, prefix);
  const auto areas = archive.doubles(prefix + "/edges");
  const auto ends  = archive.integers(prefix + "/edges_ends");
  if (areas.size() * 4 != ends.size() * dim)
    throw InputError("the checkpoint's seam (" + prefix + ") is not that of this scene");
  edges_.resize(ends.size() / 4);
  for (std::size_t e = 0; e < edges_.size(); ++e)
  {
    const auto end = [&](std::size_t k) { return static_cast<std::uint32_t>(ends[4 * e + k]); };
    edges_[e].node    = {end(0), end(1)};
    edges_[e].element = {end(2), end(3)};
    for (int a = 0; a < dim; ++a)
      edges_[e].area[a] = areas[e * dim + a];
  }
  energy_ = kept_ = {numbers[0], numbers[1]};
  adopt_feet(archive.integer(prefix + "/feet_current") != 0);
}

template <int dim>
void PairFluxInterface<dim>::save_riders(ArchiveWriter &archive, const std::string &prefix) const
{
  std::vector<std::int64_t> hosts, facets;
  std::vector<double>       weights, sides;
  for (const auto &rider : riders_)
  {
    hosts.push_back(rider.element);
    hosts.insert(hosts.end(), rider.host.node.begin(), rider.host.node.end());
    weights.insert(weights.end(), rider.host.weight.begin(), rider.host.weight.end());
  }
  for (const auto &facet : seam_)
  {
    facets.push_back(facet.element);
    facets.insert(facets.end(), facet.node.begin(), facet.node.end());
    sides.push_back(facet.outward);
  }
  archive.write(prefix + "/riders", hosts);
  archive.write(prefix + "/rider_weights", weights);
  archive.write(prefix + "/seam", facets);
  archive.write(prefix + "/seam_sides", sides);
  archive.write(prefix + "/damped", std::vector<std::int64_t>(damped_.begin(), damped_.end()));
}

template <int dim>
void PairFluxInterface<dim>::load_riders(const ArchiveReader &archive, const std::string &prefix)
{
  const auto            hosts = archive.integers(prefix + "/riders"), facets = archive.integers(prefix + "/seam"),
             damped  = archive.integers(prefix + "/damped");
  const auto            weights = archive.doubles(prefix + "/rider_weights"), sides = archive.doubles(prefix + "/seam_sides");
  constexpr std::size_t corners = Embedding<dim>::n_nodes, of_facet = n_nodes;
  if (hosts.size() * corners != weights.size() * (corners + 1) || facets.size() != sides.size() * (of_facet + 1))
    throw InputError("the checkpoint's seam (" + prefix + ") is not that of this scene");
  riders_.assign(weights.size() / corners, {});
  for (std::size_t k = 0; k < riders_.size(); ++k)
  {
    riders_[k].element = static_cast<std::uint32_t>(hosts[k * (corners + 1)]);
    for (std::size_t n = 0; n < corners; ++n)
    {
      riders_[k].host.node[n]   = static_cast<std::uint32_t>(hosts[k * (corners + 1) + 1 + n]);
      riders_[k].host.weight[n] = weights[k * corners + n];
    }
  }
  seam_.assign(sides.size(), {});
  for (std::size_t f = 0; f < seam_.size(); ++f)
  {
    seam_[f].element = static_cast<std::uint32_t>(facets[f * (of_facet + 1)]);
    seam_[f].outward = sides[f];
    seam_[f].body    = spec_.mesh;
    for (std::size_t n = 0; n < of_facet; ++n)
      seam_[f].node[n] = static_cast<std::uint32_t>(facets[f * (of_facet + 1) + 1 + n]);
  }
  damped_.assign(damped.begin(), damped.end());
  sort_by_host();
  tell_ports();
}

#define OGIVE_INSTANTIATE(dim)                                                                               \
  template bool PairFluxInterface<dim>::feet_are_current() const;                                            \
  template void PairFluxInterface<dim>::adopt_feet(bool);                                                    \
  template void PairFluxInterface<dim>::snapshot();                                                          \
  template void PairFluxInterface<dim>::restore();                                                           \
  template void PairFluxInterface<dim>::save(ArchiveWriter &, const std::string &) const;                    \
  template void PairFluxInterface<dim>::load(const ArchiveReader &, const std::string &);                    \
  template void PairFluxInterface<dim>::save_riders(ArchiveWriter &, const std::string &) const;             \
  template void PairFluxInterface<dim>::load_riders(const ArchiveReader &, const std::string &);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::coupling
