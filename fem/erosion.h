// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/surface.h"
#include "fem/all_elements.h"
#include "fem/element_group.h"
#include "fem/mesh.h"
#include "fem/nodes.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace ogive::fem
{
/// Elements that leave the mesh: what leaves with them, and the surface that is
/// left. A node keeps the mass of its living elements; without any it has none
/// and takes no part. What has died flies on freely, so its momentum and angular
/// momentum about the origin stay as they were. What has turned into particles
/// is booked by whoever made them; the faces that it leaves are a seam, not a
/// surface.
template <int dim>
class Erosion
{
public:
  using Groups = std::vector<std::unique_ptr<ElementGroup<dim>>>;

  Erosion() = default;
  /// `place`: of each mesh, with the first of 2^dim nodes where dead elements rest.
  Erosion(const std::vector<BodyMesh<dim>> &, const std::vector<GroupPlace> &place, bool axisymmetric);

  bool any() const { return any_; }
  /// Kills what has failed. True if anything died.
  bool kill_failed(const Groups &, Nodes<dim> &);
  /// One that died on a rank: what the others must know of it.
  struct Death
  {
    static constexpr int corners = ElementGroup<dim>::corners;
    std::size_t                        group = 0, cell = 0; ///< of the whole body
    std::array<std::uint32_t, corners> node{};
    std::array<double, corners>        mass{}; ///< kg
    std::array<std::array<double, dim>, corners> x{}, v{};
    double                             energy = 0; ///< J
  };
  /// Own elements that must die, by groups.
  void find_failed(const Groups &, std::vector<std::vector<std::size_t>> &) const;
  /// Kills those of this rank; then all ranks book the deaths of all in the same order.
  std::vector<Death> kill(const Groups &, const std::vector<std::vector<std::size_t>> &, const Nodes<dim> &) const;
  void               book(const Death &, Nodes<dim> &);
  /// Masses that leave the nodes with an element that turned into particles, its own
  /// in `mass` before. ElementGroup::sum_forces and review() are due after the last one.
  void release(const std::array<std::uint32_t, ElementGroup<dim>::corners> &, Nodes<dim> &,
               std::array<double, ElementGroup<dim>::corners> &mass);

  std::size_t converted_elements() const { return static_cast<std::size_t>(gone_[converted]); }
  /// After the state has changed: who lives, and the facets of the living.
  void review(const AllElements<dim> &, Surface<dim> &face);

  void add(Balance &) const;
  /// Mass, energy, number, momentum and angular momentum of the dead; how many
  /// have turned into particles.
  AlignedVector<double> &state() { return gone_; }

private:
  enum Entry : std::size_t
  {
    mass,
    energy,
    number,
    momentum,
    angular = momentum + 3,
    converted = angular + 3,
    entries
  };
  /// A side of an element, the element at its other side (-1: none).
  struct Side
  {
    typename Surface<dim>::Facet facet;
    std::int64_t                 other;
  };

  void list_sides(const BodyMesh<dim> &, const GroupPlace &);
  void   take(Nodes<dim> &, std::uint32_t node, double mass);
  double release(Nodes<dim> &, std::uint32_t node, double share); ///< mass that leaves, kg

  std::vector<input::Erosion> when_;          ///< one a group
  std::vector<std::size_t>    first_element_; ///< one a group
  std::vector<Side>           sides_;
  std::vector<std::uint32_t>  living_;        ///< elements at each node
  std::vector<std::size_t>    failed_;
  AlignedVector<double>       gone_ = AlignedVector<double>(entries, 0.);
  bool                        any_ = false, axisymmetric_ = false;
};
} // namespace ogive::fem
