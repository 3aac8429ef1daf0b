// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ogive::coupling
{
/// In three components, the absent ones zero.
template <int dim>
Vec3 spatial(const Point<dim> &p)
{
  Vec3 v = Vec3::Zero();
  v.head<dim>() = p;
  return v;
}

/// The point of a facet nearest to a given point.
template <int dim>
struct Foot
{
  static constexpr int        n_nodes = Surface<dim>::Facet::n_nodes;
  Point<dim>                  where   = Point<dim>::Zero();
  Point<dim>                  normal  = Point<dim>::Zero(); ///< outward, unit length; zero where degenerate
  std::array<double, n_nodes> weight{};                     ///< sum 1; where = sum weight * corner
  int                         triangle = 0;                 ///< of a quad: the one it lies in
  double                      distance2 = std::numeric_limits<double>::infinity();
};

/// Nearest point of the segment a-b: the weight of b, within [0, 1].
template <int dim>
double nearest_on_segment(const Point<dim> &p, const Point<dim> &a, const Point<dim> &b)
{
  const Point<dim> ab     = b - a;
  const double     square = ab.squaredNorm();
  return square > 0 ? std::min(1., std::max(0., (p - a).dot(ab) / square)) : 0.;
}

/// Weights of a, b, c for the nearest point of the triangle; `normal` is
/// (b - a) x (c - a), which may be zero.
inline std::array<double, 3> nearest_on_triangle(const Point<3> &p, const Point<3> &a, const Point<3> &b,
                                                 const Point<3> &c, const Point<3> &normal)
{
  const double square = normal.squaredNorm();
  if (square > 0)
  {
    const double wb = (p - a).cross(c - a).dot(normal) / square;
    const double wc = (b - a).cross(p - a).dot(normal) / square;
    if (wb >= 0 && wc >= 0 && wb + wc <= 1)
      return {1 - wb - wc, wb, wc};
  }
  const Point<3>        corner[3] = {a, b, c};
  std::array<double, 3> best{};
  double                least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k)
  {
    const int    l = (k + 1) % 3;
    const double t = nearest_on_segment<3>(p, corner[k], corner[l]);
    const double d = (p - corner[k] - t * (corner[l] - corner[k])).squaredNorm();
    if (d < least)
    {
      least = d;
      best  = {};
      best[k] += 1 - t;
      best[l] += t;
    }
  }
  return best;
}

/// Replaces `best` by `other` if it is nearer; between equally near ones (an
/// edge or corner that facets share) the one whose plane stands most across
/// the line to the point decides on which side the point is. Where that is alike
/// too, as on a plane of symmetry, the normals decide and not the numbers of the
/// facets, so that mirrored bodies choose mirrored ones.
template <int dim>
bool better_foot(const Point<dim> &p, const Foot<dim> &other, const Foot<dim> &best)
{
  constexpr double same = 1e-12;
  if (other.distance2 < best.distance2 * (1 - same))
    return true;
  if (other.distance2 > best.distance2 * (1 + same))
    return false;
  const double across    = std::abs((p - other.where).dot(other.normal));
  const double other_way = std::abs((p - best.where).dot(best.normal));
  const double tie       = 1e-9 * std::sqrt(best.distance2);
  if (std::abs(across - other_way) > tie)
    return across > other_way;
  for (int i = dim - 1; i >= 0; --i)
    if (std::abs(other.normal[i] - best.normal[i]) > 1e-9)
      return other.normal[i] > best.normal[i];
  return false;
}

