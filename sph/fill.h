// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/solver.h"

namespace ogive::sph
{
/// Fills a body with particles on a cubic lattice of its spacing, clipped by
/// the scene's symmetry planes (sph/shape_lattice.h), and moved off it by
/// Body::jitter. The mass is density times
/// the exact volume of the modelled part (plane strain: per metre; 1-D: per
/// square metre), shared equally; axisymmetric: by the radius, whole rings. Velocities: translation, spin about the
/// centre of mass, and the velocity field.
///
/// `body_index`: index into Scene::bodies. InputError naming the body.
template <int dim>
BodyParticles<dim> fill(const input::Body &, const input::Scene &, int body_index,
                        std::shared_ptr<const materials::Material>);
} // namespace ogive::sph
