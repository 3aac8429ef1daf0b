// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/elements/full.h"

namespace ogive::fem
{
/// Full with the volume strain of each point replaced by the element's mean: no
/// volumetric locking, no zero-energy modes. Hughes, Int. J. Numer. Meth. Eng.
/// 15 (1980) 1413, doi 10.1002/nme.1620150914. In the plane the difference is
/// spread over three directions, as in space.
template <int dim_, bool ring>
struct BBar : Full<dim_, ring>
{
  static constexpr bool mean_dilatation = true;
};
} // namespace ogive::fem
