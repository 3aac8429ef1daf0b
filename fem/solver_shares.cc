// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "fem/element_partition.h"
#include "fem/solver_implementation.h"

#include <algorithm>
#include <cmath>

/// Whose each element is, and how elements change hands.
namespace ogive::fem
{
namespace
{
/// Counted cost of a step of an element, in points of one-point elements.
template <int dim>
double points_of(const BodyMesh<dim> &mesh)
{
  if (mesh.degree > 1)
    return std::pow(mesh.degree + 1, dim);
  return mesh.element == "full" || mesh.element == "b-bar" ? BodyMesh<dim>::corners : 1;
}

/// Corner a (VTK order) among the nodes of an element of a mesh.
template <int dim>
std::size_t corner_of(const BodyMesh<dim> &mesh, int a)
{
  if (mesh.degree == 1)
    return static_cast<std::size_t>(a);
  const std::size_t p = static_cast<std::size_t>(mesh.degree), line = p + 1;
  const bool        far[3] = {a % 4 == 1 || a % 4 == 2, a % 4 >= 2, a >= 4};
  return (far[0] ? p : 0) + (far[1] ? p * line : 0) + (far[2] ? p * line * line : 0);
}
} // namespace

template <int dim>
double Solver<dim>::Implementation::own_work() const
{
  double work = 0;
  for (const auto &group : groups)
    for (std::size_t e = 0; e < group->size(); ++e)
      work += group->work(e);
  return work;
}

template <int dim>
std::vector<double> Solver<dim>::Implementation::work_of_elements() const
{
  std::vector<double> work;
  for (std::size_t g = 0; g < distribution.bodies().size(); ++g)
  {
    const auto &body = distribution.bodies()[g];
    if (groups.size() <= g)
    {
      work.insert(work.end(), body.mesh.n_elements(), points_of(body.mesh));
      continue;
    }
    std::vector<double> own;
    for (std::size_t e = 0; e < groups[g]->size(); ++e)
      own.push_back(groups[g]->work(e));
    std::vector<std::size_t> first;
    const auto               each = distribution.ranks().gather(own, &first);
    for (std::size_t e = 0; e < body.owner.size(); ++e)
      work.push_back(each[first[body.owner[e]] + body.place[e]]);
  }
  return work;
}

/// Boxes are cut around the elements where they are; the forest knows no places, but
/// its mesh must not be inside out.
template <int dim>
std::vector<int> Solver<dim>::Implementation::partition() const
{
  const bool        forest = parameters.parallel.partition == "p4est";
  const auto       &x      = forest ? nodes.x0 : nodes.x;
  ElementCloud<dim> cloud;
  cloud.work = work_of_elements();
  for (std::size_t a = 0; forest && a < nodes.size(); ++a)
  {
    auto &vertex = cloud.vertex.emplace_back();
    for (int i = 0; i < dim; ++i)
      vertex[i] = x[i][a];
  }
  for (const auto &body : distribution.bodies())
  {
    const auto       &list = body.mesh.degree > 1 ? body.mesh.elements : body.mesh.cells;
    const std::size_t n = body.mesh.n_elements(), each = n > 0 ? list.size() / n : 0;
    for (std::size_t e = 0; e < n; ++e)
    {
      std::array<double, dim>                              centre{};
      std::array<unsigned int, ElementCloud<dim>::corners> corners{};
      for (int a = 0; a < ElementCloud<dim>::corners; ++a)
      {
        corners[a] = static_cast<unsigned int>(body.first_node + list[e * each + corner_of(body.mesh, a)]);
        for (int i = 0; i < dim; ++i)
          centre[i] += x[i][corners[a]] / ElementCloud<dim>::corners;
      }
      for (int i = 0; i < dim; ++i)
        cloud.x[i].push_back(centre[i]);
      if (forest)
        cloud.cell.push_back(corners);
    }
  }
  return partition_elements(distribution.ranks(), parameters.parallel.partition, cloud);
}

template <int dim>
void Solver<dim>::Implementation::share_out()
{
  if (parameters.options.local_steps != "none")
    throw InputError({"", 0, "FEM/local steps"}, "elements that step by classes cannot be shared among ranks",
                     "FEM/local steps = none", "or one rank");
  for (auto &component : total)
    component.assign(nodes.size(), 0.);
  distribution.assign(partition(), constraints, nodes);
}

/// Groups of other elements, without their history.
template <int dim>
void Solver<dim>::Implementation::rebuild_groups(std::span<const int> owners)
{
  distribution.assign(owners, constraints, nodes);
  for (auto &component : total)
    std::fill(component.begin(), component.end(), 0.);
  const AlignedVector<double> mass = nodes.mass;
  const auto                  x    = nodes.x;
  for (int i = 0; i < dim; ++i) // shape and masses are those of the undeformed state
    std::copy(nodes.x0[i].begin(), nodes.x0[i].end(), nodes.x[i].begin());
  groups.clear();
  for (std::size_t b = 0; b < places.size(); ++b)
  {
    const BodyMesh<dim> mesh = distribution.own_mesh(b);
    groups.push_back(make_element_group<dim>(mesh, places[b], parameters.options));
    groups[b]->initialise(nodes);
    if (mesh.loses_elements())
      groups[b]->prepare_erosion(nodes);
  }
  for (int i = 0; i < dim; ++i)
    std::copy(x[i].begin(), x[i].end(), nodes.x[i].begin());
  for (const Order &order : weighed)
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (groups[g]->body() == order.body)
        weigh_own(g, order.elements, order.shares);
  for (const Order &order : damped)
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (groups[g]->body() == order.body)
        groups[g]->damp(own_of(g, order.elements), order.shares.at(0));
  std::copy(mass.begin(), mass.end(), nodes.mass.begin());
  find_shown();
}

template <int dim>
void Solver<dim>::Implementation::move_elements(const std::vector<int> &owners)
{
  const std::vector<int> from = distribution.owners();
  if (owners == from)
    return;
  complete_nodes();
  const auto state = take_state();
  rebuild_groups(owners);
  give_state(move_state(state, from));
  state_was_changed();
  review_erosion();
  ++moves;
}

/// Now and then: is the work of all ranks still even?
template <int dim>
void Solver<dim>::Implementation::look_at_shares()
{
  age[0] += 1;
  if (age[0] < parameters.parallel.interval)
    return;
  age[0]            = 0;
  const double own  = own_work();
  const double most = distribution.ranks().max(own), mean = sum(own) / distribution.ranks().size();
  if (most > parameters.parallel.imbalance * mean)
    move_elements(partition());
}

template <int dim>
auto Solver<dim>::share() const -> Share
{
  const auto &s = *self_;
  Share       share;
  for (const auto &group : s.groups)
    share.elements += group->size();
  share.work = s.own_work();
  for (std::size_t a = 0; a < s.nodes.size(); ++a)
    share.nodes += s.nodes.keeps(a);
  share.shared     = s.distribution.shared().nodes().size();
  share.given      = s.distribution.shared().given();
  share.neighbours = s.distribution.shared().neighbours();
  share.shown      = s.shown.node.size();
  share.moves      = s.moves;
  return share;
}

template <int dim>
bool Solver<dim>::keeps(std::uint32_t node) const
{
  return self_->nodes.keeps(node);
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template std::vector<int> Solver<d>::Implementation::partition() const;                                    \
  template void             Solver<d>::Implementation::share_out();                                          \
  template void             Solver<d>::Implementation::rebuild_groups(std::span<const int>);                 \
  template void             Solver<d>::Implementation::look_at_shares();                                     \
  template bool             Solver<d>::keeps(std::uint32_t) const;                                           \
  template auto             Solver<d>::share() const->Share;
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::fem
