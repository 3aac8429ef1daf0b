// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/material.h"

#include <cstddef>
#include <memory>
#include <string>

namespace ogive::fem
{
struct BenchResult
{
  std::size_t elements = 0, steps = 0;
  double      seconds                  = 0;
  double      element_steps_per_second = 0;
  double      bytes_per_element        = 0; ///< held, nodes included
};

/// Runs `steps` whole steps of an n x n x n block of hexes (input::Body::element)
/// of edge 1 mm that twists and stretches, so that every element strains. One core.
BenchResult bench(unsigned int n, std::size_t steps, std::shared_ptr<const materials::Material>,
                  const std::string &element = "one-point");
} // namespace ogive::fem
