// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/interface_blended.h"

#include "core/base/error.h"
#include "core/base/log.h"
#include "coupling/contact_geometry.h"
#include "coupling/search.h"
#include "coupling/seam_riders.h"

#include <algorithm>

namespace ogive::coupling
{
namespace
{
// Points an axis at which the share is averaged over an element.
constexpr int samples = 4;

InputError refusal(const InterfaceSpec &spec, const std::string &what, const std::string &expected)
{
  return InputError({"", 0, "Interfaces/" + spec.name}, "interface \"" + spec.name + "\": " + what, expected);
}
} // namespace

template <int dim>
struct BlendedInterface<dim>::Layer
{
  Faces<dim>                    faces;
  typename MeshPort<dim>::Cells cells;
  std::vector<Facet>            seam;
  double                        spacing = 0, reach = 0, largest = 0; ///< m
  // Of the slaves.
  std::vector<double>        depth, mass;
  std::vector<std::uint32_t> touched; ///< cells that hold one
  std::vector<std::int64_t>  id;

  Layer(const InterfaceSpec &spec, MeshPort<dim> &mesh, ParticlePort<dim> &particles)
    : faces(Faces<dim>::look(&mesh, &particles))
    , cells(mesh.cells(spec.mesh))
  {
    const auto lattice = particles.lattice(spec.particles);
    spacing            = *std::max_element(lattice.cell.begin(), lattice.cell.end());
    reach              = lattice.reach;
    seam               = seam_facets<dim>(spec, faces, spacing);
  }

