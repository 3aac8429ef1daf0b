// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "fem/element_partition.h"

#include <deal.II/distributed/tria.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>

/// p4est shares out elements: each is the root of a tree that is never refined.
namespace ogive::fem
{
namespace
{
/// The edges of a plane mesh must point one way from both sides; which corner of an
/// element comes first does not matter here.
template <int dim>
void create(dealii::parallel::distributed::Triangulation<dim> &tria, const ElementCloud<dim> &all)
{
  // VTK order to that of deal.II
  constexpr int                      order[8] = {0, 1, 3, 2, 4, 5, 7, 6};
  std::vector<dealii::Point<dim>>    vertices(all.vertex.size());
  std::vector<dealii::CellData<dim>> cells(all.cell.size());
  for (std::size_t v = 0; v < vertices.size(); ++v)
    for (int i = 0; i < dim; ++i)
      vertices[v][i] = all.vertex[v][i];
  for (std::size_t e = 0; e < cells.size(); ++e)
    for (int a = 0; a < ElementCloud<dim>::corners; ++a)
      cells[e].vertices[a] = all.cell[e][order[a]];
  dealii::SubCellData none;
  dealii::GridTools::delete_unused_vertices(vertices, cells, none);
  if (dim == 2)
    dealii::GridTools::consistently_order_cells(cells);
  tria.create_triangulation(vertices, cells, none);
}
} // namespace

template <int dim>
std::vector<int> partition_by_forest(const Ranks &ranks, const ElementCloud<dim> &all)
{
  if constexpr (dim == 1)
    throw InputError({"", 0, "Parallel/partition"}, "p4est has no lines", "rcb");
  else
  {
    dealii::parallel::distributed::Triangulation<dim> tria(
        *static_cast<const MPI_Comm *>(ranks.communicator()), dealii::Triangulation<dim>::none,
        dealii::parallel::distributed::Triangulation<dim>::no_automatic_repartitioning);
    create(tria, all);
    const double most = *std::max_element(all.work.begin(), all.work.end());
    tria.signals.weight.connect(
        [&](const auto &cell, const auto) -> unsigned int
        {
          return std::max(1u, static_cast<unsigned int>(
                                  std::lround(1e4 * all.work[cell->id().get_coarse_cell_id()] / most)));
        });
    tria.repartition();
    std::vector<int>           rank(all.work.size(), 0);
    std::vector<std::uint32_t> own;
    for (const auto &cell : tria.active_cell_iterators())
      if (cell->is_locally_owned())
        own.push_back(static_cast<std::uint32_t>(cell->id().get_coarse_cell_id()));
    std::vector<std::size_t> first;
    const auto               each = ranks.gather(own, &first);
    require(each.size() == rank.size(), "the forest shares out each element once");
    for (int r = 0; r < ranks.size(); ++r)
      for (std::size_t k = first[r]; k < first[r + 1]; ++k)
        rank[each[k]] = r;
    return rank;
  }
}

template std::vector<int> partition_by_forest(const Ranks &, const ElementCloud<1> &);
template std::vector<int> partition_by_forest(const Ranks &, const ElementCloud<2> &);
template std::vector<int> partition_by_forest(const Ranks &, const ElementCloud<3> &);
} // namespace ogive::fem
