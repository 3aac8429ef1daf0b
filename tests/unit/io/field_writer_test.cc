// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/io/field_writer.h"

#include "core/base/error.h"
#include "core/io/hdf5_file.h"
#include "tests/unit/io/scratch.h"

#include <cmath>

namespace
{
using namespace ogive;
using namespace ogive::io;
using ogive::test::bytes_of;
using ogive::test::expect_parts;
using ogive::test::message_of;
using ogive::test::write_bytes;

using Fields = ogive::test::Scratch;

std::vector<double> ramp(std::size_t n, double first, double step)
{
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i)
    values[i] = first + step * static_cast<double>(i);
  return values;
}

/// Two hexahedra on 12 nodes, `points` material points in each.
Sample mesh(std::size_t points)
{
  Sample s;
  s.is_mesh        = true;
  s.nodes_per_cell = 8;
  s.cells          = {0, 1, 4, 3, 6, 7, 10, 9, 1, 2, 5, 4, 7, 8, 11, 10};
  for (std::size_t d = 0; d < 3; ++d)
    {
      s.x[d]  = ramp(12, .1 * static_cast<double>(d), .01);
      s.x0[d] = ramp(12, 0, .01);
      s.v[d]  = ramp(12, -7, 1 + static_cast<double>(d));
    }
  s.mass    = ramp(12, 1, 0);
  s.density = ramp(2 * points, 7850, 1);
  for (std::size_t c = 0; c < 6; ++c)
    s.sigma[c] = ramp(2 * points, 1e6 * static_cast<double>(c + 1), 2e6);
  return s;
}

Sample particles(std::size_t n)
{
  Sample s;
  for (std::size_t d = 0; d < 3; ++d)
    s.x[d] = s.x0[d] = s.v[d] = ramp(n, .001, .003);
  s.radius         = ramp(n, .0005, 0);
  s.plastic_strain = ramp(n, 0, .1);
  return s;
}

const Field &field(const std::vector<Field> &fields, const std::string &name)
{
  for (const Field &f : fields)
    if (f.name == name)
      return f;
  throw std::logic_error("no field " + name);
}

std::vector<double> read(const std::string &path, const std::string &name)
{
  const hdf5::File    file(path, hdf5::File::Mode::read);
  std::vector<double> values;
  EXPECT_TRUE(file.read(name, values)) << name;
  return values;
}

std::size_t count(const std::string &text, const std::string &part)
{
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++n;
  return n;
}

TEST_F(Fields, AMeshCarriesMaterialInItsCells)
{
  const FieldBlock b = make_block("plate", mesh(1));
  EXPECT_EQ(b.cell_type, CellType::hexahedron);
  EXPECT_EQ(b.n_points(), 12u);
  EXPECT_EQ(b.n_cells(), 2u);
  EXPECT_DOUBLE_EQ(field(b.point_fields, "displacement").values[3 * 4 + 2], .2);
  EXPECT_DOUBLE_EQ(field(b.point_fields, "velocity").values[3 * 4 + 1], -7 + 4 * 2);
  EXPECT_EQ(field(b.cell_fields, "density").values, (std::vector<double>{7850, 7851}));
  // sigma of the first cell: 1..6 MPa in the order xx yy zz xy yz zx.
  EXPECT_DOUBLE_EQ(field(b.cell_fields, "pressure").values[0], -2e6);
  const double deviatoric = 1 + 0 + 1 + 2 * (16 + 25 + 36); // MPa^2
  EXPECT_DOUBLE_EQ(field(b.cell_fields, "von_mises").values[0], 1e6 * std::sqrt(1.5 * deviatoric));
  EXPECT_THROW(field(b.cell_fields, "temperature"), std::logic_error);
}

TEST_F(Fields, SeveralPointsOfACellAreAveraged)
{
  // Points 0..3 belong to the first cell: the mean of 7850..7853.
  const FieldBlock b = make_block("plate", mesh(4));
  EXPECT_EQ(field(b.cell_fields, "density").values, (std::vector<double>{7851.5, 7855.5}));
  EXPECT_DOUBLE_EQ(field(b.cell_fields, "stress").values[6 + 3], 4e6 + 2e6 * 5.5);
}

TEST_F(Fields, ParticlesCarryAllAtTheirPoints)
{
  const FieldBlock b = make_block("core", particles(5));
  EXPECT_EQ(b.cell_type, CellType::vertex);
  EXPECT_EQ(b.n_cells(), 5u);
  EXPECT_TRUE(b.cell_fields.empty());
  EXPECT_DOUBLE_EQ(field(b.point_fields, "plastic_strain").values[3], .3);
  EXPECT_DOUBLE_EQ(field(b.point_fields, "radius").values[3], .0005);
}