  std::array<Point<dim>, (1 << dim)> corners(std::size_t c) const
  {
    std::array<Point<dim>, (1 << dim)> x;
    for (std::size_t a = 0; a < x.size(); ++a)
      x[a] = faces.position(mesh_party, cells.node[c][a]);
    return x;
  }
  /// Distance to the nearest facet of the seam.
  double depth_of(const Point<dim> &p) const
  {
    double least = std::numeric_limits<double>::infinity();
    for (const Facet &facet : seam)
    {
      std::array<Point<dim>, Facet::n_nodes> x;
      for (int k = 0; k < Facet::n_nodes; ++k)
        x[k] = faces.position(mesh_party, facet.node[k]);
      least = std::min(least, foot_on_facet<dim>(p, x, facet.outward).distance2);
    }
    return std::sqrt(least);
  }
  /// Mean share of the elements in cell c.
  double element_share(std::size_t c, double width) const
  {
    const auto x = corners(c);
    double     sum = 0, volume = 0;
    int        count = 1;
    for (int a = 0; a < dim; ++a)
      count *= samples;
    for (int k = 0; k < count; ++k)
    {
      Point<dim> xi;
      for (int a = 0, rest = k; a < dim; ++a, rest /= samples)
        xi[a] = (2. * (rest % samples) + 1) / samples - 1;
      std::array<double, (1 << dim)> weight;
      const double                   v = place_in_cell<dim>(x, xi, weight);
      Point<dim>                     p = Point<dim>::Zero();
      for (std::size_t a = 0; a < weight.size(); ++a)
        p += weight[a] * x[a];
      sum += v * (1 - blend_share(depth_of(p) / width));
      volume += v;
    }
    return sum / volume;
  }
};

template <int dim>
BlendedInterface<dim>::BlendedInterface(const InterfaceSpec &spec, MeshPort<dim> &mesh, ParticlePort<dim> &particles,
                                        Slaves<dim> &slaves)
  : TiedInterface<dim>(slaves)
{
  if (spec.axisymmetric)
    throw refusal(spec, "the blended overlap does not know the hoop stress of rings", "method tied or pair-flux");
  Layer layer(spec, mesh, particles);
  if (layer.seam.empty())
    throw refusal(spec, "no particle of body \"" + spec.particle_body + "\" stands in front of the surface of body \"" +
                          spec.mesh_body + "\"",
                  "a body of particles that comes from outside and reaches into the elements");
  ride(spec, layer, mesh, slaves);
  for (const std::uint32_t c : layer.touched)
  {
    const auto x = layer.corners(c);
    for (std::size_t a = 0; a < x.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        layer.largest = std::max(layer.largest, (x[a] - x[b]).norm() / std::sqrt(double(dim))); // of cubes the edge
  }
  const double deepest = layer.depth.empty() ? 0 : *std::max_element(layer.depth.begin(), layer.depth.end());
  width_               = deepest > 0 ? deepest + .5 * layer.spacing : 0;
  // The lists reach 2 h of the cubic kernel and a skin of .12 h.
  const double least = std::max(2 * layer.reach / 1.06, 2 * layer.largest);
  if (width_ < (1 - 1e-6) * least)
    throw refusal(spec, "body \"" + spec.particle_body + "\" reaches " + engineering(width_) + " m into body \"" +
                          spec.mesh_body + "\"",
                  "at least " + engineering(least) + " m: two supports of a particle and two elements");
  share(spec, layer, mesh, particles);
  this->follow(spec, mesh);
}

template <int dim>
void BlendedInterface<dim>::ride(const InterfaceSpec &spec, Layer &layer, MeshPort<dim> &mesh, Slaves<dim> &slaves)
{
  const auto                &cloud  = layer.faces[particle_party];
  const auto                 points = body_points(cloud, spec.particles);
  std::vector<Box<dim>>      queries(points.size()), targets(layer.cells.element.size());
  std::vector<std::uint32_t> holds(targets.size(), 0);
  for (std::size_t q = 0; q < points.size(); ++q)
    queries[q].include(layer.faces.position(particle_party, points[q]));
  for (std::size_t c = 0; c < targets.size(); ++c)
    for (const auto &x : layer.corners(c))
      targets[c].include(x);
  NeighbourList<dim> list;
  list.build(queries, targets);
  for (std::size_t q = 0; q < points.size(); ++q)
  {
    const std::uint32_t     i = points[q];
    std::array<double, dim> place;
    for (int a = 0; a < dim; ++a)
      place[a] = cloud.x[a][i];
    for (const std::uint32_t c : list.of(q))
    {
      Embedding<dim> embedding;
      if (!mesh.embed(layer.cells.element[c], place, 1e-9, embedding))
        continue;
      if (slaves.holds(cloud.id[i]))
        throw refusal(spec, "particle " + std::to_string(cloud.id[i]) + " already rides in another interface",
                      "layers that are apart");
      slaves.add(cloud.id[i]);
      this->id_.push_back(cloud.id[i]);
      this->embedding_.push_back(embedding);
      layer.depth.push_back(layer.depth_of(layer.faces.position(particle_party, i)));
      layer.mass.push_back(cloud.mass[i]);
      holds[c] = 1;
      break;
    }
  }
  for (std::uint32_t c = 0; c < holds.size(); ++c)
    if (holds[c])
      layer.touched.push_back(c);
}

template <int dim>
void BlendedInterface<dim>::share(const InterfaceSpec &spec, const Layer &layer, MeshPort<dim> &mesh,
                                  ParticlePort<dim> &particles) const
{
  std::vector<double> alpha(this->id_.size());
  for (std::size_t s = 0; s < alpha.size(); ++s)
  {
    alpha[s] = blend_share(layer.depth[s] / width_);
    for (int k = 0; k < Embedding<dim>::n_nodes; ++k)
      mesh.add_mass(this->embedding_[s].node[k], alpha[s] * this->embedding_[s].weight[k] * layer.mass[s]);
  }
  particles.weigh(this->id_, alpha);
  std::vector<std::uint32_t> elements;
  std::vector<double>        weights;
  for (const std::uint32_t c : layer.touched)
  {
    elements.push_back(layer.cells.element[c]);
    weights.push_back(layer.element_share(c, width_));
  }
  mesh.weigh(spec.mesh, elements, weights);
}

template class BlendedInterface<1>;
template class BlendedInterface<2>;
template class BlendedInterface<3>;
} // namespace ogive::coupling
