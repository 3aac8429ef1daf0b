// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/parallel/ranks.h"
#include "coupling/search.h"
#include "coupling/surfaces.h"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ogive::coupling
{
/// What one rank has of the particles, made common to all ranks as far as the
/// coupling layer can need it: the particles that others come near to, those at a
/// seam, all slaves, and whole bodies that meet themselves. They stand in the order
/// of their ids, so what is computed from them does not depend on the number of
/// ranks. Until attend() all particles are common: sizes and overlaps at the start.
///
/// Who belongs to it is settled anew when the lists of the solver are, and when
/// anything has moved by `slack` since. In between one message of all ranks a look:
/// (number, x, v) at t_n, (number, v) after the step. Numbers go along, so a
/// particle may change its rank at any time.
template <int dim>
class CommonParticles : public ParticlePort<dim>
{
public:
  using Facet = typename Surface<dim>::Facet;
  using typename ParticlePort<dim>::Riders;
  using typename ParticlePort<dim>::Lattice;
  using typename ParticlePort<dim>::NearSeam;

  /// `own`: shows the particles of this rank alone; its other functions take and
  /// give the same on all ranks.
  CommonParticles(const Ranks &, std::unique_ptr<ParticlePort<dim>> own);

  Surface<dim>                   surface() override;
  std::span<const std::uint32_t> index_of_id() const override { return index_; }
  std::span<const double>        damage() const override { return damage_; }
  std::span<const double>        widest() const override { return widest_; }
  std::uint64_t                  lists() override;
  std::uint64_t                  lists_met() override { return lists_; }
  void                           meet(const Surface<dim> &mesh) override;
  void                           meet_again() override;
  void                           give_forces() override;
  void                           attend(std::vector<Attention>) override;
  void                           attend_seam(const std::string &name, NearSeam) override;
  void                           forget() override { stale_ = true; }
  void seam_forces(int body, const std::array<std::span<double>, dim> &) const override;
  void seam_normals(int body, const std::array<std::span<double>, dim> &) override;
  void set_slaves(std::span<const std::int64_t> ids) override;

  // Of all ranks as they are.
  StepLimit stable_dt() const override { return own_->stable_dt(); }
  void      drive_slaves(const std::array<std::span<const double>, dim> &v) override { own_->drive_slaves(v); }
  void      slave_forces(const std::array<std::span<double>, dim> &f) const override { own_->slave_forces(f); }
  void      set_pieces(std::span<const std::int64_t> pieces) override { own_->set_pieces(pieces); }
  void      set_riders(const sph::Newcomers<dim> &in) override;
  Riders    riders(int body) override { return own_->riders(body); }
  void      set_seam_hourglass(int body, double c) override { own_->set_seam_hourglass(body, c); }
  double    seam_work(int body) const override { return own_->seam_work(body); }
  Lattice   lattice(int body) const override { return own_->lattice(body); }
  void      weigh(std::span<const std::int64_t> ids, std::span<const double> s) override { own_->weigh(ids, s); }

  std::size_t   size() const { return id_.size(); } ///< particles that are common now
  std::uint64_t settled() const { return settled_; } ///< how often it was settled who is

private:
  using Boxes = std::vector<Box<dim>>; ///< by body

  bool                    idle() const;
  void                    set_slack();
  bool                    moved(const Surface<dim> &own, const Surface<dim> &mesh) const;
  void                    settle(const Surface<dim> &own, const Surface<dim> &mesh);
  std::vector<char>       chosen(const Surface<dim> &own, const Surface<dim> &mesh) const;
  Boxes                   body_boxes(const Surface<dim> &own) const;
  void near_mesh(const Attention &, const Surface<dim> &own, const Surface<dim> &mesh, const Boxes &,
                 std::vector<char> &) const;
  void near_particles(const Attention &, const Surface<dim> &own, const Boxes &, std::vector<char> &) const;
  void near_facets(int body, const std::vector<Facet> &, double reach, const Surface<dim> &own,
                   const Surface<dim> &mesh, const Boxes &, std::vector<char> &) const;
  void collect(const Surface<dim> &own, const std::vector<char> &take);
  void renew_index();
  void note_places(const Surface<dim> &own, const Surface<dim> &mesh);
  void find_own(const Surface<dim> &own) const;
  void share(const Surface<dim> &own, bool places);
  void spread(const std::array<std::vector<double>, dim> &of_own, const std::array<std::span<double>, dim> &to,
              const Surface<dim> &own) const;

  Ranks                              ranks_;
  std::unique_ptr<ParticlePort<dim>> own_;
  bool                               everyone_ = true, watches_damage_ = false;
  std::vector<Attention>             wanted_;
  std::map<std::string, NearSeam>    seams_;
  std::vector<std::int64_t>          slaves_; ///< ascending
  double                             slack_ = 0; ///< m
  bool                               stale_ = true;

  // The common particles, by ascending id.
  std::array<std::vector<double>, dim> x_, v_, force_;
  std::vector<double>                  mass_, radius_, damage_, widest_;
  std::vector<int>                     body_;
  std::vector<std::int64_t>            id_;
  std::vector<std::uint32_t>           contact_points_;
  std::vector<std::uint32_t>           index_; ///< number of an id, or none
  std::uint64_t                        topology_ = 0, lists_ = 0, settled_ = 0;

  // Of this rank.
  std::uint64_t                        own_lists_ = 0; ///< topology of the solver as it was seen last
  mutable std::vector<std::pair<std::uint32_t, std::uint32_t>> of_own_; ///< own index, number
  mutable std::uint64_t                paired_ = 0, paired_with_ = 0; ///< topologies of both for which of_own_ holds
  std::array<std::vector<double>, dim> x_settled_;
  std::vector<Point<dim>>              mesh_settled_; ///< corners of the facets
  std::uint64_t                        mesh_lists_ = 0;
};
} // namespace ogive::coupling
