// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/simd.h"
#include "fem/element_group.h"
#include "fem/elements/hex8_modes.h"
#include "fem/quiet_blocks.h"
#include "fem/viscosity/viscosities.h"

namespace ogive::fem
{
/// One-point elements, structure of arrays in packs of `simd_width` elements.
/// The last pack is filled up with copies of the last element, which no node
/// sums and no balance counts.
template <class Element>
class OnePointGroup final : public ElementGroup<Element::dim>
{
public:
  static constexpr int dim = Element::dim, corners = Element::corners, modes = Element::modes;
  using typename ElementGroup<dim>::Visitor;

  OnePointGroup(const BodyMesh<dim> &, const GroupPlace &, const input::FemOptions &);

  int                                body() const override { return body_; }
  std::size_t                        size() const override { return n_; }
  std::array<std::uint32_t, corners> nodes(std::size_t e) const override;
  void for_each_node(const typename ElementGroup<dim>::NodeVisitor &) const override;
  std::span<const double> nodal_forces(int i) const override { return nodal_force_[i]; }

  void       lump_mass(Nodes<dim> &) const override;
  void       weigh(std::span<const std::size_t>, std::span<const double>, Nodes<dim> &) override;
  void       initialise(const Nodes<dim> &) override;
  double     added_mass() const override { return added_mass_; }
  StepStatus advance(const Nodes<dim> &, const TimeStep &) override;
  StepLimit  stable_dt() const override;
  void       tangent(const Nodes<dim> &, const std::array<AlignedVector<double>, dim> &u, AlignedVector<double> &stiff,
                     AlignedVector<double> &damp) const override;
  void       add_energies(Balance &) const override;
  void       sample(const Nodes<dim> &, Sample &) const override;
  void       for_each_state(const Visitor &) override;

  void copy_state(std::size_t e, materials::Points &to, std::size_t k) const override;
  void add_damping_stress(std::size_t e, materials::Points &to, std::size_t k) const override;
  void damp(std::span<const std::size_t>, double share) override;

  using typename ElementGroup<dim>::Remains;
  void    prepare_erosion(Nodes<dim> &) override;
  void    find_failed(const input::Erosion &, std::vector<std::size_t> &) const override;
  Remains kill(std::size_t e) override;
  void    measure(const input::Conversion &, std::vector<double> &) const override;
  Remains remains(std::size_t e) const override;
  bool    alive(std::size_t e) const override { return alive_.empty() || alive_[e] > 0; }
  void    sum_forces() override;
  void    rebury() override;
  void    wake() override { quiet_.wake(); }
  std::size_t skipped() const override { return skipped_; }

private:
  static constexpr std::size_t width       = simd_width;
  static constexpr std::size_t block_packs = 16; ///< packs between two calls of the material

  static constexpr std::uint32_t no_row = 0xffffffff;

  /// Corner positions or velocities of a pack; shape and rates of a pack.
  using Corners = VDouble[corners][dim];
  using Shape   = typename ShapeOf<Element, VDouble>::type;
  using Motion  = Deformation<Element, VDouble>;
  static constexpr bool area_weighted = requires { Element::area_weighted; };
  static constexpr bool modal         = std::is_same_v<Shape, ModalShape<VDouble>>;
  struct Block; ///< what the two halves of a block hand over

  /// Index of entry k of n of element e in pack order.
  static std::size_t slot(std::size_t e, std::size_t k, std::size_t n)
  {
    return (e / width * n + k) * width + e % width;
  }
  static VDouble load(const double *p) { return VDouble(p, stdx::vector_aligned); }
  static void    store(VDouble v, double *p) { v.copy_to(p, stdx::vector_aligned); }

  StepStatus take(const Nodes<dim> &, const TimeStep &);
  StepStatus take_block(const Nodes<dim> &, const TimeStep &, std::size_t begin, std::size_t count, Block &);
  // one_point_quiet.cc
  bool       quiet(const Nodes<dim> &, std::size_t begin, std::size_t count);
  StepStatus take_quiet(const Nodes<dim> &, const TimeStep &, std::size_t begin, std::size_t count, Block &);
  template <class F>
  void       for_each_history(F &&);
  void       join_limit(const std::array<double, 2> &);

  void    find_rows();
  void    set_masses(const BodyMesh<dim> &);
  void    scatter(std::size_t begin, std::size_t count, const double *forces);
  void    scatter_shares(std::size_t begin, std::size_t count, const double *forces);
  double  share(std::size_t e) const { return share_.empty() ? 1. : share_[e]; }
  void    weigh(const Nodes<dim> &);
  void    gather(const std::array<AlignedVector<double>, dim> &, std::size_t pack, Corners &,
                 std::size_t first = 0) const;
  template <bool corrected>
  bool    strain(const Nodes<dim> &, const TimeStep &, std::size_t pack, Block &, std::size_t held);
  bool    keeps_forces() const { return !corner_force_.empty(); }
  /// Where the corner forces of a pack go: to their array, or to `scratch` where none is kept.
  double *forces_of(std::size_t pack, double *scratch)
  {
    return keeps_forces() ? &corner_force_[pack * corners * dim * width] : scratch;
  }
  VDouble power_of_forces(std::size_t pack, const Corners &v) const;
  VDouble power_of_stress(std::size_t pack, const VDouble (&X)[7][3], const VDouble (&V)[7][3], double drift) const;
  void    book_energy(std::size_t pack, VDouble work, VDouble correction, const Shape &, const Motion &);
  template <bool corrected>
  void    stress(std::size_t pack, const Shape &, const Motion &, double dt, double *forces);
  Gram<Element, VDouble> inverse_mass_gram(std::size_t pack, const Shape &,
                                           const Gram<Element, VDouble> &unit) const;

