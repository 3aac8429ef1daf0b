// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/constraints.h"

#include "core/base/error.h"
#include "fem/tie.h"

#include <algorithm>
#include <map>

namespace ogive::fem
{
namespace
{
template <int dim>
std::size_t mesh_of(const std::vector<BodyMesh<dim>> &meshes, int body, const std::string &tie)
{
  for (std::size_t m = 0; m < meshes.size(); ++m)
    if (meshes[m].body == body)
      return m;
  throw InputError({"", 0, "Interfaces/" + tie}, "a tied body has no mesh");
}
} // namespace

template <int dim>
Constraints<dim>::Constraints(const Parameters &p, std::vector<BodyMesh<dim>> &meshes,
                              const std::vector<std::size_t> &first_node)
{
  std::size_t n   = 0;
  bool        any = !p.ties.empty();
  for (const auto &mesh : meshes)
  {
    n += mesh.n_nodes();
    any = any || !mesh.hanging.empty();
  }
  if (!any)
    return;
  std::vector<Terms> terms(n);
  for (std::size_t m = 0; m < meshes.size(); ++m)
  {
    for (const auto &hanging : meshes[m].hanging)
      for (std::size_t k = 0; k < hanging.n; ++k)
      {
        terms[first_node[m] + hanging.node].node.push_back(
            static_cast<std::uint32_t>(first_node[m] + hanging.master[k]));
        terms[first_node[m] + hanging.node].weight.push_back(1. / hanging.n);
      }
    covered_.emplace_back(meshes[m].facets.size(), false);
  }
  for (const Tie &tie : p.ties)
    add_tie(tie, mesh_of(meshes, tie.slave, tie.name), mesh_of(meshes, tie.master, tie.name), meshes,
            first_node, terms);
  store(terms);
  place(meshes, first_node);
  for (const Tie &tie : p.ties)
    check_quality(meshes[mesh_of(meshes, tie.slave, tie.name)], "Interfaces/" + tie.name);
}

template <int dim>
void Constraints<dim>::add_tie(const Tie &tie, std::size_t s, std::size_t m,
                               const std::vector<BodyMesh<dim>> &meshes,
                               const std::vector<std::size_t> &first_node, std::vector<Terms> &terms)
{
  TieReport         report{tie.name, 0, 0};
  std::vector<bool> tied(meshes[s].n_nodes(), false), inner(meshes[s].facets.size());
  for (const auto &link : find_tied(meshes[s], meshes[m], tie.tolerance))
  {
    tied[link.node] = true;
    Terms &row      = terms[first_node[s] + link.node];
    if (!row.node.empty()) // hangs, or follows another body already
      continue;
    ++report.nodes;
    report.largest_gap = std::max(report.largest_gap, link.gap);
    for (int k = 0; k < link.n_masters; ++k)
      if (link.weight[k] > 0)
      {
        row.node.push_back(static_cast<std::uint32_t>(first_node[m] + link.master[k]));
        row.weight.push_back(link.weight[k]);
      }
  }
  if (report.nodes == 0)
    throw InputError({"", 0, "Interfaces/" + tie.name}, "no surface node of the slave lies on the master",
                     "two bodies that touch, or a greater tolerance");
  for (std::size_t f = 0; f < inner.size(); ++f)
    inner[f] = std::all_of(meshes[s].facets[f].node.begin(), meshes[s].facets[f].node.end(),
                           [&](std::uint32_t a) { return tied[a]; });
  mark_covered(meshes[m], meshes[s], inner, tie.tolerance, covered_[m]);
  for (std::size_t f = 0; f < inner.size(); ++f)
    covered_[s][f] = covered_[s][f] || inner[f];
  ties_.push_back(report);
}

/// Depth first, so that what a slave's masters are is settled before its own row.
template <int dim>
void Constraints<dim>::resolve(std::uint32_t slave, std::vector<Terms> &terms, std::vector<char> &state) const
{
  enum : char
  {
    fresh,
    open,
    settled
  };
  if (terms[slave].node.empty() || state[slave] == settled)
    return;
  if (state[slave] == open)
    throw InputError({"", 0, "Interfaces"}, "nodes of two bodies follow one another",
                     "ties in which no body is both slave and master at one place");
  state[slave] = open;
  std::map<std::uint32_t, double> sum;
  for (std::size_t k = 0; k < terms[slave].node.size(); ++k)
  {
    const std::uint32_t master = terms[slave].node[k];
    resolve(master, terms, state);
    if (terms[master].node.empty())
      sum[master] += terms[slave].weight[k];
    for (std::size_t j = 0; j < terms[master].node.size(); ++j)
      sum[terms[master].node[j]] += terms[slave].weight[k] * terms[master].weight[j];
  }
  terms[slave] = {};
  for (const auto &[node, weight] : sum)
  {
    terms[slave].node.push_back(node);
    terms[slave].weight.push_back(weight);
  }
  state[slave] = settled;
}

template <int dim>
void Constraints<dim>::store(const std::vector<Terms> &given)
{
  std::vector<Terms> terms = given;
  std::vector<char>  state(terms.size(), 0);
  row_.assign(terms.size(), -1);
  first_.assign(1, 0);
  for (std::uint32_t a = 0; a < terms.size(); ++a)
  {
    if (terms[a].node.empty())
      continue;
    resolve(a, terms, state);
    row_[a] = static_cast<std::int64_t>(slaves_.size());
    slaves_.push_back(a);
    master_.insert(master_.end(), terms[a].node.begin(), terms[a].node.end());
    weight_.insert(weight_.end(), terms[a].weight.begin(), terms[a].weight.end());
    first_.push_back(master_.size());
  }
}

template <int dim>
void Constraints<dim>::place(std::vector<BodyMesh<dim>>     &meshes,
                             const std::vector<std::size_t> &first_node) const
{
  const auto at = [&](std::uint32_t node)
  {
    std::size_t m = meshes.size() - 1;
    while (first_node[m] > node)
      --m;
    return std::pair{m, node - first_node[m]};
  };
  for (const std::uint32_t slave : slaves_)
  {
    const auto [s, a] = at(slave);
    for (int i = 0; i < dim; ++i)
    {
      double x = 0;
      for_each_master(slave,
                      [&](std::uint32_t master, double weight)
                      {
                        const auto [m, b] = at(master);
                        x += weight * meshes[m].x[i][b];
                      });
      meshes[s].x[i][a] = x;
    }
  }
}

template <int dim>
void Constraints<dim>::fold_mass(Nodes<dim> &nodes)
{
  if (empty())
    return;
  folded_.resize(nodes.size(), 0.);
  for (const std::uint32_t slave : slaves_)
    for_each_master(slave,
                    [&](std::uint32_t master, double weight)
                    {
                      folded_[master] += weight * nodes.mass[slave];
                      nodes.mass[master] += weight * nodes.mass[slave];
                    });
}

template <int dim>
void Constraints<dim>::add_mass(Nodes<dim> &nodes, std::uint32_t node, double mass)
{
  nodes.mass.at(node) += mass;
  for_each_master(node,
                  [&](std::uint32_t master, double weight)
                  {
                    folded_[master] += weight * mass;
                    nodes.mass[master] += weight * mass;
                  });
}

template <int dim>
void Constraints<dim>::follow(Nodes<dim> &nodes) const
{
  for (const std::uint32_t slave : slaves_)
    for (int i = 0; i < dim; ++i)
    {
      double v = 0;
      for_each_master(slave, [&](std::uint32_t master, double weight) { v += weight * nodes.v[i][master]; });
      nodes.v[i][slave] = v;
    }
}

template class Constraints<1>;
template class Constraints<2>;
template class Constraints<3>;
} // namespace ogive::fem
