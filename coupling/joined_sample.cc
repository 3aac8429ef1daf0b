// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/joined_sample.h"

namespace ogive::coupling
{
Sample joined(Sample mesh, const Sample &particles)
{
  Sample    &all  = mesh;
  const auto take = [](auto &to, const auto &from) { to.insert(to.end(), from.begin(), from.end()); };
  for (int i = 0; i < 3; ++i)
  {
    all.half_cell[i].assign(all.mass.size(), 0.);
    take(all.half_cell[i], particles.half_cell[i]);
    take(all.x[i], particles.x[i]);
    take(all.x0[i], particles.x0[i]);
    take(all.v[i], particles.v[i]);
    take(all.centre[i], particles.centre[i]);
    take(all.centre0[i], particles.centre0[i]);
  }
  take(all.mass, particles.mass);
  take(all.radius, particles.radius);
  take(all.id, particles.id);
  for (int c = 0; c < 6; ++c)
    take(all.sigma[c], particles.sigma[c]);
  take(all.density, particles.density);
  take(all.energy, particles.energy);
  take(all.plastic_strain, particles.plastic_strain);
  take(all.damage, particles.damage);
  take(all.temperature, particles.temperature);
  take(all.volume, particles.volume);
  return mesh;
}
} // namespace ogive::coupling
