// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ogive::sph
{
/// Mirror images of the particles near the symmetry planes x_axis = 0, in the
/// corners also of the images, then those behind rigid walls. Image g follows
/// the owned particles: its record is number n_owned + g.
struct Ghosts
{
  std::vector<std::uint32_t>                parent;
  std::vector<std::array<double, 3>>        sign;  ///< -1 where a component is reflected
  std::vector<int>                          images; ///< set of walls behind which it lies (images.h), or -1
  std::vector<std::array<std::size_t, 2>>   range; ///< of each body, symmetry planes alone

  std::size_t size() const { return parent.size(); }

  void push_back(std::uint32_t of, const std::array<double, 3> &s, int behind)
  {
    parent.push_back(of);
    sign.push_back(s);
    images.push_back(behind);
  }

  /// Images of one body, [first, last) of the owned particles, that may be
  /// closer than `reach` to it; appends a range.
  template <int dim>
  void append(const std::array<std::span<const double>, dim> &x, std::size_t first, std::size_t last,
              double reach, std::span<const input::SymmetryPlane> planes)
  {
    const std::size_t begin = size();
    for (unsigned subset = 1; subset < (1u << planes.size()); ++subset)
      for (std::size_t i = first; i < last; ++i)
      {
        std::array<double, 3> s{1, 1, 1};
        bool                  near = true;
        for (std::size_t k = 0; k < planes.size(); ++k)
          if (subset >> k & 1)
          {
            near &= x[planes[k].axis][i] < reach;
            s[planes[k].axis] = -1;
          }
        if (near)
          push_back(static_cast<std::uint32_t>(i), s, -1);
      }
    range.push_back({begin, size()});
  }

  void clear()
  {
    parent.clear();
    sign.clear();
    images.clear();
    range.clear();
  }
};
} // namespace ogive::sph
