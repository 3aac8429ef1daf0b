// SPDX-License-Identifier: LGPL-2.1-or-later
// Every way in which a mesh file is refused, in one table: what is changed in a
// sound file, and what the message must name.
#include "core/base/error.h"
#include "tests/unit/fem/support.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

using namespace ogive;
using namespace ogive::fem;
using namespace ogive::fem::test;

namespace
{
struct Wrong
{
  const char *name, *file; ///< a sample
  std::string from, to;    ///< the change; none if empty
  const char *part;
  int         dim;
  int         line; ///< of the file; 0: the message is about the scene
  const char *says[3];
};

const Wrong table[] = {
  // gmsh
  {"no gmsh file", "plate-41.msh", "$MeshFormat\n4.1", "$Mesh\n4.1", "", 2, 1, {"does not begin", "$MeshFormat"}},
  {"old format", "plate-22.msh", "2.2 0 8", "1.0 0 8", "", 2, 2, {"version 1.0", "4.1", "msh41"}},
  {"binary", "plate-41.msh", "4.1 0 8", "4.1 1 8", "", 2, 2, {"binary", "Mesh.Binary = 0"}},
  {"no quotes", "plate-41.msh", "\"hole\"", "hole", "", 2, 6, {"quotes"}},
  {"no number", "plate-22.msh", "1 5 0 0", "1 ten 0 0", "", 2, 13, {"\"ten\"", "number"}},
  {"node twice", "plate-22.msh", "\n2 3.53", "\n1 3.53", "", 2, 14, {"second node 1"}},
  {"node missing", "plate-22.msh", "1 1 2 1 1 1 7", "1 1 2 1 1 1 999999", "", 2, 641, {"element 1", "node 999999"}},
  {"too few nodes said", "plate-22.msh", "$Nodes\n625", "$Nodes\n624", "", 2, 637, {"longer", "$EndNodes"}},
  {"too many nodes said", "plate-22.msh", "$Nodes\n625", "$Nodes\n626", "", 2, 638, {"$EndNodes", "whole number"}},
  {"cut off", "plate-22.msh", "$EndElements", "", "", 2, 1265, {"ends within", "$Elements"}},
  {"triangles", "plate-22.msh", "\n100 3 2 4 1 ", "\n100 2 2 4 1 ", "", 2, 0, {"1 triangles", "RecombineAll"}},
  {"second order", "plate-22.msh", "\n100 3 2 4 1 ", "\n100 10 2 4 1 ", "", 2, 0, {"1 elements of second order", "ElementOrder"}},
  {"unknown kind", "plate-22.msh", "\n100 3 2 4 1 ", "\n100 93 2 4 1 ", "", 2, 0, {"unknown"}},
  {"no such part", "target.msh", "", "", "steel", 3, 0, {"\"steel\"", "\"copper-ofhc\", \"steel-4340\"", "hexahedra"}},
  {"part of surfaces", "target.msh", "", "", "front", 3, 0, {"\"front\"", "\"copper-ofhc\""}},
  {"wrong dimension", "plate-41.msh", "", "", "", 3, 0, {"no hexahedra", "576 quadrilaterals"}},
  {"no plane", "target.msh", "", "", "", 2, 0, {"no plane mesh", "z"}},
  {"one cell turned", "plate-22.msh", "\n49 3 2 4 1 1 29 120 7", "\n49 3 2 4 1 1 7 120 29", "", 2, 0, {"element 49", "1 of 576"}},
  {"face called all", "plate-41.msh", "\"hole\"", "\"all\"", "", 2, 0, {"\"all\"", "meaning"}},
  {"face called rest", "plate-41.msh", "\"hole\"", "\"rest\"", "", 2, 0, {"\"rest\""}},
  {"face called symmetry", "plate-41.msh", "\"hole\"", "\"symmetry-x\"", "", 2, 0, {"\"symmetry-x\"", "symmetry planes"}},
  // Abaqus
  {"element without type", "bar.inp", "*ELEMENT, TYPE=C3D8R, ELSET=handle", "*ELEMENT, ELSET=handle", "", 3, 26, {"type", "C3D8R"}},
  {"tetrahedra", "bar.inp", "*ELEMENT, TYPE=C3D8R, ELSET=tip", "*ELEMENT, TYPE=C3D4", "", 3, 0, {"2 tetrahedra", "hexahedra"}},
  {"Abaqus second order", "bar.inp", "*ELEMENT, TYPE=C3D8R, ELSET=tip", "*ELEMENT, TYPE=C3D20R", "", 3, 0, {"2 elements of second order"}},
  {"too few corners", "bar.inp", "101,  1,  2,  3,  4,  5,  6,  7,  8", "101,  1,  2,  3,  4,  5,  6,  7", "", 3, 27, {"C3D8R", "7 nodes", "8"}},
  {"Abaqus node missing", "bar.inp", "101,  1,", "101,  77,", "", 3, 27, {"element 101", "node 77"}},
  {"element twice", "bar.inp", "102,", "101,", "", 3, 28, {"second element 101"}},
  {"Abaqus node twice", "bar.inp", "\n 2, 0", "\n 1, 0", "", 3, 6, {"second node 1"}},
  {"no such set", "bar.inp", "last, S2", "lost, S2", "", 3, 41, {"\"lost\"", "above"}},
  {"no such element", "bar.inp", "ELSET=last\n104", "ELSET=last\n109", "", 3, 33, {"no element 109", "above"}},
  {"no such face", "bar.inp", "last, S2", "last, S7", "", 3, 41, {"\"S7\"", "S1 to S6"}},
  {"set without name", "bar.inp", "*ELSET, ELSET=last", "*ELSET", "", 3, 32, {"no name", "ELSET="}},
  {"surface without name", "bar.inp", "NAME=grip, ", "", "", 3, 38, {"no name", "NAME="}},
  {"bad generation", "bar.inp", "101, 104, 1", "104, 101, 1", "", 3, 35, {"first, last and step"}},
  {"two parts", "bar.inp", "*ELSET, ELSET=last", "*PART, NAME=a\n*PART, NAME=b\n*ELSET, ELSET=last", "", 3, 33, {"second part", "without parts"}},
  {"moved instance", "bar.inp", "*ELSET, ELSET=last", "*INSTANCE, NAME=a, PART=b\n1, 0, 0\n*ELSET, ELSET=last", "", 3, 33, {"instance is moved"}},
  {"included file", "bar.inp", "*ELSET, ELSET=last", "*INCLUDE, INPUT=more.inp\n*ELSET, ELSET=last", "", 3, 32, {"*INCLUDE"}},
  {"collapsed cell", "bar.inp", "101,  1,  2,", "101,  2,  2,", "", 3, 0, {"element 101", "twice"}},
  {"three at a face", "bar.inp", "*ELSET, ELSET=last", "*NODE\n 30, 1.5, 0, 0\n 31, 1.5, 1, 0\n 32, 1.5, 1, 1\n 33, 1.5, 0, 1\n"
   "*ELEMENT, TYPE=C3D8\n105, 5, 6, 7, 8, 30, 31, 32, 33\n*ELSET, ELSET=last", "", 3, 0, {"101, 102 and 105", "share one face"}},
  {"folded cell", "bar.inp", "\n 7, 1, 1, 1", "\n 7, 1, -.5, -.5", "", 3, 0, {"element 101 of the mesh file", "folded"}},
  {"no nodes", "bar.inp", "*NODE", "*NODES", "", 3, 27, {"node 1 ", "not there"}},
};

std::string refusal(const Wrong &w, std::string &file, int &line)
{
  std::ifstream in(std::string(OGIVE_SOURCE_DIR) + "/meshes/" + w.file);
  std::string   text{std::istreambuf_iterator<char>(in), {}};
  if (!w.from.empty())
  {
    const auto at = text.find(w.from);
    if (at == std::string::npos)
      return "the sample does not hold what is to be changed";
    text.replace(at, w.from.size(), w.to);
  }
  const auto path = std::filesystem::temp_directory_path() /
                    ("ogive-wrong-" + std::to_string(::getpid()) + std::filesystem::path(w.file).extension().string());
  std::ofstream(path) << text;
  input::Body body     = box(Vec3::Zero(), Vec3::Zero(), 1e-3);
  body.shape.kind      = input::ShapeKind::mesh;
  body.shape.mesh_file = path;
  body.shape.mesh_part = w.part;
  input::Scene scene;
  scene.dimension = w.dim == 3 ? input::Dimension::three_d : input::Dimension::plane_strain;
  std::string message;
  try
  {
    if (w.dim == 3)
      make_mesh<3>(body, scene, 0, make(copper()));
    else
      make_mesh<2>(body, scene, 0, make(copper()));
  }
  catch (const InputError &e)
  {
    message = e.what();
    file    = e.where().file;
    line    = e.where().line;
  }
  std::filesystem::remove(path);
  return message;
}
} // namespace

