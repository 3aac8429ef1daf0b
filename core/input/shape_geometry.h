// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/scene.h"

#include <vector>

/// Simple questions to shapes, for checks of a scene. Metres. Coordinates that
/// the dimension lacks are zero; in axial symmetry points are (r, y, 0). None of
/// them knows shapes of mesh files.
namespace ogive::input
{
struct BoundingBox
{
  Vec3 lower, upper;
};

/// Along the axis of a cylinder, disc or ring, nose included.
double total_length(const Shape &);

/// Radius of the outer surface at distance t from the base, 0 <= t <= total_length.
double radius_at(const Shape &, double t);

/// Whether a point lies inside by more than `margin`.
bool contains(const Shape &, Dimension, const Vec3 &point, double margin);

/// Greatest x.n over the shape.
double support(const Shape &, Dimension, const Vec3 &n);

BoundingBox bounding_box(const Shape &, Dimension);

/// Points inside the shape, some of them close to its surface.
std::vector<Vec3> inner_points(const Shape &, Dimension);

/// Looks for a point deep inside both shapes, on the kept side of the symmetry
/// planes: on a lattice over the common part of the bounding boxes and among the
/// inner points of both. True, and the point, if there is one.
bool find_overlap(const Shape &, const Shape &, const Scene &, Vec3 &point);
} // namespace ogive::input
