// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/balance.h"
#include "core/base/culprit.h"
#include "core/base/sample.h"
#include "core/base/surface.h"
#include "core/input/scene.h"
#include "core/io/archive.h"
#include "core/materials/material.h"
#include "core/parallel/ranks.h"
#include "core/time/time_step.h"
#include "fem/departure.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ogive::fem
{
template <int dim>
struct BodyMesh; // fem/mesh.h: a body's triangulation reduced to arrays

/// Surface nodes of one body of elements that follow the facets of another.
struct Tie
{
  std::string name;
  int         slave = 0, master = 0; ///< Scene::bodies indices
  double      tolerance = .1;        ///< gap that is closed, in longest edges of the master's facet
};

/// What became of a tie.
struct TieReport
{
  std::string name;
  std::size_t nodes       = 0; ///< slaves
  double      largest_gap = 0; ///< that was closed, m
};

/// What the solver needs from the scene.
struct Parameters
{
  input::FemOptions                 options;
  bool                              axisymmetric = false; ///< dim 2: x = r, y = z
  std::vector<input::SymmetryPlane> symmetry;
  std::vector<input::RigidWall>     walls;
  std::vector<input::Boundary>      boundaries;
  std::vector<int>                  boundary_bodies; ///< Scene::bodies index of each boundary
  std::vector<Tie>                  ties{};
  Ranks                             ranks{};    ///< that share the elements
  input::ParallelOptions            parallel{}; ///< how they do
};

/// Explicit finite elements: lumped mass, central differences, one-point
/// elements with Flanagan-Belytschko hourglass control.
///
/// On several ranks all functions are called by all of them alike and answer alike,
/// but updates() and share(), which tell of this rank. A rank has the history of its
/// own elements; of nodes it knows those of its own elements and, after each step,
/// x and v of those of all elements at the surface. Forces that the coupling layer
/// writes must be the same on all ranks.
template <int dim>
class Solver
{
public:
  Solver(const Parameters &, std::vector<BodyMesh<dim>>);
  ~Solver();

  StepLimit     stable_dt() const;
  /// The critical step of the mesh as it stands, by power iteration, without the
  /// step factor; `entity` is the node that moves most (fem/critical_step.h).
  StepLimit     critical_dt();
  Surface<dim>  surface();
  StepStatus    step(const TimeStep &);
  /// The same step in parts, for a coupling layer that pushes and looks more
  /// often: begin, go_on for each further part, finish. Surface::force is asked
  /// for before begin and each go_on, and acts over the kick of that part;
  /// elements, loads and walls act once, over that of the whole. Announce it
  /// with allow_parts() at the initial state.
  void          allow_parts();
  StepStatus    begin(const TimeStep &whole, const TimeStep &part);
  StepStatus    go_on(const TimeStep &part);
  StepStatus    finish(const TimeStep &whole);
  /// Energy that steps in parts gave the nodes and took from no element, J (fem/substeps.h).
  double        parts_error() const;
  Balance       balance() const;
  void          snapshot();
  void          restore();
  void          save(ArchiveWriter &, const std::string &prefix) const;
  void          load(const ArchiveReader &, const std::string &prefix);
  Sample        sample(int body) const;
  std::size_t   size() const;
  std::uint64_t updates() const;
  /// Those of them since this solver was built that were left out, since nothing
  /// had reached the element (FEM/quiescent skip).
  std::uint64_t skipped() const;

  /// Mass that bodies were given for the sake of the step (FEM/mass scaling
  /// step): bodies with some, and the mass over what they had, before ties.
  struct AddedMass
  {
    int    body;
    double mass, fraction; ///< kg, -
  };
  std::vector<AddedMass> added_masses() const;

  /// Makes x and v of these nodes known on all ranks after each step from now on,
  /// with those of the elements at the surface; replaces what `who` asked for before.
  void follow(const std::string &who, std::span<const std::uint32_t> nodes);
  /// Makes x and v of all nodes known on all ranks.
  void refresh_all();
  /// What this rank has of the elements.
  struct Share
  {
    std::size_t elements   = 0;
    double      work       = 0; ///< of a step, in points of one-point elements
    std::size_t nodes      = 0; ///< kept up here
    std::size_t shared     = 0; ///< of these, on other ranks too
    std::size_t given      = 0; ///< sums of these told to others in a step, each to each
    std::size_t neighbours = 0;
    std::size_t shown      = 0; ///< nodes at the surface that all ranks know of
    std::size_t moves      = 0; ///< how often elements were shared anew
  };
  Share share() const;
  /// Whether this rank moves a node itself.
  bool keeps(std::uint32_t node) const;

  /// The inertia of a tied particle joins the nodes that carry it. Once, before the first step.
  void add_mass(std::uint32_t node, double mass);
  /// Nodes of the element behind a facet, for the tied interface: shape
  /// functions of that element at parametric point xi in [-1,1]^dim (and a
  /// little outside), and the inverse map of a point near the element.
  struct Embedding
  {
    static constexpr int                      n_nodes = 1 << dim;
    std::array<std::uint32_t, n_nodes>        node;
    std::array<double, n_nodes>               weight; ///< sum 1, sum weight * x = the point
  };
  /// Finds weights of the element with which `point` moves; false if Newton's
  /// method does not converge or |xi| > 1 + reach for all xi.
  bool embed(std::uint32_t element, const std::array<double, dim> &point, double reach, Embedding &) const;

  /// The elements of a body that live, and the corners of each, VTK order.
  struct Cells
  {
    std::vector<std::uint32_t>                         element;
    std::vector<std::array<std::uint32_t, (1 << dim)>> node;
  };
  Cells cells(int body) const;
  /// History of an element, the mean over its points, into entry k.
  void copy_state(std::uint32_t element, materials::Points &, std::size_t k) const;
  /// The same with the stress of damp(): what an element presses its neighbours with.
  void copy_pressing_state(std::uint32_t element, materials::Points &, std::size_t k) const;
  /// The same of several elements, of `elements[k]` into entry k: one exchange of the ranks.
  void gather_pressing_states(std::span<const std::uint32_t> elements, materials::Points &) const;
  /// Viscous stress `share` (L/c) C : D in these elements of a body (numerics: the
  /// damping of stiffness at a seam), in none of its others.
  void damp(int body, std::span<const std::uint32_t> elements, double share);
  /// Share of these elements of a body in the energy and mass of the material
  /// they stand for; the rest belongs to particles. Once, before the first step.
  void weigh(int body, std::span<const std::uint32_t> elements, std::span<const double> shares);

  const std::vector<TieReport> &ties() const;

  // Elements that turn into particles (departure.cc), of bodies with method auto.
  // Elements are counted over all bodies, as in Surface::Facet.

  /// First and past the last element of a body of elements; none: {0, 0}.
  std::pair<std::uint32_t, std::uint32_t> elements_of(int body) const;
  /// How near each element of the body is to it: 1 or more where it must, 0
  /// where it has.
  std::vector<double> conversion_measures(int body, const input::Conversion &) const;
  bool                alive(std::uint32_t element) const;
  Departure<dim>      look(std::uint32_t element) const; ///< what would leave
  std::vector<Departure<dim>> look(std::span<const std::uint32_t> elements) const; ///< in one exchange
  /// Takes elements out between two steps, with the mass, momentum and energy
  /// that are returned. Nodes keep their velocities.
  std::vector<Departure<dim>> take_out(std::span<const std::uint32_t> elements);
  std::size_t                 converted_elements() const;

  /// Normal force sum that rigid wall `w` gave in the last step, N (into the material).
  double wall_force(std::size_t w) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};
} // namespace ogive::fem
