// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/sample.h"

namespace ogive::coupling
{
/// One sample of a body that is part mesh, part particles: the nodes, then the
/// particles; the elements' points, then the particles'. Cells are those of the
/// mesh; half_cell of a node is 0.
Sample joined(Sample mesh, const Sample &particles);
} // namespace ogive::coupling
