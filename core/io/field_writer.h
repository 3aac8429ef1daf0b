// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/sample.h"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace ogive::io
{
namespace hdf5
{
class File;
}

enum class CellType
{
  vertex,
  line,
  quadrilateral,
  hexahedron
};

/// One array of a block, row-major.
struct Field
{
  std::string         name;           ///< no "/"
  int                 components = 1; ///< 1, 3 (vector) or 6 (symmetric tensor, xx yy zz xy yz zx)
  std::vector<double> values;         ///< one row a point or a cell
};

/// A body at one time, as viewers take it.
struct FieldBlock
{
  std::string                name;
  int                        body = -1; ///< its field "body"; -1: the block's place among those written
  std::vector<double>        points; ///< n x 3, m
  CellType                   cell_type = CellType::vertex;
  std::vector<std::uint32_t> connectivity; ///< nodes of each cell, VTK order; empty for vertices
  std::vector<Field>         point_fields, cell_fields;

  std::size_t n_points() const { return points.size() / 3; }
  std::size_t n_cells() const;
};

/// The state of one body, SI units: velocity, displacement, id; density,
/// energy (J/kg), plastic_strain, damage, temperature (K), stress (Pa),
/// von_mises (Pa), pressure (Pa), and the radius of particles. Material fields
/// of a mesh stand at its cells, averaged over a cell's points. Arrays that the
/// sample leaves empty are left out.
FieldBlock make_block(const std::string &name, const Sample &sample);

/// Writes a time series of blocks to results.xdmf and results.h5. Both are
/// complete after every write, so an interrupted run opens as well. Fields are
/// stored in single precision, positions in double. Throws RunError when the
/// disk refuses.
class FieldWriter
{
public:
  /// Begins both files in `directory`, replacing what is there.
  explicit FieldWriter(const std::string &directory);

  /// Goes on with the files in `directory` after their first `n_times` times;
  /// later ones are dropped. Throws InputError if there are fewer.
  static FieldWriter resume(const std::string &directory, std::size_t n_times);

  /// Blocks without points are left out; the others get a field "body", unless
  /// they name it their index in `blocks`. `time` in s.
  void write(double time, std::span<const FieldBlock> blocks);

  /// Times written so far; a checkpoint keeps it for resume().
  std::size_t count() const { return entries_.size(); }

private:
  FieldWriter(const std::string &directory, bool fresh);
  std::string block_entry(hdf5::File &, const std::string &group, const FieldBlock &, std::size_t index);
  std::string topology(hdf5::File &, const std::string &group, const FieldBlock &);
  void        write_xdmf() const;

  struct Connectivity
  {
    std::vector<std::uint32_t> cells;
    std::string                place;
  };

  std::string                         xdmf_, h5_;
  std::vector<std::string>            entries_;      ///< the XDMF text of each time
  std::map<std::string, Connectivity> connectivity_; ///< last written of each block, referred to while it holds
};
} // namespace ogive::io
