// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/simd.h"
#include "fem/element_group.h"
#include "fem/elements/integrated_bound.h"
#include "fem/viscosity/viscosities.h"

namespace ogive::fem
{
/// Elements with several points (full.h, b_bar.h, spectral.h), structure of
/// arrays in packs of `simd_width` elements: a pack's points lie behind each
/// other, lanes are elements. The last pack is filled up with copies of the last
/// element, which no node sums and no balance counts.
template <class Element>
class IntegratedGroup final : public ElementGroup<Element::dim>
{
public:
  static constexpr int dim = Element::dim, nodes_of = Element::nodes, points_of = Element::points;
  using Base = ElementGroup<dim>;
  using typename Base::NodeVisitor;
  using typename Base::Visitor;

  IntegratedGroup(const BodyMesh<dim> &, const GroupPlace &, const input::FemOptions &);

  int                                      body() const override { return body_; }
  std::size_t                              size() const override { return n_; }
  std::size_t                              cells() const override;
  std::array<std::uint32_t, Base::corners> nodes(std::size_t cell) const override;
  void                                     for_each_node(const NodeVisitor &) const override;
  std::span<const double>                  nodal_forces(int i) const override { return nodal_force_[i]; }

  void       lump_mass(Nodes<dim> &) const override;
  void       initialise(const Nodes<dim> &) override;
  double     added_mass() const override { return added_mass_; }
  StepStatus advance(const Nodes<dim> &, const TimeStep &) override;
  StepLimit  stable_dt() const override;
  void       tangent(const Nodes<dim> &, const std::array<AlignedVector<double>, dim> &u, AlignedVector<double> &stiff,
                     AlignedVector<double> &damp) const override;
  void       add_energies(Balance &) const override;
  void       sample(const Nodes<dim> &, Sample &) const override;
  void       for_each_state(const Visitor &) override;
  double     work(std::size_t) const override { return points_of; }
  void       copy_state(std::size_t cell, materials::Points &to, std::size_t k) const override;

private:
  static constexpr std::size_t width = simd_width;
  static constexpr std::size_t cells_of = dim == 1   ? Element::degree :
                                          dim == 2 ? Element::degree * Element::degree :
                                                     Element::degree * Element::degree * Element::degree;

  using Field = VDouble[nodes_of][dim];
  using Point = PointGeometry<Element, VDouble>;
  struct Pack;    ///< what the two halves of a pack hand over
  struct Tangent; ///< of a pack, for small motions

  /// Index of entry k of n of element e in pack order.
  static std::size_t slot(std::size_t e, std::size_t k, std::size_t n)
  {
    return (e / width * n + k) * width + e % width;
  }
  static VDouble load(const double *p) { return VDouble(p, stdx::vector_aligned); }
  static void    store(VDouble v, double *p) { v.copy_to(p, stdx::vector_aligned); }
  /// Place of point q of a pack in the arrays of points.
  static std::size_t at(std::size_t pack, int q) { return (pack * points_of + q) * width; }

  // integrated_nodes.cc
  void    find_rows();
  void    gather(const std::array<AlignedVector<double>, dim> &, std::size_t pack, Field &) const;
  void    scatter(std::size_t pack);
  void    fetch(std::size_t pack);

  VDouble stress_power(std::size_t pack, int q, const VDouble (&strain)[6]) const;
  VDouble internal_work(std::size_t pack, const Field &v_mean, double kick) const;
  bool    strain(const Nodes<dim> &, const TimeStep &, std::size_t pack, Pack &);
  void    book_energy(std::size_t pack, VDouble work, const Pack &);
  void    stress(std::size_t pack, const Field &x, const Pack &, double dt);
  void    viscosity(std::size_t pack, const Field &x, const Pack &, double dt, VDouble (&q)[points_of]);
  void    start(const Nodes<dim> &);
  void    scale_mass(std::size_t pack, VDouble damping, VDouble frequency2);
  void    limit_by(std::size_t pack, VDouble damping, VDouble frequency2);
  VDouble inverse_node_masses(std::size_t pack, VDouble (&inverse)[nodes_of]) const;

  void    linearise(std::size_t pack, const Field &x, const Field &u, Tangent &) const;

  StepStatus fail(const Nodes<dim> &, std::size_t e, const char *why) const;
  StepStatus first_bad(const Nodes<dim> &, std::size_t pack) const;

  int                                        body_;
  std::size_t                                n_, padded_n_, first_element_, first_node_;
  std::shared_ptr<const materials::Material> material_;
  input::FemOptions                          options_;
  AnyBulkViscosity                           bulk_;
  double                                     shear_modulus_, line_ = 0;
  double scaling_ = 0, added_mass_ = 0; ///< 2/dt (1/s) while masses are sought; kg

  static constexpr std::uint32_t no_row = 0xffffffff;
  std::vector<std::uint32_t> node_;             ///< packs of nodes
  std::vector<std::uint32_t> row_;              ///< as in OnePointGroup
  AlignedVector<double>      node_mass_;        ///< kg, packs of nodes
  AlignedVector<double>      point_mass_;       ///< kg, packs of points

  materials::Points     points_;                ///< packs of points
  AlignedVector<double> node_force_;            ///< N at t_n, packs of nodes x dim
  std::array<AlignedVector<double>, dim> nodal_force_; ///< their sums at the body's nodes
  AlignedVector<double> viscous_pressure_;      ///< Pa, packs of points
  AlignedVector<double> half_work_;             ///< J: half of the power of t_n times the last strains
  AlignedVector<double> half_viscous_;          ///< J, the viscous part of it
  AlignedVector<double> viscous_heat_;          ///< J, packs of points
  AlignedVector<double> limit_;                 ///< largest 2/dt (1/s) and the element that sets it
};

/// Largest eigenvalue of a line of unit modulus and density on [-1, 1].
double line_eigenvalue(int degree);
} // namespace ogive::fem
