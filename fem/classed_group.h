// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/element_group.h"

#include <array>
#include <memory>
#include <vector>

namespace ogive::fem
{
/// The elements of a body, each in the class of its own step (fem/local_steps.h):
/// a group of the body's formulation for each class, so that packs and blocks are
/// of one class and kernels know nothing of it. Elements are counted as in the body.
template <int dim>
class ClassedGroup final : public ElementGroup<dim>
{
public:
  using ElementGroup<dim>::corners;
  using typename ElementGroup<dim>::Visitor;
  using typename ElementGroup<dim>::NodeVisitor;
  static constexpr int n_classes = 4; ///< of steps h, 2 h, 4 h, 8 h

  /// All elements are of class 0. `whole`: their group.
  ClassedGroup(BodyMesh<dim>, const GroupPlace &, const input::FemOptions &, std::unique_ptr<ElementGroup<dim>> whole);

  /// A class: a group of elements, none where there are no such.
  struct Class
  {
    std::unique_ptr<ElementGroup<dim>> group;
    std::vector<std::uint32_t>         elements;       ///< of the body, ascending
    std::size_t                        first_node = 0; ///< of all, of entry 0 of the nodal forces
  };
  const std::array<Class, n_classes> &classes() const { return classes_; }
  /// Class of each element.
  const std::vector<unsigned char> &layout() const { return layout_; }
  /// Calls f(node) for the corners of an element, nodes counted over all bodies.
  template <class F>
  void for_each_corner(std::size_t e, F &&f) const
  {
    for (std::size_t k = e * corners; k < (e + 1) * corners; ++k)
      f(place_.first_node + mesh_.cells[k]);
  }
  /// Moves elements, with their history, to the groups of these classes.
  void arrange(const std::vector<unsigned char> &layout);
  /// 2/dt of each element by the body's count, 1/s.
  void collect_bounds(std::vector<double> &) const;
  /// Takes the step of one class; entities of its status are those of the body.
  StepStatus advance_class(std::size_t c, const Nodes<dim> &, const TimeStep &);
  StepLimit  stable_dt_of(std::size_t c) const;

  int                                body() const override { return body_; }
  std::size_t                        size() const override { return layout_.size(); }
  std::array<std::uint32_t, corners> nodes(std::size_t e) const override;
  /// Forces of the body are those of its classes.
  std::span<const double> nodal_forces(int) const override;
  void                    for_each_node(const NodeVisitor &) const override;
  void                    lump_mass(Nodes<dim> &) const override;
  void                    initialise(const Nodes<dim> &) override;
  double                  added_mass() const override;
  StepStatus              advance(const Nodes<dim> &, const TimeStep &) override;
  StepLimit               stable_dt() const override;
  void tangent(const Nodes<dim> &, const std::array<AlignedVector<double>, dim> &u, AlignedVector<double> &stiff,
               AlignedVector<double> &damp) const override;
  void add_energies(Balance &) const override;
  void sample(const Nodes<dim> &, Sample &) const override;
  void for_each_state(const Visitor &) override;
  void copy_state(std::size_t e, materials::Points &to, std::size_t k) const override;
  void add_damping_stress(std::size_t e, materials::Points &to, std::size_t k) const override;
  void damp(std::span<const std::size_t>, double share) override;
  void weigh(std::span<const std::size_t>, std::span<const double>, Nodes<dim> &) override;

private:
  /// Where an element is.
  struct Place
  {
    std::uint32_t of_class, element;
  };
  Class   build(const std::vector<std::uint32_t> &elements) const;
  Culprit renamed(Culprit, std::size_t c) const;
  /// f(class) for those with elements.
  template <class F>
  void for_each_class(F &&f) const
  {
    for (const Class &c : classes_)
      if (c.group)
        f(c);
  }

  int                          body_;
  BodyMesh<dim>                mesh_; ///< undeformed
  GroupPlace                   place_;
  input::FemOptions            options_;
  std::array<Class, n_classes> classes_;
  std::vector<Place>           where_;
  std::vector<unsigned char>   layout_;
  AlignedVector<double>        state_; ///< the layout, as the archive has it
};
} // namespace ogive::fem
