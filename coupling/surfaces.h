// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/culprit.h"
#include "core/base/error.h"
#include "core/base/surface.h"
#include "core/materials/points.h"
#include "sph/newcomers.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace ogive::coupling
{
/// A position, velocity or force of dim components, SI.
template <int dim>
using Point = Eigen::Matrix<double, dim, 1>;

/// The two solvers that the coupling layer joins.
enum Party : int
{
  mesh_party     = 0,
  particle_party = 1
};

/// Nodes and weights of the mesh element with which a point moves: the weights
/// sum to 1 and sum(weight * x) is the point.
template <int dim>
struct Embedding
{
  static constexpr int                n_nodes = 1 << dim;
  std::array<std::uint32_t, n_nodes>  node{};
  std::array<double, n_nodes>         weight{};
};

/// What the coupling layer asks of a finite element solver. A thin adapter of
/// the solver in a run, a few hand-made arrays in a test.
template <int dim>
class MeshPort
{
public:
  virtual ~MeshPort()                                                                       = default;
  virtual Surface<dim> surface()                                                            = 0;
  virtual StepLimit    stable_dt() const                                                    = 0;
  virtual void         add_mass(std::uint32_t node, double mass)                            = 0;
  virtual bool         embed(std::uint32_t element, const std::array<double, dim> &point, double reach,
                             Embedding<dim> &result) const = 0;

  /// The elements of a body that live, their corners in VTK order.
  struct Cells
  {
    std::vector<std::uint32_t>                         element;
    std::vector<std::array<std::uint32_t, (1 << dim)>> node;
  };
  // Asked by interfaces that continue particles into the mesh.
  virtual Cells cells(int) const { throw InputError("this mesh does not name its cells"); }
  /// State of an element with all the stress that it presses its neighbours with.
  virtual void  copy_state(std::uint32_t, materials::Points &, std::size_t) const {}
  /// The same of several, entry k for the k-th; called by all ranks alike.
  virtual void  copy_states(std::span<const std::uint32_t> elements, materials::Points &to) const
  {
    for (std::size_t k = 0; k < elements.size(); ++k)
      copy_state(elements[k], to, k);
  }
  /// From now on the motion of these nodes is asked for after each step, too, on all
  /// ranks: of those that particles ride on. Replaces what `who` asked for before.
  virtual void  follow(const std::string & /*who*/, std::span<const std::uint32_t>) {}
  virtual void  damp(int, std::span<const std::uint32_t>, double) {}
  /// See fem::Solver.
  virtual void weigh(int, std::span<const std::uint32_t>, std::span<const double>)
  {
    throw InputError("these elements share nothing");
  }
};

/// Particles of a body that contact with another body asks for: those within
/// `reach` (m) of its facets, or of its particles; all of them where it is infinite.
struct Attention
{
  int    body  = 0, other = 0; ///< index into Scene::bodies
  Party  party = mesh_party;   ///< what of the other body
  double reach = 0;
};

/// What the coupling layer asks of a particle solver. Where ranks share the
/// particles, surface() is common to all of them (coupling/common_particles.h) and
/// all functions are called by all ranks alike; the functions under "Ranks" then
/// say when it has to be brought up to date, and who must be in it.
template <int dim>
class ParticlePort
{
public:
  virtual ~ParticlePort()                                                                  = default;
  virtual Surface<dim> surface()                                                           = 0;
  virtual StepLimit    stable_dt() const                                                   = 0;
  virtual void         set_slaves(std::span<const std::int64_t> ids)                       = 0;
  virtual void         drive_slaves(const std::array<std::span<const double>, dim> &v)     = 0;
  virtual void         slave_forces(const std::array<std::span<double>, dim> &force) const = 0;
  virtual std::span<const std::uint32_t> index_of_id() const                               = 0;
  /// Damage of each particle by its present index; empty where nothing breaks.
  virtual std::span<const double> damage() const { return {}; }
  /// By id: pairs of two labels, neither negative, are contact's from now on.
  virtual void set_pieces(std::span<const std::int64_t>) {}

  /// See sph::Solver.
  struct Riders
  {
    std::array<std::span<double>, dim> velocity;
    materials::Points                 *state = nullptr;
  };
  virtual void   set_riders(const sph::Newcomers<dim> &) { throw InputError("these particles take no riders"); }
  virtual Riders riders(int) { return {}; }
  virtual void   set_seam_hourglass(int, double) {}
  virtual void   seam_forces(int, const std::array<std::span<double>, dim> &) const {}
  virtual void   seam_normals(int, const std::array<std::span<double>, dim> &) {}
  virtual double seam_work(int) const { return 0; }
  virtual void   weigh(std::span<const std::int64_t>, std::span<const double>)
  {
    throw InputError("these particles share nothing");
  }
  /// Distances of the layers of a body's lattice at the start, m, and how far its
  /// particles reach, m.
  struct Lattice
  {
    std::array<double, dim> cell{};
    double                  reach = 0;
  };
  virtual Lattice lattice(int) const { return {}; }

  // Ranks.
  /// Changes whenever the solver has renewed the lists of its pairs: as it is now,
  /// and as it was at the last meet().
  virtual std::uint64_t lists() { return surface().topology; }
  virtual std::uint64_t lists_met() { return surface().topology; }
  /// Before surface() is asked for at t_n: who matters now, and where they are.
  virtual void meet(const Surface<dim> & /*mesh*/) {}
  /// Before it is asked for after a step: velocities of the same particles.
  virtual void meet_again() {}
  /// Surface::force is complete: to those who own the particles.
  virtual void give_forces() {}
  virtual void attend(std::vector<Attention>) {}
  /// Particles of a body near a seam, within `reach` (m) of its facets.
  struct NearSeam
  {
    int                                       body  = 0;
    std::vector<typename Surface<dim>::Facet> facets;
    double                                    reach = 0;
  };
  virtual void attend_seam(const std::string & /*name*/, NearSeam) {}
  /// Largest radius of each body's particles so far, m; empty: as surface() has it.
  virtual std::span<const double> widest() const { return {}; }
  /// The solver went back or was loaded.
  virtual void forget() {}
};

/// The surfaces of both parties as they are now; the one of an absent party
/// has no points.
template <int dim>
struct Faces
{
  std::array<Surface<dim>, 2>    of;
  std::span<const std::uint32_t> particle_index; ///< present index of each particle id
  std::span<const double>        damage;         ///< of the particles; empty: none
  /// Of the forces that the particle solver found at t_n, as far as others take
  /// them from it: 1, or in a part of a step what acts in that part.
  double particle_share = 1;
  std::span<const double> widest;         ///< see ParticlePort
  std::uint64_t           particle_lists = 0; ///< ParticlePort::lists_met()

  static Faces look(MeshPort<dim> *mesh, ParticlePort<dim> *particles);
  /// After the step: points of the last look, with their velocities of now.
  static Faces look_again(MeshPort<dim> *mesh, ParticlePort<dim> *particles);

  Surface<dim>       &operator[](int party) { return of[party]; }
  const Surface<dim> &operator[](int party) const { return of[party]; }

  Point<dim> position(int party, std::uint32_t i) const
  {
    Point<dim> p;
    for (int a = 0; a < dim; ++a)
      p[a] = of[party].x[a][i];
    return p;
  }
  Point<dim> velocity(int party, std::uint32_t i) const
  {
    Point<dim> p;
    for (int a = 0; a < dim; ++a)
      p[a] = of[party].v[a][i];
    return p;
  }
  double radius(int party, std::uint32_t i) const
  {
    return of[party].radius.empty() ? 0 : of[party].radius[i];
  }
  void add_force(int party, std::uint32_t i, const Point<dim> &f)
  {
    for (int a = 0; a < dim; ++a)
      of[party].force[a][i] += f[a];
  }
  /// Largest radius that a body's particles are known to have, m.
  double widest_of(int body) const
  {
    return static_cast<std::size_t>(body) < widest.size() ? widest[static_cast<std::size_t>(body)] : 0;
  }
  /// Index of a point now, given the index it had when `id` was read. Nodes of
  /// a mesh keep their index within a step; particles are reordered.
  std::uint32_t now(int party, std::uint32_t then, std::int64_t id) const
  {
    return party == particle_party && !particle_index.empty() ? particle_index[id] : then;
  }
  void clear_forces();
};

/// Points of `body` that may touch, by ascending id.
template <int dim>
std::vector<std::uint32_t> contact_points(const Surface<dim> &, int body);

/// All points of `body`, by ascending id.
template <int dim>
std::vector<std::uint32_t> body_points(const Surface<dim> &, int body);

/// Facets of `body` that bound material: those that lie as a whole on one of
/// the planes x_axis = 0 listed in `symmetry_axes` are cuts, not surface, and so
/// are seams to particles of the body, unless it is these that are asked for.
template <int dim>
std::vector<typename Surface<dim>::Facet> true_facets(const Surface<dim> &, int body,
                                                      const std::vector<int> &symmetry_axes, bool seams = false);

/// Outward normal of a facet times its length (2-D, m) or area (3-D, m^2); 1 in
/// one dimension.
template <int dim>
Point<dim> facet_area(const Faces<dim> &, int party, const typename Surface<dim>::Facet &);

/// Longest edge of a facet, m; 0 in one dimension.
template <int dim>
double facet_size(const Surface<dim> &, const typename Surface<dim>::Facet &);
} // namespace ogive::coupling
