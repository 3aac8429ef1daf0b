// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/elements/hex8.h"
#include "fem/elements/line2.h"
#include "fem/elements/quad4.h"
#include "fem/elements/quad4_area_weighted.h"
#include "fem/one_point_group.h"

/// One-point elements that share their material with particles: forces, masses
/// and energies count by the share, strain and stress know nothing of it.
namespace ogive::fem
{
template <class Element>
void OnePointGroup<Element>::weigh(std::span<const std::size_t> elements, std::span<const double> shares,
                                   Nodes<dim> &nodes)
{
  if (area_weighted || corrected_ || !alive_.empty())
    throw InputError({"", 0, "Bodies"},
                     "elements that share their material with particles can neither die, nor be area-weighted, nor have "
                     "their viscosity corrected",
                     "erosion none, FEM/element one-point, FEM/correction none");
  quiet_.wake();
  share_.resize(padded_n_, 1.);
  for (std::size_t k = 0; k < elements.size(); ++k)
  {
    const std::size_t e = elements[k];
    for (int a = 0; a < corners; ++a)
    {
      const std::size_t c = slot(e, a, corners);
      nodes.mass[node_[c]] -=
        (share_[e] - shares[k]) *
        (Element::hoop ? corner_mass_[c] : (inertia_.empty() ? mass_ : inertia_)[e] / corners);
    }
    share_[e] = shares[k];
  }
}

template <class Element>
void OnePointGroup<Element>::scatter_shares(std::size_t begin, std::size_t count, const double *forces)
{
  for (int a = 0; a < corners; ++a)
    for (int i = 0; i < dim; ++i)
      for (std::size_t e = begin * width; e < std::min((begin + count) * width, n_); ++e)
        nodal_force_[i][node_[slot(e, a, corners)] - first_node_] +=
          share_[e] * forces[slot(e - begin * width, a * dim + i, corners * dim)];
}

template class OnePointGroup<Line2>;
template class OnePointGroup<Quad4>;
template class OnePointGroup<Quad4Axisymmetric>;
template class OnePointGroup<Quad4AreaWeighted>;
template class OnePointGroup<Hex8>;
} // namespace ogive::fem
