// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/mesh_blocks.h"

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ogive::fem::blocks
{
namespace
{
using dealii::Point;

unsigned int count(double length, double spacing)
{
  return static_cast<unsigned int>(std::max(1., std::round(length / spacing)));
}

/// Direction of cap coordinates (u, v) in [0,1]^2 on the cap about axis 0:
/// equal steps turn by equal angles.
Point<3> cap_direction(double u, double v)
{
  const double   quarter = std::numbers::pi / 4;
  const Point<3> p(1, std::tan(quarter * u), std::tan(quarter * v));
  return Point<3>(p / p.norm());
}

/// Cyclic change of axes, which keeps handedness.
Point<3> rolled(const Point<3> &p, int axis)
{
  Point<3> q;
  for (int i = 0; i < 3; ++i)
    q[(i + axis) % 3] = p[i];
  return q;
}

/// The core of a ball on the unit octant: half cube, half ball, so that no
/// corner of the cube is flat.
Point<3> ball_core(const Point<3> &p)
{
  const double t = std::max({p[0], p[1], p[2]});
  if (t == 0)
    return p;
  const int axis = p[0] == t ? 0 : p[1] == t ? 1 : 2;
  Point<3>  d    = cap_direction(p[(axis + 1) % 3] / t, p[(axis + 2) % 3] / t);
  return Point<3>(.5 * p + .6 * t * rolled(d, axis));
}
} // namespace

template <int dim>
void Raw<dim>::add(const std::array<unsigned int, dim>                        &n,
                   const std::function<Point<dim>(const Point<dim> &)> &map)
{
  const auto                    first = static_cast<unsigned int>(vertices.size());
  std::array<unsigned int, 3>   m{1, 1, 1}, nodes{1, 1, 1};
  for (int i = 0; i < dim; ++i)
  {
    m[i]     = n[i];
    nodes[i] = n[i] + 1;
  }
  for (unsigned int k = 0; k < nodes[2]; ++k)
    for (unsigned int j = 0; j < nodes[1]; ++j)
      for (unsigned int i = 0; i < nodes[0]; ++i)
      {
        const unsigned int index[3] = {i, j, k};
        Point<dim>         u;
        for (int d = 0; d < dim; ++d)
          u[d] = double(index[d]) / m[d];
        vertices.push_back(map(u));
      }
  for (unsigned int k = 0; k < m[2]; ++k)
    for (unsigned int j = 0; j < m[1]; ++j)
      for (unsigned int i = 0; i < m[0]; ++i)
      {
        dealii::CellData<dim> cell;
        for (unsigned int c = 0; c < 1u << dim; ++c)
          cell.vertices[c] =
            first + (i + (c & 1)) + nodes[0] * ((j + (c >> 1 & 1)) + nodes[1] * (k + (c >> 2 & 1)));
        cells.push_back(cell);
      }
}

template <int dim>
void Raw<dim>::append(const Raw &other)
{
  const auto first = static_cast<unsigned int>(vertices.size());
  vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
  for (auto cell : other.cells)
  {
    for (auto &v : cell.vertices)
      v += first;
    cells.push_back(cell);
  }
}

template <int dim>
Raw<dim> Raw<dim>::mirrored(int axis) const
{
  Raw out = *this;
  for (auto &v : out.vertices)
    v[axis] = v[axis] == 0 ? 0 : -v[axis];
  for (auto &cell : out.cells)
    for (unsigned int c = 0; c < 1u << dim; c += 2)
      std::swap(cell.vertices[c], cell.vertices[c + 1]);
  return out;
}

template <int dim>
void Raw<dim>::merge(double tolerance)
{
  // Cells of neighbours in a line of equal sorted coordinates: bins of the
  // tolerance would split pairs at their edges, so compare along a sorted sweep.
  std::vector<unsigned int> order(vertices.size());
  for (unsigned int i = 0; i < order.size(); ++i)
    order[i] = i;
  std::sort(order.begin(), order.end(),
            [this](unsigned int a, unsigned int b) { return vertices[a][0] < vertices[b][0]; });
  std::vector<unsigned int> to(vertices.size());
  for (unsigned int i = 0; i < to.size(); ++i)
    to[i] = i;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1;
         j < order.size() && vertices[order[j]][0] - vertices[order[i]][0] <= tolerance; ++j)
      if (vertices[order[i]].distance(vertices[order[j]]) <= tolerance)
      {
        const unsigned int a = to[order[i]], b = to[order[j]];
        to[order[i]] = to[order[j]] = std::min(a, b);
      }
  std::vector<dealii::Point<dim>> kept;
  std::vector<unsigned int>       name(vertices.size());
  for (unsigned int i = 0; i < to.size(); ++i)
    if (to[i] == i)
    {
      name[i] = static_cast<unsigned int>(kept.size());
      kept.push_back(vertices[i]);
    }
  for (auto &cell : cells)
    for (auto &v : cell.vertices)
    {
      while (to[v] != v)
        v = to[v];
      v = name[v];
    }
  vertices = std::move(kept);
}

template <int dim>
Raw<dim> mirror_all(const Raw<dim> &piece, const Kept &kept, double tolerance)
{
  Raw<dim> whole = piece;
  for (int i = 0; i < dim; ++i)
  {
    Raw<dim> both;
    if (kept.positive[i])
      both.append(whole);
    if (kept.negative[i])
      both.append(whole.mirrored(i));
    whole = std::move(both);
  }
  whole.merge(tolerance);
  return whole;
}

