// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/interface_tied.h"

#include <vector>

namespace ogive::coupling
{
/// Particles and elements over the same material, in a layer of the mesh at the
/// seam, share its energy and its mass: at depth d, with s = d/w,
///   particles: alpha = 1 - s^2 (3 - 2 s),   elements: 1 - alpha.
/// The particles of the layer are slaves of the elements that they lie in, as in
/// TiedInterface, so the power at the seam, momentum and the sum of both energies
/// are exact. The body of particles reaches w into that of elements,
/// w >= max(4 h, 2 H): InputError says how far it must.
///
/// The particles are weighted one by one, each element by the mean of 1 - alpha
/// over it. Under uniform stress the nodes of the layer so see forces that vanish
/// only as far as the sums over particles are integrals.
template <int dim>
class BlendedInterface : public TiedInterface<dim>
{
public:
  BlendedInterface(const InterfaceSpec &, MeshPort<dim> &, ParticlePort<dim> &, Slaves<dim> &);

  double width() const { return width_; } ///< m

private:
  using Facet = typename Surface<dim>::Facet;
  struct Layer; // what is needed only while particles are chosen

  void ride(const InterfaceSpec &, Layer &, MeshPort<dim> &, Slaves<dim> &);
  void share(const InterfaceSpec &, const Layer &, MeshPort<dim> &, ParticlePort<dim> &) const;

  double width_ = 0;
};

/// Share of the particles at s = depth over width.
inline double blend_share(double s)
{
  return s <= 0 ? 1 : s >= 1 ? 0 : 1 - s * s * (3 - 2 * s);
}
} // namespace ogive::coupling
