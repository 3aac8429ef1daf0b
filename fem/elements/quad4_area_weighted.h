// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/elements/quad4.h"
#include "fem/elements/quad4_axisymmetric.h"

namespace ogive::fem
{
/// The ring of Quad4Axisymmetric in area-weighted form: the equations of motion
/// are weighed over the section, not over the ring, so that a spherical motion
/// on a mesh of equal angles stays spherical. Nodes accelerate by f/m of the
/// section, m the sum of rho A/4; the ring forces that do the same to the ring
/// masses go into the books. Energy is exact by these forces; axial momentum is
/// not, since weights differ from node to node. Goudreau and Hallquist, Comput.
/// Meth. Appl. Mech. Eng. 33 (1982) 725, doi 10.1016/0045-7825(82)90129-3;
/// Caramana, Burton, Shashkov and Whalen, J. Comput. Phys. 146 (1998) 227,
/// doi 10.1006/jcph.1998.6029.
struct Quad4AreaWeighted : Quad4Axisymmetric
{
  static constexpr bool area_weighted = true;

  /// Mean gradient over the section, times the volume of the ring.
  template <class T>
  static void gradient(const T (&x)[corners][dim], Geometry<Quad4AreaWeighted, T> &g)
  {
    Geometry<Quad4Axisymmetric, T> ring;
    Geometry<Quad4, T>             flat;
    Quad4Axisymmetric::gradient(x, ring);
    Quad4::gradient(x, flat);
    g.volume     = ring.volume;
    const T span = ring.volume / flat.volume; // 2 pi times the mean radius
    for (int a = 0; a < corners; ++a)
    {
      for (int i = 0; i < dim; ++i)
        g.B[a][i] = flat.B[a][i] * span;
      g.hoop[a] = (.5 * std::numbers::pi) * flat.volume;
    }
  }

  template <class T>
  static T section(const Geometry<Quad4AreaWeighted, T> &g)
  {
    return g.hoop[0] * (2 / std::numbers::pi);
  }

  /// Ring-weighted forces (corner_forces) to those of the section: over the
  /// mean circumference, and what the frame of the ring adds.
  template <class T>
  static void to_section(const Geometry<Quad4AreaWeighted, T> &g, const T (&sigma)[6], T (&force)[corners][dim])
  {
    const T per_length = section(g) / g.volume; // 1/(2 pi r)
    const T quarter    = g.hoop[0] * per_length; // A/(4 r)
    for (int a = 0; a < corners; ++a)
    {
      force[a][0] = force[a][0] * per_length + quarter * sigma[0];
      force[a][1] = force[a][1] * per_length + quarter * sigma[3];
    }
  }
};
} // namespace ogive::fem
