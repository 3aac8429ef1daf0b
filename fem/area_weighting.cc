// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/elements/quad4_area_weighted.h"
#include "fem/one_point_group.h"

#include <algorithm>

namespace ogive::fem
{
/// Forces of the section, taken corner by corner, become ring forces that move
/// the ring masses alike: times ring mass over section mass of the node. They
/// depend on the whole ring of elements about a node, hence a pass of their own.
template <>
void OnePointGroup<Quad4AreaWeighted>::weigh(const Nodes<2> &nodes)
{
  const std::size_t packs = padded_n_ / width, count = nodal_force_[0].size();
  const auto        add_up = [&](std::vector<double> &mass) { // over the ranks
    double *const sums[] = {mass.data()};
    if (shared_)
      shared_->sum(sums, first_node_, first_node_ + count);
  };
  if (ring_mass_.empty())
  {
    ring_mass_.assign(count, 0.);
    for (std::size_t e = 0; e < n_; ++e)
      for (int a = 0; a < corners; ++a)
        ring_mass_[node_[slot(e, a, corners)] - first_node_] += corner_mass_[slot(e, a, corners)];
    add_up(ring_mass_);
  }
  section_mass_.assign(count, 0.);
  for (std::size_t pack = 0; pack < packs; ++pack)
  {
    Corners x;
    gather(nodes.x, pack, x);
    Geometry<Quad4, VDouble> flat;
    Quad4::gradient(x, flat);
    const VDouble     quarter = .25 * load(&points_.density[pack * width]) * flat.volume;
    const std::size_t lanes   = std::min(width, n_ - pack * width);
    for (int a = 0; a < corners; ++a)
      for (std::size_t lane = 0; lane < lanes; ++lane)
        section_mass_[node_[(pack * corners + a) * width + lane] - first_node_] += quarter[lane];
  }
  add_up(section_mass_);
  for (std::size_t pack = 0; pack < packs; ++pack)
  {
    Corners v;
    gather(nodes.v, pack, v);
    VDouble power(0.);
    double *f = &corner_force_[pack * corners * dim * width];
    for (int a = 0; a < corners; ++a)
    {
      const std::uint32_t *node = &node_[(pack * corners + a) * width];
      const VDouble        ratio(
        [&](auto lane) { return ring_mass_[node[lane] - first_node_] / section_mass_[node[lane] - first_node_]; });
      for (int i = 0; i < dim; ++i, f += width)
      {
        const VDouble force = load(f) * ratio;
        store(force, f);
        power -= .5 * force * v[a][i];
      }
    }
    store(power, &half_power_[pack * width]);
  }
  scatter(0, packs, corner_force_.data());
}
} // namespace ogive::fem
