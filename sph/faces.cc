// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/faces.h"

#include "core/base/error.h"

namespace ogive::sph
{
Face::Face(const std::string &name, const input::Shape &shape, const std::array<double, 3> &lower,
           const std::array<double, 3> &upper, int dim, const std::string &boundary)
{
  using input::ShapeKind;
  const bool round = shape.kind == ShapeKind::cylinder || shape.kind == ShapeKind::disc ||
                     shape.kind == ShapeKind::ring || shape.kind == ShapeKind::sphere ||
                     shape.kind == ShapeKind::shell;
  spherical_ = shape.kind == ShapeKind::sphere || shape.kind == ShapeKind::shell;
  centre_    = shape.base;
  along_     = spherical_ ? Vec3(Vec3::Zero()) : Vec3(shape.axis.normalized());
  const bool hollow = shape.inner_radius > 0;
  const bool ends   = round && !spherical_ && (dim == 3 || std::abs(along_[2]) < .5);
  if (name == "all")
    return;
  if (name.size() == 2 && name[0] >= 'x' && name[0] < 'x' + dim && (name[1] == '-' || name[1] == '+'))
  {
    axis_ = name[0] - 'x';
    kind_ = name[1] == '-' ? Kind::lower : Kind::upper;
    at_   = name[1] == '-' ? lower[axis_] : upper[axis_];
  }
  else if (ends && name == "bottom")
    kind_ = Kind::bottom;
  else if (ends && name == "top")
  {
    kind_ = Kind::top;
    at_   = shape.length + (shape.nose == input::Nose::blunt ? 0. : shape.nose_length);
  }
  else if (round && (name == "side" || name == "outer"))
  {
    kind_ = Kind::outer;
    at_   = shape.radius;
  }
  else if (round && hollow && name == "inner")
  {
    kind_ = Kind::inner;
    at_   = shape.inner_radius;
  }
  else
    throw InputError({"", 0, "Boundaries/" + boundary + "/face"}, "the body has no face \"" + name + "\"",
                     round ? "bottom, top, side, inner, outer, all, x-, x+, ..." : "x-, x+, y-, y+, z-, z+ or all");
}

bool Face::contains(const Vec3 &x, double depth) const
{
  const double s = along_.dot(x - centre_);
  const double r = (x - centre_ - s * along_).norm();
  switch (kind_)
  {
    case Kind::all:
      return true;
    case Kind::lower:
      return x[axis_] < at_ + depth;
    case Kind::upper:
      return x[axis_] > at_ - depth;
    case Kind::bottom:
      return s < depth;
    case Kind::top:
      return s > at_ - depth;
    case Kind::outer:
      return r > at_ - depth;
    case Kind::inner:
      return r < at_ + depth;
  }
  return false;
}
} // namespace ogive::sph
