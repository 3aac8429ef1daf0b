// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/scene.h"
#include "core/io/archive.h"
#include "coupling/conversion_cluster.h"
#include "fem/solver.h"
#include "sph/solver.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace ogive::coupling
{
/// An element coarser than this many particle spacings stays an element.
inline constexpr int most_along_edge = 6;

/// Turns elements of bodies with method auto into particles, between two steps.
///
/// An element goes where input::Conversion says so, with the elements around it
/// in `layers` layers (elements that share a node), and what would be left with
/// less than `dim` neighbours: the nodes of such spikes are too light for what
/// particles press them with. Elements at a face that a
/// boundary acts on stay: particles would lose it. So do elements that are more
/// than most_along_edge spacings long.
///
/// Exact for each cluster of elements that go together: mass, linear momentum,
/// and, but in axial symmetry, angular momentum, by a turn of the particles (a
/// cluster whose particles could hardly turn takes a further layer with it).
/// What that changes of the kinetic energy, and the energy of the hourglass
/// patterns, is the conversion heat of the ledger; it may be negative.
template <int dim>
class Conversion
{
public:
  /// Both solvers live longer than this. Before the first step.
  Conversion(const input::Scene &, fem::Solver<dim> &, sph::Solver<dim> &,
             const std::vector<std::pair<int, std::vector<std::uint32_t>>> &held);

  bool any() const { return !bodies_.empty(); }
  /// Converts the zones of the scene: not an event, and no heat. Before the first step.
  void begin();
  /// Converts what must. Snapshots of the solvers taken before are void if
  /// anything did.
  std::vector<ConversionEvent> convert(std::int64_t step, double time);

  double heat() const { return heat_; } ///< so far, J
  void   snapshot() { kept_ = heat_; }
  void   restore() { heat_ = kept_; }
  void   save(ArchiveWriter &, const std::string &prefix) const;
  void   load(const ArchiveReader &, const std::string &prefix);

private:
  struct Body
  {
    int                                     scene = 0;
    input::Conversion                       when;
    double                                  spacing = 0; ///< of its particles, m
    std::uint32_t                           first = 0;   ///< element
    std::vector<std::vector<std::uint32_t>> around;      ///< elements that share a node with each, from 0
    std::vector<std::vector<std::uint32_t>> beside;      ///< that share a face with it
    std::vector<bool>                       free;        ///< may go
  };
  using Elements = std::vector<std::uint32_t>; ///< of a body, from 0

  void prepare(Body &, std::pair<std::uint32_t, std::uint32_t> range, const std::vector<std::uint32_t> &held) const;
  bool may_go(const Body &, std::uint32_t) const;
  Elements seeds(const Body &) const;
  Elements zone(const Body &) const;
  /// `from` and what lies within some layers of it, ascending.
  Elements grown(const Body &, const Elements &from, int layers) const;
  /// With what would be left as a spike between particles.
  Elements without_spikes(const Body &, Elements) const;
  std::vector<Elements> clusters(const Body &, const Elements &) const;
  /// The same where the particles can take up the angular momentum.
  Elements roomy(const Body &, Elements) const;
  std::vector<ConversionEvent> turn_into_particles(const Body &, const Elements &);

  fem::Solver<dim> &mesh_;
  sph::Solver<dim> &particles_;
  bool              axisymmetric_;
  std::vector<Body> bodies_;
  double            heat_ = 0, kept_ = 0;
};
} // namespace ogive::coupling