/// Nearest point of a facet given its corners. A quad is the surface of four
/// triangles about its centroid, so neighbours share their edges and nothing
/// passes between them; the corner weights are linear in each triangle.
/// `outward` is the sign of Surface::Facet in one dimension.
template <int dim>
Foot<dim> foot_on_facet(const Point<dim>                                            &p,
                        const std::array<Point<dim>, Surface<dim>::Facet::n_nodes> &corner,
                        [[maybe_unused]] double                                     outward)
{
  Foot<dim> best;
  if constexpr (dim == 1)
  {
    best.where  = corner[0];
    best.normal = Point<1>(outward);
    best.weight = {1.};
  }
  else if constexpr (dim == 2)
  {
    const double   t  = nearest_on_segment<2>(p, corner[0], corner[1]);
    const Point<2> ab = corner[1] - corner[0];
    const double   l  = ab.norm();
    best.where        = corner[0] + t * ab;
    best.weight       = {1 - t, t};
    if (l > 0)
      best.normal = Point<2>(ab[1] / l, -ab[0] / l);
  }
  else
  {
    const Point<3> centroid = .25 * (corner[0] + corner[1] + corner[2] + corner[3]);
    for (int k = 0; k < 4; ++k)
    {
      const int      l      = (k + 1) % 4;
      const Point<3> normal = (corner[l] - corner[k]).cross(centroid - corner[k]);
      const double   area   = normal.norm();
      const auto     w      = nearest_on_triangle(p, corner[k], corner[l], centroid, normal);
      Foot<3>        foot;
      foot.where = w[0] * corner[k] + w[1] * corner[l] + w[2] * centroid;
      foot.weight.fill(.25 * w[2]);
      foot.weight[k] += w[0];
      foot.weight[l] += w[1];
      foot.triangle = k;
      if (area > 0)
        foot.normal = normal / area;
      foot.distance2 = (p - foot.where).squaredNorm();
      if (better_foot<3>(p, foot, best))
        best = foot;
    }
  }
  if constexpr (dim < 3)
    best.distance2 = (p - best.where).squaredNorm();
  return best;
}

/// Moves the foot to the projection of the point on the plane of the facet (of
/// the foot's triangle), past its edges if need be: weights may leave [0, 1],
/// their sum stays 1, and the distance to the plane has them as its gradient.
template <int dim>
void draw_on(const Point<dim> &p, const std::array<Point<dim>, Surface<dim>::Facet::n_nodes> &corner, Foot<dim> &foot)
{
  if constexpr (dim == 2)
  {
    const Point<2> ab     = corner[1] - corner[0];
    const double   square = ab.squaredNorm();
    const double   t      = square > 0 ? (p - corner[0]).dot(ab) / square : 0;
    foot.weight           = {1 - t, t};
  }
  else if constexpr (dim == 3)
  {
    const int      k = foot.triangle, l = (k + 1) % 4;
    const Point<3> centroid = .25 * (corner[0] + corner[1] + corner[2] + corner[3]);
    const Point<3> b = corner[l] - corner[k], c = centroid - corner[k], normal = b.cross(c);
    const double   square = normal.squaredNorm();
    if (!(square > 0))
      return;
    const double wb = (p - corner[k]).cross(c).dot(normal) / square;
    const double wc = b.cross(p - corner[k]).dot(normal) / square;
    foot.weight.fill(.25 * wc);
    foot.weight[k] += 1 - wb - wc;
    foot.weight[l] += wb;
  }
  foot.where.setZero();
  for (int k = 0; k < Foot<dim>::n_nodes; ++k)
    foot.where += foot.weight[k] * corner[k];
}

/// Where a point stands against a surface.
template <int dim>
struct Stand
{
  bool          found = false;
  std::uint32_t facet = 0;
  Foot<dim>     foot;
  double        distance  = std::numeric_limits<double>::infinity(); ///< > 0 outside, m
  Point<dim>    direction = Point<dim>::Zero();                      ///< unit, from the surface outwards

  /// A node past the rim of the face that it meets: how far it is outside, and
  /// from which facet (of the side). 0: not past it.
  double        overhang   = 0; ///< m
  std::uint32_t side_facet = 0;
  Foot<dim>     side;
  Point<dim>    aside = Point<dim>::Zero(); ///< unit, from the side outwards
};

/// Completes distance and direction from the nearest foot. Very near the
/// surface the line to the foot is rounding, and the facet's normal serves.
template <int dim>
void finish_stand(const Point<dim> &p, double size, Stand<dim> &stand)
{
  const Point<dim> line   = p - stand.foot.where;
  const double     length = line.norm();
  const double     side   = line.dot(stand.foot.normal);
  stand.distance          = side >= 0 ? length : -length;
  stand.direction = length > 1e-8 * size ? Point<dim>(line / stand.distance) : stand.foot.normal;
}
} // namespace ogive::coupling
