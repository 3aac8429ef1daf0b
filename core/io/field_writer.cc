// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/field_writer.h"

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/hdf5_file.h"
#include "core/io/number_text.h"

#include <array>
#include <cstdio>

namespace ogive::io
{
namespace
{
const std::string entry_name = "/xdmf"; ///< in each time's group: its XDMF text

std::string group_of(std::size_t time)
{
  std::array<char, 32> name;
  std::snprintf(name.data(), name.size(), "/%06zu", time);
  return name.data();
}

std::string escaped(const std::string &text)
{
  std::string out;
  for (const char c : text)
    switch (c)
      {
        case '&':
          out += "&amp;";
          break;
        case '<':
          out += "&lt;";
          break;
        case '>':
          out += "&gt;";
          break;
        case '"':
          out += "&quot;";
          break;
        default:
          out += c;
      }
  return out;
}

/// A link in an HDF5 file cannot hold a slash, nor be "." alone; a colon would
/// end the file's name in XDMF.
std::string link_name(std::string name)
{
  for (char &c : name)
    if (c == '/' || c == ':' || c == '.')
      c = '_';
  return name;
}

std::string shape(std::size_t rows, std::size_t columns)
{
  return columns == 1 ? std::to_string(rows) : std::to_string(rows) + " " + std::to_string(columns);
}

std::string data_item(const std::string &type, int bytes, const std::string &dimensions,
                      const std::string &place)
{
  return "<DataItem Format=\"HDF\" NumberType=\"" + type + "\" Precision=\"" + std::to_string(bytes) +
         "\" Dimensions=\"" + dimensions + "\">results.h5:" + escaped(place) + "</DataItem>";
}

struct CellName
{
  const char *xdmf;
  int         nodes;
};

CellName name_of(CellType type)
{
  switch (type)
    {
      case CellType::vertex:
        return {"Polyvertex", 1};
      case CellType::line:
        return {"Polyline", 2};
      case CellType::quadrilateral:
        return {"Quadrilateral", 4};
      case CellType::hexahedron:
        return {"Hexahedron", 8};
    }
  throw std::logic_error("no such cell type");
}

/// All nine components, row by row: readers disagree on the order of six.
std::vector<double> full_tensors(const std::vector<double> &values)
{
  constexpr std::array<std::size_t, 9> from{0, 3, 5, 3, 1, 4, 5, 4, 2};
  std::vector<double>                  full(values.size() / 6 * 9);
  for (std::size_t i = 0; i < full.size(); ++i)
    full[i] = values[i / 9 * 6 + from[i % 9]];
  return full;
}

std::string field_entry(hdf5::File &file, const std::string &group, const Field &field, bool at_cells,
                        std::size_t rows)
{
  const auto columns = static_cast<std::size_t>(field.components);
  require(columns == 1 || columns == 3 || columns == 6, "a field has 1, 3 or 6 components");
  require(field.values.size() == rows * columns, "a field has one row a point or cell");

  const std::string place  = group + "/" + link_name(field.name);
  const std::size_t stored = columns == 6 ? 9 : columns;
  file.write(place, columns == 6 ? full_tensors(field.values) : field.values, stored, true);
  return "<Attribute Name=\"" + escaped(field.name) + "\" AttributeType=\"" +
         (columns == 1 ? "Scalar" : columns == 3 ? "Vector" : "Tensor") + "\" Center=\"" +
         (at_cells ? "Cell" : "Node") + "\">" + data_item("Float", 4, shape(rows, stored), place) +
         "</Attribute>\n";
}
} // namespace

FieldWriter::FieldWriter(const std::string &directory, bool fresh)
  : xdmf_(directory + "/results.xdmf")
  , h5_(directory + "/results.h5")
{
  if (!fresh)
    return;
  hdf5::File file(h5_, hdf5::File::Mode::create);
  if (!file.open())
    throw RunError(h5_ + ": cannot be written; is the directory writable?");
  file.close();
  write_xdmf();
}

FieldWriter::FieldWriter(const std::string &directory)
  : FieldWriter(directory, true)
{}

FieldWriter FieldWriter::resume(const std::string &directory, std::size_t n_times)
{
  FieldWriter writer(directory, false);
  hdf5::File  file(writer.h5_, hdf5::File::Mode::append);
  if (!file.open())
    throw InputError({.file = writer.h5_, .line = 0, .entry = {}}, "missing, cut short or damaged",
                     "the results of the run to restart");
  for (std::size_t i = 0; i < n_times; ++i)
    {
      std::string entry;
      if (!file.read_text(group_of(i) + entry_name, entry))
        throw InputError({.file = writer.h5_, .line = 0, .entry = {}},
                         "holds " + std::to_string(i) + " times",
                         "the " + std::to_string(n_times) + " that the checkpoint counts");
      writer.entries_.push_back(std::move(entry));
    }
  // The text comes first: it must never name what the data file has lost.
  writer.write_xdmf();
  for (std::size_t i = n_times; file.contains(group_of(i)); ++i)
    file.remove(group_of(i));
  file.close();
  return writer;
}

std::string FieldWriter::topology(hdf5::File &file, const std::string &group, const FieldBlock &block)
{
  const CellName    cell = name_of(block.cell_type);
  const std::string head = std::string("<Topology TopologyType=\"") + cell.xdmf + "\" NumberOfElements=\"" +
                           std::to_string(block.n_cells()) + "\"" +
                           (cell.nodes <= 2 ? " NodesPerElement=\"" + std::to_string(cell.nodes) + "\"" : "") +
                           ">";
  Connectivity &last = connectivity_[block.name];
  std::vector<std::uint32_t> own;
  if (block.cell_type == CellType::vertex)
    for (std::uint32_t i = 0; i < block.n_points(); ++i)
      own.push_back(i);
  const std::vector<std::uint32_t> &cells = block.cell_type == CellType::vertex ? own : block.connectivity;
  require(cells.size() == block.n_cells() * static_cast<std::size_t>(cell.nodes),
          "the connectivity fills whole cells");
  if (last.place.empty() || last.cells != cells)
    {
      last = {cells, group + "/cells"};
      file.write(last.place, cells, static_cast<std::size_t>(cell.nodes));
    }
  return head + data_item("UInt", 4, shape(block.n_cells(), static_cast<std::size_t>(cell.nodes)), last.place) +
         "</Topology>\n";
}

std::string FieldWriter::block_entry(hdf5::File &file, const std::string &group, const FieldBlock &block,
                                     std::size_t index)
{
  file.write(group + "/points", block.points, 3);
  std::string entry = "<Grid Name=\"" + escaped(block.name) + "\" GridType=\"Uniform\">\n";
  entry += topology(file, group, block);
  entry += "<Geometry GeometryType=\"XYZ\">" +
           data_item("Float", 8, shape(block.n_points(), 3), group + "/points") + "</Geometry>\n";
  // ParaView's default reader drops the names of blocks; by this field they can be told apart.
  const Field body{"body", 1, std::vector<double>(block.n_points(), static_cast<double>(index))};
  entry += field_entry(file, group, body, false, block.n_points());
  for (const Field &field : block.point_fields)
    entry += field_entry(file, group, field, false, block.n_points());
  for (const Field &field : block.cell_fields)
    entry += field_entry(file, group, field, true, block.n_cells());
  return entry + "</Grid>\n";
}

void FieldWriter::write(double time, std::span<const FieldBlock> blocks)
{
  hdf5::File file(h5_, hdf5::File::Mode::append);
  if (!file.open())
    throw RunError(h5_ + ": cannot be written; was it moved or damaged?");
  const std::string group = group_of(count());
  std::string       entry = "<Grid Name=\"" + group.substr(1) +
                      "\" GridType=\"Collection\" CollectionType=\"Spatial\">\n<Time Value=\"" +
                      number_text(time) + "\"/>\n";
  for (std::size_t i = 0; i < blocks.size(); ++i)
    if (blocks[i].n_points() > 0)
      entry += block_entry(file, group + "/" + link_name(blocks[i].name), blocks[i],
                           blocks[i].body < 0 ? i : static_cast<std::size_t>(blocks[i].body));
  entry += "</Grid>\n";
  file.write_text(group + entry_name, entry);
  file.close();

  entries_.push_back(std::move(entry));
  write_xdmf();
}

void FieldWriter::write_xdmf() const
{
  std::string text = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n<Domain>\n"
                     "<Grid Name=\"results\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (const std::string &entry : entries_)
    text += entry;
  write_whole(xdmf_, text + "</Grid>\n</Domain>\n</Xdmf>\n");
}
} // namespace ogive::io
