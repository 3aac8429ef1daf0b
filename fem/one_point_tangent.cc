// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/elements/hex8.h"
#include "fem/elements/line2.h"
#include "fem/elements/quad4.h"
#include "fem/elements/quad4_area_weighted.h"
#include "fem/one_point_group.h"

#include <algorithm>

/// The elastic tangent of one-point elements.
namespace ogive::fem
{
template <class Element>
void OnePointGroup<Element>::tangent(const Nodes<dim> &nodes, const std::array<AlignedVector<double>, dim> &u,
                                     AlignedVector<double> &stiff, AlignedVector<double> &damp) const
{
  using Corner = Geometry<Element, VDouble>;
  stiff.resize(padded_n_ * corners * dim);
  damp.resize(padded_n_ * corners * dim);
  VDouble                ones[corners];
  std::fill(std::begin(ones), std::end(ones), VDouble(1.));
  for (std::size_t pack = 0; pack < padded_n_ / width; ++pack)
  {
    const std::size_t e = pack * width;
    Corners           x, motion;
    Corner            shape;
    Motion            d;
    gather(nodes.x, pack, x);
    gather(u, pack, motion);
    deform<Element, VDouble>(x, motion, VDouble(0.), shape, d); // rates alone: no middle of a step
    // strains come with dt = 0; take them from the gradient once more
    VDouble L[dim][dim];
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
      {
        L[i][j] = VDouble(0.);
        for (int a = 0; a < corners; ++a)
          L[i][j] += motion[a][i] * shape.B[a][j] / shape.volume;
      }
    VDouble trace(0.), sigma[6], viscous[6], elastic_Q[Corner::modes][dim], viscous_Q[Corner::modes][dim];
    for (int c = 0; c < 6; ++c)
      sigma[c] = viscous[c] = VDouble(0.);
    VDouble hoop(0.);
    if constexpr (Element::hoop)
      for (int a = 0; a < corners; ++a)
        hoop += motion[a][0] * shape.hoop[a] / shape.volume;
    for (int i = 0; i < dim; ++i)
      trace += L[i][i];
    trace += hoop;
    const VDouble density = load(&points_.density[e]), c = load(&points_.sound_speed[e]);
    const VDouble lambda = stdx::max(VDouble(density * c * c - 2. * shear_modulus_), VDouble(0.));
    const auto    unit   = gram<Element, VDouble>(shape, ones);
    const VDouble length = length_of<Element, VDouble>(unit.trace);
    const VDouble damping = damping_of(bulk_, density, c, length, load(&viscous_pressure_[e]));
    for (int i = 0; i < 3; ++i)
    {
      const VDouble own = i < dim ? L[i][i] : i == 2 ? hoop : VDouble(0.);
      sigma[i]          = lambda * trace + 2. * shear_modulus_ * own;
      viscous[i]        = damping * trace;
    }
    if constexpr (dim >= 2)
      sigma[3] = shear_modulus_ * (L[0][1] + L[1][0]);
    if constexpr (dim == 3)
    {
      sigma[4] = shear_modulus_ * (L[1][2] + L[2][1]);
      sigma[5] = shear_modulus_ * (L[0][2] + L[2][0]);
    }
    const VDouble resistance =
      viscous_hourglass_ ? options_.hourglass_coefficient * .25 * density * c * shape.volume / length :
                           options_.hourglass_coefficient * hourglass_modulus_ / corners * shape.volume * unit.trace;
    for (int m = 0; m < Corner::modes; ++m)
      for (int i = 0; i < dim; ++i)
      {
        elastic_Q[m][i] = viscous_Q[m][i] = VDouble(0.);
        if constexpr (modes > 0)
          (viscous_hourglass_ ? viscous_Q : elastic_Q)[m][i] = resistance * d.rate[m][i];
      }
    VDouble force[corners][dim];
    for (auto *out : {&stiff, &damp})
    {
      const bool first = out == &stiff;
      fem::corner_forces<Element, VDouble>(shape, first ? sigma : viscous, first ? elastic_Q : viscous_Q, force);
      double *f = &(*out)[pack * corners * dim * width];
      for (int a = 0; a < corners; ++a)
        for (int i = 0; i < dim; ++i, f += width)
          store(force[a][i], f);
    }
  }
}

template class OnePointGroup<Line2>;
template class OnePointGroup<Quad4>;
template class OnePointGroup<Quad4Axisymmetric>;
template class OnePointGroup<Quad4AreaWeighted>;
template class OnePointGroup<Hex8>;
} // namespace ogive::fem
