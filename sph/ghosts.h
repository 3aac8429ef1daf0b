// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/scene.h"
#include "sph/mirror.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ogive::sph
{
/// Mirror images of the particles near the symmetry planes x_axis = 0, in the
/// corners also of the images, then those behind rigid walls. Image g follows
/// the owned particles: its record is number n_owned + g. Particles of other ranks
/// (exchange.cc) stand here too, before the images of their body, as images of
/// themselves, so that reflecting leaves their records alone.
struct Ghosts
{
  std::vector<std::uint32_t>                parent; ///< its record
  std::vector<std::array<double, 3>>        sign;  ///< -1 where a component is reflected
  std::vector<std::array<double, 3>>        offset; ///< of mirrors off the origin: x_image = sign x + offset, m
  std::vector<double>                       turn;   ///< -1 behind an odd mirror: of velocities and stresses
  std::vector<int>                          images; ///< set of walls behind which it lies (images.h), or -1
  std::vector<std::array<std::size_t, 2>>   range; ///< of each body, symmetry planes alone

  std::size_t size() const { return parent.size(); }

  void push_back(std::uint32_t of, const std::array<double, 3> &s, int behind,
                 const std::array<double, 3> &from_origin = {}, double turned = 1)
  {
    parent.push_back(of);
    sign.push_back(s);
    offset.push_back(from_origin);
    turn.push_back(turned);
    images.push_back(behind);
  }

  /// Images of the records of one body, several ranges, that may be closer than
  /// `reach` to it; appends their range, which begins with ghost `begin`.
  template <int dim>
  void append(const std::array<std::span<const double>, dim> &x, std::size_t begin,
              const std::array<std::array<std::size_t, 2>, 2> &of, double reach,
              std::span<const input::SymmetryPlane> planes, std::span<const Mirror> mirrors)
  {
    std::vector<Mirror> all(mirrors.begin(), mirrors.end());
    for (const auto &plane : planes)
      all.push_back({.axis = plane.axis});
    for (unsigned subset = 1; subset < (1u << all.size()); ++subset)
      for_each_of(of, [&](std::size_t i) {
        std::array<double, 3> s{1, 1, 1}, from_origin{};
        double                turned = 1;
        bool                  near   = true;
        for (std::size_t k = 0; k < all.size(); ++k)
          if (subset >> k & 1)
          {
            const int a = all[k].axis; // no images of images across opposite mirrors: they are too far
            near &= s[a] > 0 && (x[a][i] - all[k].at) * (all[k].below ? -1 : 1) < reach;
            s[a]           = -1;
            from_origin[a] = 2 * all[k].at;
            turned *= all[k].odd ? -1 : 1;
          }
        if (near)
          push_back(static_cast<std::uint32_t>(i), s, -1, from_origin, turned);
      });
    range.push_back({begin, size()});
  }

  template <class F>
  static void for_each_of(const std::array<std::array<std::size_t, 2>, 2> &ranges, F &&f)
  {
    for (const auto &[first, last] : ranges)
      for (std::size_t i = first; i < last; ++i)
        f(i);
  }

  void clear()
  {
    parent.clear();
    sign.clear();
    offset.clear();
    turn.clear();
    images.clear();
    range.clear();
  }
};
} // namespace ogive::sph
