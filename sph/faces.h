// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/scene.h"

#include <array>
#include <string>

namespace ogive::sph
{
/// The part of a body within `depth` of one of its faces.
///
/// "x-", "x+", "y-", ...: the faces of the box of all particles, grown by half
/// a spacing; "bottom", "top": the ends of the axis of a round body, the nose
/// included; "side", "inner", "outer": its round faces; "all": the whole body.
class Face
{
public:
  /// `lower`, `upper`: the box of the body. InputError naming `boundary` if the
  /// shape has no such face.
  Face(const std::string &name, const input::Shape &shape, const std::array<double, 3> &lower,
       const std::array<double, 3> &upper, int dim, const std::string &boundary);

  bool contains(const Vec3 &x, double depth) const;

private:
  enum class Kind
  {
    all,
    lower,
    upper,
    bottom,
    top,
    outer,
    inner
  };
  Kind   kind_ = Kind::all;
  int    axis_ = 0;
  double at_   = 0; ///< coordinate of a flat face, or radius of a round one
  Vec3   centre_ = Vec3::Zero(), along_ = Vec3::Zero();
  bool   spherical_ = false;
};
} // namespace ogive::sph
