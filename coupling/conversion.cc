// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/conversion.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace ogive::coupling
{
namespace
{
template <int dim>
Vec3 first_centre(const fem::Departure<dim> &d)
{
  Vec3 centre = Vec3::Zero();
  for (const auto &corner : d.x0)
    for (int i = 0; i < dim; ++i)
      centre[i] += corner[i] / d.corners;
  return centre;
}

/// Numbers of all elements from the first to before the last.
std::vector<std::uint32_t> numbers_of(const std::pair<std::uint32_t, std::uint32_t> &range)
{
  std::vector<std::uint32_t> numbers(range.second - range.first);
  std::iota(numbers.begin(), numbers.end(), range.first);
  return numbers;
}

/// Distance of a point from the centre of a zone, or from the line through it, m.
double distance(const input::Conversion &when, const Vec3 &x)
{
  const Vec3 arm = x - when.zone_centre;
  if (when.zone_along.isZero(0))
    return arm.norm();
  const Vec3 along = when.zone_along.normalized();
  return (arm - arm.dot(along) * along).norm();
}

/// Half of the corners' inertia: with less the repair would more than double
/// what the cluster spins by itself.
constexpr double least_inertia = .5;
} // namespace

template <int dim>
Conversion<dim>::Conversion(const input::Scene &scene, fem::Solver<dim> &mesh, sph::Solver<dim> &particles,
                            const std::vector<std::pair<int, std::vector<std::uint32_t>>> &held)
  : mesh_(mesh)
  , particles_(particles)
  , axisymmetric_(scene.dimension == input::Dimension::axisymmetric)
{
  for (const auto &[index, cells] : held)
  {
    const input::Body &body = scene.bodies[static_cast<std::size_t>(index)];
    Body               b;
    b.scene   = index;
    b.when    = body.conversion;
    b.spacing = body.spacing / body.conversion.per_edge;
    prepare(b, mesh.elements_of(index), cells);
    bodies_.push_back(std::move(b));
  }
}

template <int dim>
void Conversion<dim>::prepare(Body &b, std::pair<std::uint32_t, std::uint32_t> range,
                              const std::vector<std::uint32_t> &held) const
{
  b.first                = range.first;
  const std::uint32_t  n = range.second - range.first;
  std::map<std::uint32_t, std::vector<std::uint32_t>> at; // elements at each node
  b.free.assign(n, true);
  const auto all = mesh_.look(numbers_of(range));
  for (std::uint32_t e = 0; e < n; ++e)
  {
    const auto &element = all[e];
    for (const std::uint32_t node : element.node)
      at[node].push_back(e);
    const auto lattice = lattice_of(element, b.spacing);
    if (*std::max_element(lattice.begin(), lattice.end()) > most_along_edge)
      b.free[e] = false;
  }
  for (const std::uint32_t e : held)
    b.free[e] = false;
  b.around.resize(n);
  b.beside.resize(n);
  constexpr int on_face = 1 << (dim - 1); // nodes
  for (std::uint32_t e = 0; e < n; ++e)
  {
    std::map<std::uint32_t, int> shared; // nodes with each other element
    for (const std::uint32_t node : all[e].node)
      for (const std::uint32_t other : at[node])
        ++shared[other];
    for (const auto &[other, nodes] : shared)
    {
      b.around[e].push_back(other);
      if (nodes == on_face && other != e)
        b.beside[e].push_back(other);
    }
  }
}

template <int dim>
bool Conversion<dim>::may_go(const Body &b, std::uint32_t e) const
{
  return b.free[e] && mesh_.alive(b.first + e);
}

template <int dim>
auto Conversion<dim>::seeds(const Body &b) const -> Elements
{
  Elements   found;
  const auto measure = mesh_.conversion_measures(b.scene, b.when);
  for (std::uint32_t e = 0; e < measure.size(); ++e)
    if (measure[e] >= 1 && may_go(b, e))
      found.push_back(e);
  return found;
}

template <int dim>
auto Conversion<dim>::zone(const Body &b) const -> Elements
{
  Elements found;
  if (!(b.when.zone_radius > 0))
    return found;
  const auto all = mesh_.look(numbers_of({b.first, b.first + static_cast<std::uint32_t>(b.free.size())}));
  for (std::uint32_t e = 0; e < all.size(); ++e)
    if (distance(b.when, first_centre(all[e])) <= b.when.zone_radius)
      found.push_back(e);
  return found;
}

template <int dim>
auto Conversion<dim>::grown(const Body &b, const Elements &from, int layers) const -> Elements
{
  std::vector<bool> taken(b.free.size(), false);
  Elements          all = from, front = from;
  for (const std::uint32_t e : from)
    taken[e] = true;
  for (int layer = 0; layer < layers; ++layer)
  {
    Elements next;
    for (const std::uint32_t e : front)
      for (const std::uint32_t neighbour : b.around[e])
        if (!taken[neighbour] && may_go(b, neighbour))
        {
          taken[neighbour] = true;
          next.push_back(neighbour);
        }
    all.insert(all.end(), next.begin(), next.end());
    front = std::move(next);
  }
  std::sort(all.begin(), all.end());
  return all;
}

template <int dim>
auto Conversion<dim>::without_spikes(const Body &b, Elements elements) const -> Elements
{
  std::vector<bool> goes(b.free.size(), false);
  for (const std::uint32_t e : elements)
    goes[e] = true;
  for (std::size_t k = 0; k < elements.size(); ++k) // grows on the way
    for (const std::uint32_t e : b.around[elements[k]])
    {
      if (goes[e] || !may_go(b, e))
        continue;
      const auto stay = std::count_if(b.beside[e].begin(), b.beside[e].end(), [&](std::uint32_t other) {
        return !goes[other] && mesh_.alive(b.first + other);
      });
      if (stay >= std::min<std::ptrdiff_t>(dim, static_cast<std::ptrdiff_t>(b.beside[e].size())))
        continue;
      goes[e] = true;
      elements.push_back(e);
    }
  std::sort(elements.begin(), elements.end());
  return elements;
}

template <int dim>
auto Conversion<dim>::clusters(const Body &b, const Elements &elements) const -> std::vector<Elements>
{
  std::vector<char> waits(b.free.size(), 0);
  for (const std::uint32_t e : elements)
    waits[e] = 1;
  std::vector<Elements> all;
  for (const std::uint32_t e : elements)
  {
    if (!waits[e])
      continue;
    Elements cluster{e};
    waits[e] = 0;
    for (std::size_t k = 0; k < cluster.size(); ++k)
      for (const std::uint32_t neighbour : b.around[cluster[k]])
        if (waits[neighbour])
        {
          waits[neighbour] = 0;
          cluster.push_back(neighbour);
        }
    std::sort(cluster.begin(), cluster.end());
    all.push_back(std::move(cluster));
  }
  return all;
}

template <int dim>
auto Conversion<dim>::roomy(const Body &b, Elements cluster) const -> Elements
{
  while (true)
  {
    Elements numbers = cluster;
    for (std::uint32_t &e : numbers)
      e += b.first;
    if (inertia_ratio<dim>(mesh_.look(numbers), b.spacing, axisymmetric_) >= least_inertia)
      return cluster;
    Elements more = grown(b, cluster, 1);
    if (more.size() == cluster.size())
      return cluster;
    cluster = std::move(more);
  }
}

template <int dim>
std::vector<ConversionEvent> Conversion<dim>::turn_into_particles(const Body &b, const Elements &elements)
{
  sph::Newcomers<dim> all;
  all.body = b.scene;
  std::vector<ConversionEvent> events;
  for (const Elements &cluster : clusters(b, elements))
  {
    materials::Points state;
    state.resize(cluster.size());
    std::vector<std::uint32_t> numbers;
    for (std::size_t k = 0; k < cluster.size(); ++k)
    {
      numbers.push_back(b.first + cluster[k]);
      mesh_.copy_state(numbers.back(), state, k);
    }
    const std::vector<fem::Departure<dim>> gone  = mesh_.take_out(numbers);
    const std::size_t                      first = all.mass.size();
    for (std::size_t k = 0; k < gone.size(); ++k)
      add_particles<dim>(gone[k], lattice_of(gone[k], b.spacing), state, k, axisymmetric_, all);

    ConversionEvent event;
    event.body      = b.scene;
    event.elements  = static_cast<double>(cluster.size());
    event.particles = static_cast<double>(all.mass.size() - first);
    event.before    = sums_of<dim>(gone, state, axisymmetric_);
    event.turn      = repair_momenta(event.before, axisymmetric_, all, first);
    event.after     = sums_of(all, first, axisymmetric_);
    for (const auto &d : gone)
      event.hourglass += d.hourglass;
    event.heat = event.before.kinetic - event.after.kinetic + event.hourglass;
    events.push_back(event);
  }
  particles_.add(all);
  return events;
}

template <int dim>
void Conversion<dim>::begin()
{
  for (const Body &b : bodies_)
  {
    const Elements chosen = zone(b);
    if (b.when.zone_radius > 0 && chosen.empty())
      throw InputError({"", 0, "Bodies"}, "no element has its centre within a zone radius of its zone centre",
                       "a zone that covers some elements, or zone radius = 0");
    for (const std::uint32_t e : chosen)
      if (!b.free[e])
        throw InputError({"", 0, "Bodies"},
                         "the zone of particles reaches elements at a face that a boundary acts on, or elements longer "
                         "than " + std::to_string(most_along_edge) + " particle spacings",
                         "a smaller zone radius");
    if (!chosen.empty())
      turn_into_particles(b, chosen);
  }
}

template <int dim>
std::vector<ConversionEvent> Conversion<dim>::convert(std::int64_t step, double time)
{
  std::vector<ConversionEvent> events;
  for (const Body &b : bodies_)
  {
    const Elements found = seeds(b);
    if (found.empty())
      continue;
    Elements all;
    for (const Elements &cluster : clusters(b, without_spikes(b, grown(b, found, static_cast<int>(b.when.layers)))))
    {
      const Elements whole = without_spikes(b, roomy(b, cluster));
      all.insert(all.end(), whole.begin(), whole.end());
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (ConversionEvent &event : turn_into_particles(b, all))
    {
      event.step = static_cast<double>(step);
      event.time = time;
      heat_ += event.heat;
      events.push_back(event);
    }
  }
  return events;
}

template <int dim>
void Conversion<dim>::save(ArchiveWriter &archive, const std::string &prefix) const
{
  archive.write(prefix + "/heat", std::vector<double>{heat_});
}

template <int dim>
void Conversion<dim>::load(const ArchiveReader &archive, const std::string &prefix)
{
  const auto heat = archive.doubles(prefix + "/heat");
  if (heat.size() != 1)
    throw InputError("the checkpoint has no conversion heat where the scene has a body with method auto");
  heat_ = heat[0];
}

template class Conversion<1>;
template class Conversion<2>;
template class Conversion<3>;
} // namespace ogive::coupling