  void start(const Nodes<dim> &);
  void scale_mass(std::size_t pack, VDouble damping, VDouble frequency2);
  void fetch(std::size_t begin, std::size_t count);
  /// Whether the elements of all ranks are well, where sums over these follow.
  bool agreed(bool ok) const
  {
    return shared_ && (area_weighted || corrected_) ? shared_->ranks().all(ok) : ok;
  }
  /// Points the corners of e to its own nodes or to the grave.
  void bury(std::size_t e);

  VDouble add_damping(std::size_t pack, const VDouble &length, const Motion &, VDouble (&sigma)[6]);
  void    prepare_damping();
  VDouble half_damping(std::size_t pack, const Motion &) const;

  // one_point_correction.cc
  VDouble weak_share(const VDouble &length, const VDouble &rate, const VDouble &sound_speed) const;
  void    add_weak(std::size_t pack, const Shape &, const VDouble &pressure);
  void    pair_forces(std::size_t pack, const Corners &acceleration, Corners &force) const;
  VDouble correction_work(std::size_t pack, const Corners &v, double kick) const;
  void    correct(const Nodes<dim> &);

  StepStatus fail(const Nodes<dim> &, std::size_t e, const char *why) const;
  StepStatus first_bad(const Nodes<dim> &, std::size_t pack) const;

  int                                        body_;
  std::size_t                                n_, padded_n_, first_element_, first_node_;
  const SharedNodes                         *shared_;
  const std::vector<std::uint32_t>          *own_elements_;
  std::shared_ptr<const materials::Material> material_;
  input::FemOptions                          options_;
  AnyBulkViscosity                           bulk_;
  bool                                       viscous_hourglass_, corrected_, split_;
  double                                     shear_modulus_, hourglass_modulus_;
  double                                     rest_; ///< density of the undeformed material, kg/m^3
  QuietBlocks                                quiet_;
  std::size_t                                skipped_ = 0; ///< elements that the last step left out

  std::vector<std::uint32_t> node_;         ///< packs of corners
  std::vector<std::uint32_t> row_;          ///< first node of a pack at a corner where the others follow it in memory
  AlignedVector<double>      mass_;         ///< kg
  AlignedVector<double>      corner_mass_;  ///< kg, packs of corners; axial symmetry only
  AlignedVector<double>      inertia_;      ///< kg; empty where no mass is added
  double                     scaling_ = 0, added_mass_ = 0; ///< 2/dt (1/s) while masses are sought; kg

  materials::Points     points_;
  AlignedVector<double>      corner_force_; ///< N at t_n, packs of corners x dim; empty where state and shape give them back
  std::array<AlignedVector<double>, dim> nodal_force_; ///< N at t_n, sums over the corners at the body's nodes
  std::vector<double>   ring_mass_, section_mass_; ///< kg, kg/m at the body's nodes; area-weighted only
  std::vector<double>   share_;             ///< see ElementGroup::weigh; empty: 1
  AlignedVector<double> Q_;                 ///< hourglass forces, N, packs of modes x dim
  AlignedVector<double> viscous_pressure_;  ///< Pa
  AlignedVector<double> damping_share_; ///< see damp(); empty: none
  std::array<AlignedVector<double>, 6> damping_stress_; ///< Pa, of the last step
  AlignedVector<double> weak_pressure_;     ///< Pa: the part of it that is corrected
  std::array<AlignedVector<double>, dim> weak_force_, weak_acceleration_; ///< N, m/s^2 at t_n, by that part alone
  AlignedVector<double> half_correction_;   ///< W: half of the power of the corrected forces at the last velocities
  AlignedVector<double> half_hourglass_;    ///< J: half of Q_n times the last rates
  AlignedVector<double> half_viscous_;      ///< J: half of q_n times the last volume change
  AlignedVector<double> half_power_;        ///< W: half of what the forces of t_n give the element at the last velocities
  AlignedVector<double> hourglass_energy_;  ///< J
  AlignedVector<double> viscous_heat_;      ///< J
  AlignedVector<double> limit_;             ///< largest 2/dt (1/s) and the element that sets it

  // A dead element is a virgin one that rests at nodes of its own: the loops
  // over packs need no branch and no mask.
  std::size_t                grave_;   ///< its first node
  struct Model                         ///< the element whose shape it has
  {
    std::size_t element = 0;           ///< within the body
    double mass = -1, inertia = 0;     ///< kg
    double corner_mass[corners] = {};  ///< kg, axial symmetry only
    double x[corners][dim]      = {};  ///< m
  };
  Model                      model_;
  bool                       by_step_; ///< elements may leave by their bound of the step
  std::vector<std::uint32_t> own_;     ///< node_ while all live; empty where none can die
  AlignedVector<double>      alive_;   ///< 1 or 0, empty where none can die
  AlignedVector<double>      bound_;   ///< 2/dt of each element, 1/s; where by_step_
};

/// What the strain half of a block hands to the material and to the stress half.
template <class Element>
struct OnePointGroup<Element>::Block
{
  static constexpr std::size_t n = block_packs * width;
  alignas(64) double strain[6][n], spin[3][n], density[n], force[corners * dim * n];
  Shape  shape[block_packs];
  Motion motion[block_packs];
};
} // namespace ogive::fem
