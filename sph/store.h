// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/aligned.h"
#include "core/materials/points.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ogive::sph
{
/// The owned particles, structure of arrays, SI units; the particles of a body
/// are one range. This is all that a step changes: what else the solver keeps
/// (records, sums, lists) follows from it.
template <int dim>
struct Store
{
  std::array<AlignedVector<double>, dim> x, v;       ///< x(t_n), v(t_{n-1/2})
  std::array<AlignedVector<double>, dim> x0;         ///< at t = 0
  std::array<AlignedVector<double>, dim> x_listed;   ///< when the lists were built
  std::array<AlignedVector<double>, dim> external;   ///< Surface::force, N
  std::array<AlignedVector<double>, dim> prescribed; ///< velocity of fixed components
  std::array<AlignedVector<double>, dim> half_cell;  ///< half the distance of material layers across each axis, m
  AlignedVector<double>                  mass;
  AlignedVector<double>                  swept_density;  ///< density that the last gradient sweep used
  AlignedVector<double>                  viscosity_heat; ///< J/kg so far
  AlignedVector<double>                  hourglass_heat; ///< J/kg so far
  AlignedVector<double>                  density_scale; ///< rho over sum m W at t = 0, by summation
  AlignedVector<double>                  switch_factor; ///< of the viscosity, where the switch has a memory
  AlignedVector<double>                  rest_share;    ///< of the gap to walls, 1 but for newcomers that stand closer
  AlignedVector<double>                  divergence;    ///< of the velocity, in the step before
  materials::Points                      points;
  bool                                   in_parts = false; ///< steps may have parts:
  std::array<AlignedVector<double>, dim> v_strain; ///< mean velocity over the last step; empty otherwise
  std::vector<std::int64_t>              id;
  std::vector<std::int64_t>              fixed; ///< bit a: component a is prescribed
  std::vector<std::int64_t>              touch; ///< bit w: touches wall w (images.h)
  std::vector<int>                       body;

  std::size_t size() const { return mass.size(); }

  template <class F>
  void for_each_array(F &&f)
  {
    static constexpr const char *axis[3] = {"_x", "_y", "_z"};
    const auto vector = [&](const std::string &name, auto &a) {
      for (int d = 0; d < dim; ++d)
        f(name + axis[d], a[d]);
    };
    vector("x", x);
    vector("v", v);
    vector("x0", x0);
    vector("x_listed", x_listed);
    vector("external", external);
    vector("prescribed", prescribed);
    vector("half_cell", half_cell);
    if (in_parts)
      vector("v_strain", v_strain);
    f("mass", mass);
    f("swept_density", swept_density);
    f("viscosity_heat", viscosity_heat);
    f("hourglass_heat", hourglass_heat);
    f("density_scale", density_scale);
    f("switch_factor", switch_factor);
    f("rest_share", rest_share);
    f("divergence", divergence);
    points.for_each_array(f);
  }

  /// The fields that are no doubles.
  template <class F>
  void for_each_integer(F &&f)
  {
    f("id", id);
    f("fixed", fixed);
    f("touch", touch);
    f("body", body);
  }

  void resize(std::size_t n)
  {
    for_each_array([n](const std::string &, auto &a) { a.resize(n, 0.); });
    for_each_integer([n](const char *, auto &a) { a.resize(n, 0); });
  }

  /// Particle k becomes the one that was at order[k].
  void permute(const std::vector<std::uint32_t> &order)
  {
    const auto apply = [&order](auto &a) {
      auto old = a;
      for (std::size_t k = 0; k < order.size(); ++k)
        a[k] = old[order[k]];
    };
    for_each_array([&](const std::string &, auto &a) { apply(a); });
    for_each_integer([&](const char *, auto &a) { apply(a); });
  }
};
} // namespace ogive::sph
