// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/elements/b_bar.h"
#include "fem/elements/spectral.h"
#include "fem/integrated_group.h"
#include "fem/integrated_instances.h"

#include <algorithm>

/// The way between the nodes and the packs of elements with several points.
namespace ogive::fem
{
template <class Element>
void IntegratedGroup<Element>::find_rows()
{
  row_.resize(node_.size() / width);
  for (std::size_t k = 0; k < row_.size(); ++k)
  {
    row_[k] = node_[k * width];
    for (std::size_t lane = 1; lane < width; ++lane)
      if (node_[k * width + lane] != node_[k * width] + lane)
        row_[k] = no_row;
  }
}

template <class Element>
void IntegratedGroup<Element>::gather(const std::array<AlignedVector<double>, dim> &field, std::size_t pack,
                                      Field &out) const
{
  for (int a = 0; a < nodes_of; ++a)
  {
    const std::uint32_t *node = &node_[(pack * nodes_of + a) * width];
    const std::uint32_t  row  = row_[pack * nodes_of + a];
    for (int i = 0; i < dim; ++i)
    {
      const double *f = field[i].data();
      if (row != no_row)
        out[a][i] = VDouble(f + row, stdx::element_aligned);
      else
        out[a][i] = VDouble([&](auto lane) { return f[node[lane]]; });
    }
  }
}

/// In the order of packs: the same sums every time.
template <class Element>
void IntegratedGroup<Element>::scatter(std::size_t pack)
{
  const std::size_t lanes = std::min(width, n_ - pack * width);
  for (int a = 0; a < nodes_of; ++a)
  {
    const std::uint32_t *node = &node_[(pack * nodes_of + a) * width];
    const std::uint32_t  row  = row_[pack * nodes_of + a];
    for (int i = 0; i < dim; ++i)
    {
      const double *force = &node_force_[((pack * nodes_of + a) * dim + i) * width];
      double       *sum   = nodal_force_[i].data();
      if (row != no_row)
      {
        double *to = sum + (row - first_node_);
        (VDouble(to, stdx::element_aligned) + load(force)).copy_to(to, stdx::element_aligned);
      }
      else
        for (std::size_t lane = 0; lane < lanes; ++lane)
          sum[node[lane] - first_node_] += force[lane];
    }
  }
}

/// Asks for the state of a pack before it is needed.
template <class Element>
void IntegratedGroup<Element>::fetch(std::size_t pack)
{
  const auto ask = [](const AlignedVector<double> &a, std::size_t first, std::size_t n) {
    for (std::size_t k = 0; k < n; k += 64 / sizeof(double))
      __builtin_prefetch(&a[first + k]);
  };
  const std::size_t first = at(pack, 0), n = at(pack + 1, 0) - first;
  points_.for_each_array([&](const char *, const AlignedVector<double> &a) { ask(a, first, n); });
  for (const auto *a : {&point_mass_, &viscous_pressure_, &half_work_, &half_viscous_, &viscous_heat_})
    ask(*a, first, n);
  ask(node_mass_, pack * nodes_of * width, nodes_of * width);
  ask(node_force_, pack * nodes_of * dim * width, nodes_of * dim * width);
}

OGIVE_INSTANTIATE_INTEGRATED(template class, IntegratedGroup)
} // namespace ogive::fem