TEST_F(Fields, EveryWriteLeavesBothFilesWhole)
{
  FieldWriter       writer(directory());
  const std::vector blocks{make_block("a<b>/c", mesh(1)), make_block("core", particles(5)), make_block("none", particles(0))};
  for (std::size_t n = 1; n <= 3; ++n)
    {
      writer.write(1e-6 * static_cast<double>(n), blocks);
      const std::string text = bytes_of(in("results.xdmf"));
      EXPECT_EQ(count(text, "<Time Value="), n);
      EXPECT_EQ(count(text, "CollectionType=\"Spatial\""), n);
      EXPECT_EQ(count(text, "<Grid "), count(text, "</Grid>"));
      EXPECT_EQ(count(text, "GridType=\"Uniform\""), 2 * n);
      // Each dataset that the text names is in the file.
      const hdf5::File file(in("results.h5"), hdf5::File::Mode::read);
      ASSERT_TRUE(file.open());
      for (std::size_t at = text.find("results.h5:"); at != std::string::npos; at = text.find("results.h5:", at + 1))
        {
          const std::size_t begin = text.find(':', at) + 1;
          std::string       place = text.substr(begin, text.find('<', begin) - begin);
          for (std::size_t e; (e = place.find("&lt;")) != std::string::npos;)
            place.replace(e, 4, "<");
          for (std::size_t e; (e = place.find("&gt;")) != std::string::npos;)
            place.replace(e, 4, ">");
          EXPECT_TRUE(file.contains(place)) << place;
        }
    }
  EXPECT_EQ(writer.count(), 3u);
  // Positions in double, and the stress as nine components, row by row.
  EXPECT_EQ(read(in("results.h5"), "/000001/core/points")[3], .001 + .003);
  EXPECT_EQ(read(in("results.h5"), "/000001/core/body"), std::vector<double>(5, 1.));
  EXPECT_EQ(read(in("results.h5"), "/000001/a<b>_c/stress"),
            (std::vector<double>{1e6, 4e6, 6e6, 4e6, 2e6, 5e6, 6e6, 5e6, 3e6, //
                                 3e6, 6e6, 8e6, 6e6, 4e6, 7e6, 8e6, 7e6, 5e6}));
}

TEST_F(Fields, AnUnchangedConnectivityIsStoredOnce)
{
  FieldWriter writer(directory());
  Sample      s = mesh(1);
  for (int n = 0; n < 3; ++n)
    {
      if (n == 2)
        s.cells[0] = 2;
      writer.write(n, std::vector{make_block("plate", s)});
    }
  const hdf5::File file(in("results.h5"), hdf5::File::Mode::read);
  EXPECT_TRUE(file.contains("/000000/plate/cells"));
  EXPECT_FALSE(file.contains("/000001/plate/cells"));
  EXPECT_TRUE(file.contains("/000002/plate/cells"));
  EXPECT_EQ(count(bytes_of(in("results.xdmf")), "/000000/plate/cells"), 2u);
}

TEST_F(Fields, GoesOnAfterTheCheckpoint)
{
  const auto block = [](double time) {
    Sample s   = mesh(1);
    s.density  = {time, -time};
    return std::vector{make_block("plate", s), make_block("core", particles(4))};
  };
  {
    FieldWriter writer(directory());
    for (int n = 0; n < 5; ++n)
      writer.write(1e-6 * n, block(n));
  }
  FieldWriter writer = FieldWriter::resume(directory(), 2);
  EXPECT_EQ(writer.count(), 2u);
  EXPECT_EQ(count(bytes_of(in("results.xdmf")), "<Time Value="), 2u);
  EXPECT_FALSE(hdf5::File(in("results.h5"), hdf5::File::Mode::read).contains("/000002"));
  writer.write(2e-6, block(20));
  EXPECT_EQ(count(bytes_of(in("results.xdmf")), "<Time Value="), 3u);
  EXPECT_EQ(read(in("results.h5"), "/000001/plate/density"), (std::vector<double>{1, -1}));
  EXPECT_EQ(read(in("results.h5"), "/000002/plate/density"), (std::vector<double>{20, -20}));
}

TEST_F(Fields, RefusesToGoOnWithTooLittle)
{
  {
    FieldWriter writer(directory());
    writer.write(0, std::vector{make_block("core", particles(4))});
  }
  expect_parts(message_of<InputError>([&] { FieldWriter::resume(directory(), 2); }), {"results.h5", "1 times", "expected the 2"});
  write_bytes(in("results.h5"), bytes_of(in("results.h5")).substr(0, 1000));
  expect_parts(message_of<InputError>([&] { FieldWriter::resume(directory(), 1); }), {"results.h5", "cut short"});
}
} // namespace
