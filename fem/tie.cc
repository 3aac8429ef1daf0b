// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/tie.h"

#include "fem/embedding.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ogive::fem
{
namespace
{
template <int dim>
using Vector = Eigen::Matrix<double, dim, 1>;

template <int dim>
Vector<dim> corner(const BodyMesh<dim> &mesh, std::uint32_t node)
{
  Vector<dim> x;
  for (int i = 0; i < dim; ++i)
    x[i] = mesh.x[i][node];
  return x;
}

template <int dim>
double longest_edge(const BodyMesh<dim> &mesh, const typename BodyMesh<dim>::Facet &facet)
{
  double longest = 0;
  if constexpr (dim == 1) // a point: the element behind it
    longest = std::abs(mesh.x[0][mesh.cells[2 * facet.cell]] - mesh.x[0][mesh.cells[2 * facet.cell + 1]]);
  else
    for (int k = 0; k < facet.n_nodes; ++k)
      longest = std::max(
          longest, (corner(mesh, facet.node[k]) - corner(mesh, facet.node[(k + 1) % facet.n_nodes])).norm());
  return longest;
}

bool is_cut(const std::string &boundary)
{
  return boundary.starts_with("symmetry");
}

/// Facets by their least first coordinate, to look at those near a point only.
template <int dim>
class Sweep
{
public:
  Sweep(const BodyMesh<dim> &mesh, double tolerance, const std::vector<bool> *only = nullptr) : mesh_(mesh)
  {
    for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    {
      const auto &facet = mesh.facets[f];
      if (is_cut(mesh.boundary_names[facet.boundary]) || (only && !(*only)[f]))
        continue;
      Item item{f, tolerance * longest_edge(mesh, facet), {}, {}};
      item.low.fill(std::numeric_limits<double>::infinity());
      item.high.fill(-item.low[0]);
      for (const std::uint32_t node : facet.node)
        for (int i = 0; i < dim; ++i)
        {
          item.low[i]  = std::min(item.low[i], mesh.x[i][node] - item.reach);
          item.high[i] = std::max(item.high[i], mesh.x[i][node] + item.reach);
        }
      widest_ = std::max(widest_, item.high[0] - item.low[0]);
      items_.push_back(item);
    }
    std::sort(items_.begin(), items_.end(), [](const Item &a, const Item &b) { return a.low[0] < b.low[0]; });
  }

  /// Calls f(facet, reach) for the facets whose widened box holds the point.
  template <class F>
  void near(const std::array<double, dim> &point, F &&f) const
  {
    auto item = std::lower_bound(items_.begin(), items_.end(), point[0] - widest_,
                                 [](const Item &a, double x) { return a.low[0] < x; });
    for (; item != items_.end() && item->low[0] <= point[0]; ++item)
    {
      bool inside = true;
      for (int i = 0; i < dim; ++i)
        inside = inside && point[i] >= item->low[i] && point[i] <= item->high[i];
      if (inside)
        f(mesh_.facets[item->facet], item->reach);
    }
  }

private:
  struct Item
  {
    std::size_t             facet;
    double                  reach;
    std::array<double, dim> low, high;
  };
  const BodyMesh<dim> &mesh_;
  std::vector<Item>    items_;
  double               widest_ = 0;
};

/// Least squares on the bilinear quadrilateral: Gauss-Newton, kept on the facet.
void nearest_on_quad(const std::array<Vector<3>, 4> &x, const Vector<3> &point, std::array<double, 4> &weight)
{
  Vector<2>                xi = Vector<2>::Zero();
  std::array<Vector<2>, 4> slope;
  for (int k = 0; k < 40; ++k)
  {
    shape_functions<2>(xi, weight, slope);
    Vector<3>                   miss = point;
    Eigen::Matrix<double, 3, 2> J    = Eigen::Matrix<double, 3, 2>::Zero();
    for (int a = 0; a < 4; ++a)
    {
      miss -= weight[a] * x[a];
      J += x[a] * slope[a].transpose();
    }
    const Vector<2> pull = J.transpose() * miss;
    // A coordinate at its end that is pulled outwards stays there.
    bool held[2];
    for (int i = 0; i < 2; ++i)
      held[i] = std::abs(xi[i]) >= 1 && pull[i] * xi[i] > 0;
    Vector<2> change = Vector<2>::Zero();
    if (!held[0] && !held[1])
      change = (J.transpose() * J).inverse() * pull;
    else
      for (int i = 0; i < 2; ++i)
        if (!held[i])
          change[i] = pull[i] / J.col(i).squaredNorm();
    const Vector<2> before = xi;
    xi                     = (xi + change).cwiseMax(-1.).cwiseMin(1.);
    if ((xi - before).cwiseAbs().maxCoeff() < 1e-15)
      break;
  }
  shape_functions<2>(xi, weight, slope);
}
} // namespace

template <int dim>
double nearest_on_facet(const BodyMesh<dim> &mesh, const typename BodyMesh<dim>::Facet &facet,
                        const std::array<double, dim>                     &point,
                        std::array<double, BodyMesh<dim>::Facet::n_nodes> &weight)
{
  constexpr int              n = BodyMesh<dim>::Facet::n_nodes;
  const auto                 p = Eigen::Map<const Vector<dim>>(point.data());
  std::array<Vector<dim>, n> x;
  for (int k = 0; k < n; ++k)
    x[k] = corner(mesh, facet.node[k]);
  if constexpr (dim == 1)
    weight[0] = 1;
  else if constexpr (dim == 2)
  {
    const Vector<2> edge = x[1] - x[0];
    weight[1]            = std::clamp((p - x[0]).dot(edge) / edge.squaredNorm(), 0., 1.);
    weight[0]            = 1 - weight[1];
  }
  else
    nearest_on_quad(x, p, weight);
  double sum = 0;
  for (double &w : weight)
    sum += w = w < 1e-9 ? 0 : w;
  Vector<dim> foot = Vector<dim>::Zero();
  for (int k = 0; k < n; ++k)
    foot += (weight[k] /= sum) * x[k];
  return (p - foot).norm();
}

template <int dim>
std::vector<TiedNode<dim>> find_tied(const BodyMesh<dim> &slave, const BodyMesh<dim> &master,
                                     double tolerance)
{
  std::vector<bool> surface(slave.n_nodes(), false);
  for (const auto &facet : slave.facets)
    if (!is_cut(slave.boundary_names[facet.boundary]))
      for (const std::uint32_t node : facet.node)
        surface[node] = true;
  const Sweep<dim>           facets(master, tolerance);
  std::vector<TiedNode<dim>> found;
  for (std::uint32_t a = 0; a < slave.n_nodes(); ++a)
  {
    if (!surface[a])
      continue;
    std::array<double, dim> point;
    for (int i = 0; i < dim; ++i)
      point[i] = slave.x[i][a];
    TiedNode<dim> best{a, {}, {}, std::numeric_limits<double>::infinity()};
    facets.near(point,
                [&](const auto &facet, double reach)
                {
                  std::array<double, TiedNode<dim>::n_masters> weight;
                  const double gap = nearest_on_facet<dim>(master, facet, point, weight);
                  if (gap <= reach && gap < best.gap)
                    best = {a, facet.node, weight, gap};
                });
    if (std::isfinite(best.gap))
      found.push_back(best);
  }
  return found;
}

template <int dim>
void mark_covered(const BodyMesh<dim> &mesh, const BodyMesh<dim> &other, const std::vector<bool> &of_other,
                  double tolerance, std::vector<bool> &covered)
{
  const Sweep<dim> facets(other, tolerance, &of_other);
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
  {
    const auto             &facet = mesh.facets[f];
    std::array<double, dim> centre{};
    for (const std::uint32_t node : facet.node)
      for (int i = 0; i < dim; ++i)
        centre[i] += mesh.x[i][node] / facet.n_nodes;
    facets.near(centre,
                [&](const auto &candidate, double reach)
                {
                  std::array<double, TiedNode<dim>::n_masters> weight;
                  covered[f] = covered[f] || nearest_on_facet<dim>(other, candidate, centre, weight) <= reach;
                });
  }
}

#define OGIVE_INSTANTIATE(dim)                                                                               \
  template double nearest_on_facet<dim>(const BodyMesh<dim> &, const BodyMesh<dim>::Facet &,                 \
                                        const std::array<double, dim> &,                                     \
                                        std::array<double, BodyMesh<dim>::Facet::n_nodes> &);                \
  template std::vector<TiedNode<dim>> find_tied(const BodyMesh<dim> &, const BodyMesh<dim> &, double);       \
  template void mark_covered(const BodyMesh<dim> &, const BodyMesh<dim> &, const std::vector<bool> &,        \
                             double, std::vector<bool> &);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::fem
