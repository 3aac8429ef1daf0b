// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/seam_riders.h"

#include <string>
#include <vector>

namespace ogive::coupling
{
/// Riders continue the particles into the mesh (sph::Solver::set_riders): whole
/// particles that stand where elements carry them, with the stress and density of
/// these. So a particle at the seam has a whole neighbourhood and is no particle
/// of a surface. What the riders press it with, F_i, acts on the mesh where the
/// particle's foot on the seam is,
///   f_I -= N_I(y_i) F_i,   sum N_I = 1,
/// so linear momentum is exact. Weights keep to the particle between two
/// renewals of the neighbour lists.
///
/// What the feet give the nodes of a facet is not what a uniform stress would,
/// unless the lattice lies along the seam: the difference in area, d_I, goes
/// along the edges of the seam from node to node. The graph Laplacian
/// L phi = d gives q_e = phi_I - phi_K, and f_I += sigma_e q_e, f_K -= sigma_e q_e
/// with the stress of the elements at the edge.
///
/// Energy is not exact: what a pair with a rider takes from the particle the
/// elements take from elsewhere; the residue is measured. Undamped, in two and
/// three dimensions, such a seam feeds on noise: a viscosity on what pairs at the
/// seam have left of their velocities, and one of the elements next to it, take
/// more than it gives.
template <int dim>
class PairFluxInterface : public Interface<dim>
{
public:
  PairFluxInterface(const InterfaceSpec &, MeshPort<dim> &, ParticlePort<dim> &, Slaves<dim> &);

  void renew() override;
  void gather(Faces<dim> &, const Slaves<dim> &) override;
  void drive(const Faces<dim> &, Slaves<dim> &) const override;
  void close(const Faces<dim> &, const Slaves<dim> &, const TimeStep &) override;

  const InterfaceEnergy &energy() const override { return energy_; }
  void                   snapshot() override;
  void                   restore() override;
  void                   save(ArchiveWriter &, const std::string &prefix) const override;
  void                   load(const ArchiveReader &, const std::string &prefix) override;

  std::size_t n_riders() const { return riders_.size(); }

private:
  static constexpr int n_nodes = Surface<dim>::Facet::n_nodes;

  /// Where the force on a particle acts on the mesh.
  struct Foothold
  {
    std::int64_t                       id = -1; ///< of the particle
    std::array<std::uint32_t, n_nodes> node{};
    std::array<double, n_nodes>        weight{};
  };

  void       board(const Faces<dim> &); ///< riders and damped elements for the seam as it is
  void       sort_by_host();
  void       tell_ports();
  void       take_states(materials::Points &of_riders) const;
  void       damp(const Faces<dim> &, const typename MeshPort<dim>::Cells &);
  void       find_feet(const Faces<dim> &);
  void       balance_areas(const Faces<dim> &);
  void       save_riders(ArchiveWriter &, const std::string &prefix) const;
  void       load_riders(const ArchiveReader &, const std::string &prefix);
  bool       feet_are_current() const;
  void       adopt_feet(bool current);
  Point<dim> velocity_at(const Faces<dim> &, const Foothold &) const;

  InterfaceSpec                                    spec_;
  MeshPort<dim>                                   &mesh_;
  ParticlePort<dim>                               &particles_;
  double                                           spacing_ = 0;
  std::vector<typename Surface<dim>::Facet>        seam_;
  std::vector<RiderPlace<dim>>                     riders_;
  std::vector<std::pair<std::uint32_t, std::vector<std::uint32_t>>> hosts_; ///< element, its riders
  std::vector<std::uint32_t>                       host_elements_; ///< of hosts_
  /// An edge of the seam and the area that it carries from its second to its
  /// first node, m^2.
  struct Edge
  {
    std::array<std::uint32_t, 2> node{}, element{}; ///< elements on either side, the same one twice at a rim
    Point<dim>                   area = Point<dim>::Zero();
    bool operator==(const Edge &) const = default;
  };

  std::vector<Foothold>                            feet_, kept_feet_;
  std::vector<Edge>                                edges_, kept_edges_;
  std::vector<Point<dim>>                          edge_force_, edge_velocity_before_; ///< of the step
  std::uint64_t                                    topology_ = 0;
  bool                                             adopt_ = false; ///< the feet are those of the lists in place
  bool                                             kept_current_ = false;
  std::vector<Point<dim>>                          force_, velocity_before_; ///< of the step, by foothold
  std::vector<std::uint32_t>                       damped_;
  InterfaceEnergy                                  energy_, kept_;
  mutable materials::Points                        state_; ///< scratch
};
} // namespace ogive::coupling
