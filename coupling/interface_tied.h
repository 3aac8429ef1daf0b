// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/interface.h"

#include <string>
#include <vector>

namespace ogive::coupling
{
/// The baseline: the particles next to the seam, those less than one spacing
/// from the mesh's facets, are slaves that ride the element behind the facet,
///   v_s = sum N_I v_I,   f_I += N_I f_s,   m_I += N_I m_s,
/// with sum N_I = 1 and sum N_I x_I = x_s (N slightly extrapolated). The force
/// is the transpose of the motion, so linear momentum, the moment of the forces
/// and the power are exact: N moves with the material.
///
/// Mass is lumped by the same weights; some may be negative, so every node that
/// takes part is checked for positive total mass (InputError).
template <int dim>
class TiedInterface : public Interface<dim>
{
public:
  TiedInterface(const InterfaceSpec &, MeshPort<dim> &, ParticlePort<dim> &, Slaves<dim> &);

  void gather(Faces<dim> &, const Slaves<dim> &) override;
  void drive(const Faces<dim> &, Slaves<dim> &) const override;
  void close(const Faces<dim> &, const Slaves<dim> &, const TimeStep &) override;

  const InterfaceEnergy &energy() const override { return energy_; }
  void                   snapshot() override { kept_ = energy_; }
  void                   restore() override { energy_ = kept_; }
  void                   save(ArchiveWriter &, const std::string &prefix) const override;
  void                   load(const ArchiveReader &, const std::string &prefix) override;

  std::size_t                       n_slaves() const { return embedding_.size(); }
  const std::vector<Embedding<dim>> &embeddings() const { return embedding_; }

protected:
  /// For others that choose slaves in their own way.
  explicit TiedInterface(const Slaves<dim> &slaves) : first_(slaves.id.size()) {}
  /// Asks for the motion of the nodes that carry.
  void follow(const InterfaceSpec &, MeshPort<dim> &) const;

  std::size_t                 first_ = 0; ///< of this interface's range in Slaves
  std::vector<std::int64_t>   id_;
  std::vector<Embedding<dim>> embedding_;

private:
  struct Seam; // what is needed only while particles are chosen
  void choose(const InterfaceSpec &, Seam &, MeshPort<dim> &, Slaves<dim> &);
  void give_mass(const InterfaceSpec &, const Seam &, MeshPort<dim> &);

  Point<dim> carried(const Faces<dim> &, const Embedding<dim> &) const;
  Point<dim> slave_velocity(const Faces<dim> &, std::size_t s) const;

  // Of the present step, at t_{n-1/2}.
  std::vector<Point<dim>> node_velocity_before_, slave_velocity_before_;
  InterfaceEnergy         energy_, kept_;
};
} // namespace ogive::coupling
