// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/points.h"

#include <array>
#include <cstddef>
#include <vector>

namespace ogive::sph
{
/// Particles that enter a body while a run goes on, structure of arrays of one
/// length, SI: x at t_n, v at t_{n-1/2}, the place at t = 0, half the distances
/// of material layers across the axes, and the whole state of the material.
template <int dim>
struct Newcomers
{
  int                                  body = 0; ///< index into Scene::bodies
  std::array<std::vector<double>, dim> x, v, x0, half_cell;
  std::vector<double>                  mass;
  materials::Points                    points;

  std::size_t size() const { return mass.size(); }

  void resize(std::size_t n)
  {
    for (auto *field : {&x, &v, &x0, &half_cell})
      for (auto &component : *field)
        component.resize(n, 0.);
    mass.resize(n, 0.);
    points.resize(n);
  }
};
} // namespace ogive::sph
