// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/field_writer.h"

#include "core/base/error.h"
#include "core/base/tensor.h"

namespace ogive::io
{
namespace
{
template <std::size_t m>
std::vector<double> interleave(const std::array<std::vector<double>, m> &columns)
{
  const std::size_t   n = columns[0].size();
  std::vector<double> rows(n * m);
  for (std::size_t c = 0; c < m; ++c)
    for (std::size_t i = 0; i < n; ++i)
      rows[i * m + c] = columns[c].empty() ? 0 : columns[c].at(i);
  return rows;
}

/// Means over the `rows.size()/(n*m)` points of each of n cells.
std::vector<double> per_cell(std::vector<double> rows, std::size_t n, std::size_t m)
{
  if (n == 0 || rows.size() == n * m)
    return rows;
  require(rows.size() % (n * m) == 0, "a mesh needs the same number of points in each cell");
  const std::size_t   points = rows.size() / (n * m);
  std::vector<double> mean(n * m, 0.);
  for (std::size_t i = 0; i < rows.size(); ++i)
    mean[i / (points * m) * m + i % m] += rows[i] / static_cast<double>(points);
  return mean;
}

CellType cell_type_of(const Sample &sample)
{
  if (!sample.is_mesh)
    return CellType::vertex;
  switch (sample.nodes_per_cell)
    {
      case 2:
        return CellType::line;
      case 4:
        return CellType::quadrilateral;
      case 8:
        return CellType::hexahedron;
      default:
        throw std::logic_error("cells have 2, 4 or 8 nodes");
    }
}
} // namespace

std::size_t FieldBlock::n_cells() const
{
  switch (cell_type)
    {
      case CellType::vertex:
        return n_points();
      case CellType::line:
        return connectivity.size() / 2;
      case CellType::quadrilateral:
        return connectivity.size() / 4;
      case CellType::hexahedron:
        return connectivity.size() / 8;
    }
  return 0;
}

FieldBlock make_block(const std::string &name, const Sample &sample)
{
  FieldBlock block;
  block.name      = name;
  block.points    = interleave(sample.x);
  block.cell_type = cell_type_of(sample);
  if (sample.is_mesh)
    block.connectivity = sample.cells;

  const auto at_points = [&](const char *field, int components, std::vector<double> values) {
    if (!values.empty())
      block.point_fields.push_back({field, components, std::move(values)});
  };
  at_points("velocity", 3, interleave(sample.v));
  if (sample.x0[0].size() == sample.x[0].size())
    {
      std::vector<double> displacement = interleave(sample.x0);
      for (std::size_t i = 0; i < displacement.size(); ++i)
        displacement[i] = block.points[i] - displacement[i];
      at_points("displacement", 3, std::move(displacement));
    }
  at_points("id", 1, {sample.id.begin(), sample.id.end()});
  if (!sample.is_mesh)
    at_points("radius", 1, sample.radius);

  std::vector<Field> &material = sample.is_mesh ? block.cell_fields : block.point_fields;
  const std::size_t   n        = block.n_cells();
  const auto          add      = [&](const char *field, int components, std::vector<double> values) {
    if (!values.empty())
      material.push_back({field, components, per_cell(std::move(values), n, components)});
  };
  add("density", 1, sample.density);
  add("energy", 1, sample.energy);
  add("plastic_strain", 1, sample.plastic_strain);
  add("damage", 1, sample.damage);
  add("temperature", 1, sample.temperature);
  add("stress", 6, interleave(sample.sigma));

  const std::size_t   n_stress = sample.sigma[0].size();
  std::vector<double> mises(n_stress), pressure(n_stress);
  for (std::size_t i = 0; i < n_stress; ++i)
    {
      const auto &s = sample.sigma;
      const Sym3  sigma{s[0][i], s[1].at(i), s[2].at(i), s[3].at(i), s[4].at(i), s[5].at(i)};
      mises[i]    = von_mises(sigma.deviator());
      pressure[i] = -sigma.trace() / 3;
    }
  add("von_mises", 1, std::move(mises));
  add("pressure", 1, std::move(pressure));
  return block;
}
} // namespace ogive::io