std::vector<double> graded(double length, double first, double last)
{
  const double ratio = last / first;
  const bool   even  = std::abs(ratio - 1) < 1e-6;
  const auto   n     = static_cast<unsigned int>(
    std::max(1., std::round(even ? length / first : length * std::log(ratio) / (last - first))));
  std::vector<double> s(n + 1);
  for (unsigned int i = 0; i <= n; ++i)
    s[i] = even ? double(i) / n : (std::pow(ratio, double(i) / n) - 1) / (ratio - 1);
  s.back() = 1;
  return s;
}

Raw<2> disc_quadrant(double radius, double spacing, double spacing_far)
{
  const double       far  = spacing_far > 0 ? spacing_far : spacing;
  const unsigned int n    = count(std::min(.6 * radius / spacing, std::numbers::pi / 4 * radius / far), 1);
  const double       core = far > spacing ? std::min(.6 * radius, n * spacing) : .6 * radius;
  const auto         square = [core](double u, double v) {
    // The corner is pulled in to 1.2 times the side: angles of 90 .. 130 degrees.
    return Point<2>(core * (1 - .15 * u * v) * Point<2>(u, v));
  };
  Raw<2> raw;
  raw.add({n, n}, [&](const Point<2> &p) { return square(p[0], p[1]); });
  const std::vector<double> s = graded(radius - 1.08 * core, spacing, far);
  const auto                m = static_cast<unsigned int>(s.size() - 1);
  raw.add({m, 2 * n}, [&](const Point<2> &p) {
    const double   t     = p[1] * 2; // along the core's edge from (1,0) by the corner to (0,1)
    const Point<2> inner = t <= 1 ? square(1, t) : square(2 - t, 1);
    const double   angle = std::numbers::pi / 2 * p[1];
    const Point<2> outer(radius * std::cos(angle), radius * std::sin(angle));
    const double   f = s[static_cast<std::size_t>(std::lround(p[0] * m))];
    Point<2>       q(inner + f * (outer - inner));
    if (p[1] == 0)
      q[1] = 0;
    if (p[1] == 1)
      q[0] = 0;
    return q;
  });
  raw.merge(1e-6 * spacing);
  return raw;
}

Raw<2> ring_quadrant(double inner, double outer, double spacing, double spacing_far)
{
  const std::vector<double> s = graded(outer - inner, spacing, spacing_far > 0 ? spacing_far : spacing);
  const auto                m = static_cast<unsigned int>(s.size() - 1);
  Raw<2>                    raw;
  raw.add({m, count(std::numbers::pi / 2 * inner, spacing)}, [&](const Point<2> &p) {
    const double r     = inner + s[static_cast<std::size_t>(std::lround(p[0] * m))] * (outer - inner);
    const double angle = std::numbers::pi / 2 * p[1];
    return Point<2>(p[1] == 1 ? 0 : r * std::cos(angle), p[1] == 0 ? 0 : r * std::sin(angle));
  });
  return raw;
}

Raw<3> ball_octant(double radius, double spacing)
{
  const double       core = .5 * radius;
  const unsigned int n    = count(.6 * radius, spacing), m = count(.4 * radius, spacing);
  Raw<3>             raw;
  raw.add({n, n, n}, [&](const Point<3> &p) { return Point<3>(core * ball_core(p)); });
  for (int axis = 0; axis < 3; ++axis)
    raw.add({m, n, n}, [&](const Point<3> &p) {
      const Point<3> inner(core * ball_core(rolled(Point<3>(1, p[1], p[2]), axis)));
      const Point<3> outer(radius * rolled(cap_direction(p[1], p[2]), axis));
      return Point<3>(inner + p[0] * (outer - inner));
    });
  raw.merge(1e-6 * spacing);
  return raw;
}

Raw<3> shell_octant(double inner, double outer, double spacing)
{
  const unsigned int n = count(std::numbers::pi / 8 * (inner + outer), spacing);
  Raw<3>             raw;
  for (int axis = 0; axis < 3; ++axis)
    raw.add({count(outer - inner, spacing), n, n}, [&](const Point<3> &p) {
      return Point<3>((inner + p[0] * (outer - inner)) * rolled(cap_direction(p[1], p[2]), axis));
    });
  raw.merge(1e-6 * spacing);
  return raw;
}

Raw<3> extrude(const Raw<2> &section, const std::vector<double> &levels)
{
  Raw<3>     raw;
  const auto n = static_cast<unsigned int>(section.vertices.size());
  for (const double z : levels)
    for (const auto &p : section.vertices)
      raw.vertices.emplace_back(p[0], p[1], z);
  for (unsigned int k = 0; k + 1 < levels.size(); ++k)
    for (const auto &cell : section.cells)
    {
      dealii::CellData<3> hex;
      for (unsigned int c = 0; c < 8; ++c)
        hex.vertices[c] = cell.vertices[c & 3] + n * (k + (c >> 2));
      raw.cells.push_back(hex);
    }
  return raw;
}

template struct Raw<1>;
template struct Raw<2>;
template struct Raw<3>;
template Raw<2> mirror_all<2>(const Raw<2> &, const Kept &, double);
template Raw<3> mirror_all<3>(const Raw<3> &, const Kept &, double);
} // namespace ogive::fem::blocks