TEST(MeshErrors, EachIsNamed)
{
  for (const Wrong &w : table)
  {
    std::string       file;
    int               line    = 0;
    const std::string message = refusal(w, file, line);
    EXPECT_FALSE(message.empty()) << w.name;
    EXPECT_EQ(line, w.line) << w.name << ": " << message;
    EXPECT_EQ(file.empty(), w.line == 0) << w.name << ": " << message;
    for (const char *word : w.says)
    {
      if (word)
      {
        EXPECT_NE(message.find(word), std::string::npos) << w.name << ": no " << word << " in: " << message;
      }
    }
  }
}

TEST(MeshErrors, OtherFormats)
{
  for (const char *name : {"no-such-mesh.msh", "ogive-mesh", "ogive-mesh.xyz", "ogive-mesh.vtk"})
  {
    const auto path = std::filesystem::temp_directory_path() / name;
    if (std::string(name) != "no-such-mesh.msh")
      std::ofstream(path) << "nothing\n";
    input::Body body     = box(Vec3::Zero(), Vec3::Zero(), 1e-3);
    body.shape.kind      = input::ShapeKind::mesh;
    body.shape.mesh_file = path;
    input::Scene scene;
    EXPECT_THROW(make_mesh<3>(body, scene, 0, make(copper())), InputError) << name;
    std::filesystem::remove(path);
  }
}
