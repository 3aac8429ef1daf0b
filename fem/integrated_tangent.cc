// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/integrated_group.h"
#include "fem/integrated_instances.h"

#include <algorithm>

/// The elastic tangent of elements with several points.
namespace ogive::fem
{
namespace
{
/// Strain of a displacement gradient, and of the direction across the plane.
template <int dim>
void strain_of(const VDouble (&L)[dim][dim], const VDouble &normal, VDouble (&e)[6])
{
  std::fill(std::begin(e), std::end(e), VDouble(0.));
  e[2] = normal;
  for (int i = 0; i < dim; ++i)
    e[i] = L[i][i];
  if constexpr (dim >= 2)
    e[3] = .5 * (L[0][1] + L[1][0]);
  if constexpr (dim == 3)
  {
    e[4] = .5 * (L[1][2] + L[2][1]);
    e[5] = .5 * (L[0][2] + L[2][0]);
  }
}

/// Volume means of an element with mean dilatation.
struct Means
{
  VDouble volume{0.}, trace{0.}, pressure{0.}, viscous{0.};
};
} // namespace

template <class Element>
struct IntegratedGroup<Element>::Tangent
{
  Point   point[points_of];
  VDouble strain[points_of][6], lambda[points_of], viscous[points_of]; ///< Pa, Pa s
};

template <class Element>
void IntegratedGroup<Element>::linearise(std::size_t pack, const Field &x, const Field &u, Tangent &t) const
{
  VDouble                inverse[nodes_of];
  inverse_node_masses(pack, inverse);
  for (int q = 0; q < points_of; ++q)
    map_point(x, q, t.point[q]);
  VDouble length;
  if constexpr (!Element::collocated)
    length = shape_bound<Element, VDouble>(x, t.point, inverse).length;
  for (int q = 0; q < points_of; ++q)
  {
    VDouble L[dim][dim], normal(0.);
    velocity_gradient(u, q, t.point[q], L);
    if constexpr (Element::hoop)
      normal = hoop_rate(u, q, t.point[q]);
    strain_of<dim>(L, normal, t.strain[q]);
    if constexpr (Element::collocated)
      length = point_length<Element, VDouble>(t.point[q]);
    const std::size_t p       = at(pack, q);
    const VDouble     density = load(&points_.density[p]), c = load(&points_.sound_speed[p]);
    t.lambda[q]  = stdx::max(VDouble(density * c * c - 2. * shear_modulus_), VDouble(0.));
    t.viscous[q] = damping_of(bulk_, density, c, length, load(&viscous_pressure_[p]));
  }
}

template <class Element>
void IntegratedGroup<Element>::tangent(const Nodes<dim> &nodes, const std::array<AlignedVector<double>, dim> &u,
                                       AlignedVector<double> &stiff, AlignedVector<double> &damp) const
{
  stiff.resize(node_force_.size());
  damp.resize(node_force_.size());
  Tangent t;
  for (std::size_t pack = 0; pack < padded_n_ / width; ++pack)
  {
    Field x, motion, K, C;
    gather(nodes.x, pack, x);
    gather(u, pack, motion);
    for (auto *field : {&K, &C})
      for (auto &node : *field)
        std::fill(std::begin(node), std::end(node), VDouble(0.));
    linearise(pack, x, motion, t);
    Means mean;
    for (int q = 0; Element::mean_dilatation && q < points_of; ++q)
    {
      mean.volume += t.point[q].volume;
      mean.trace += t.point[q].volume * (t.strain[q][0] + t.strain[q][1] + t.strain[q][2]);
    }
    for (int q = 0; Element::mean_dilatation && q < points_of; ++q)
    {
      const VDouble trace = mean.trace / mean.volume, share = t.point[q].volume / mean.volume;
      mean.pressure += share * (t.lambda[q] + 2. / 3 * shear_modulus_) * trace;
      mean.viscous += share * t.viscous[q] * trace;
    }
    for (int q = 0; q < points_of; ++q)
    {
      const VDouble trace = t.strain[q][0] + t.strain[q][1] + t.strain[q][2];
      VDouble       elastic[6], viscous[6];
      for (int c = 0; c < 6; ++c)
      {
        elastic[c] = 2. * shear_modulus_ * t.strain[q][c];
        viscous[c] = VDouble(0.);
        if (c < 3)
        {
          elastic[c] += Element::mean_dilatation ? VDouble(mean.pressure - 2. / 3 * shear_modulus_ * trace) :
                                                   VDouble(t.lambda[q] * trace);
          viscous[c] = Element::mean_dilatation ? mean.viscous : VDouble(t.viscous[q] * trace);
        }
      }
      add_forces(elastic, q, t.point[q], K);
      add_forces(viscous, q, t.point[q], C);
    }
    double *k = &stiff[pack * nodes_of * dim * width], *c = &damp[pack * nodes_of * dim * width];
    for (int a = 0; a < nodes_of; ++a)
      for (int i = 0; i < dim; ++i, k += width, c += width)
      {
        store(K[a][i], k);
        store(C[a][i], c);
      }
  }
}

OGIVE_INSTANTIATE_INTEGRATED(template class, IntegratedGroup)
} // namespace ogive::fem
