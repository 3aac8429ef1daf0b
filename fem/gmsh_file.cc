// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/mesh_file.h"
#include "fem/mesh_text.h"

#include <cstdlib>
#include <unordered_map>

/// The text formats of gmsh: 2.2, and 4.0 and 4.1, in which elements belong to
/// entities of the geometry and those to physical groups.
namespace ogive::fem
{
namespace
{
/// gmsh's types of elements.
struct Kind
{
  const char *name;
  int         dim; ///< of a line, quadrilateral, hexahedron; -1: skipped; -2: refused
};

Kind kind_of(std::int64_t type)
{
  switch (type)
  {
    case 1:
      return {"lines", 1};
    case 3:
      return {"quadrilaterals", 2};
    case 5:
      return {"hexahedra", 3};
    case 15:
      return {"points", -1};
    case 2:
      return {"triangles", -2};
    case 4:
      return {"tetrahedra", -2};
    case 6:
      return {"wedges", -2};
    case 7:
      return {"pyramids", -2};
    case 8:
    case 9:
    case 10:
    case 11:
    case 12:
    case 16:
    case 17:
      return {"elements of second order", -2};
    default:
      return {"elements of a kind unknown here", -2};
  }
}

class Reader
{
public:
  explicit Reader(const std::string &path)
    : text_(path)
  {}

  MeshFile read();

private:
  void format();
  void names();
  void entities();
  void nodes_2();
  void nodes_4();
  void elements_2();
  void elements_4();
  void node(std::int64_t tag, std::size_t first_word);
  void element(std::int64_t type, std::size_t first_node, const std::vector<std::int64_t> &groups);
  void end(const std::string &section);
  void skip(const std::string &section);

  using Key = std::pair<int, std::int64_t>; // dimension, number
  std::size_t group(Key);

  MeshText                                        text_;
  MeshFile                                        mesh_;
  int                                             version_ = 0; // 22, 40, 41
  std::map<Key, std::string>                      names_;
  std::map<Key, std::size_t>                      group_of_;
  std::map<Key, std::vector<std::int64_t>>        physical_; // groups of an entity
  std::unordered_map<std::int64_t, std::uint32_t> node_of_;
};

MeshFile Reader::read()
{
  while (text_.next())
  {
    const std::string section = text_.line();
    if (section == "$MeshFormat")
      format();
    else if (version_ == 0)
      text_.refuse("the file does not begin as a file of gmsh", "\"$MeshFormat\"");
    else if (section == "$PhysicalNames")
      names();
    else if (section == "$Entities" && version_ > 22)
      entities();
    else if (section == "$Nodes")
      version_ == 22 ? nodes_2() : nodes_4();
    else if (section == "$Elements")
      version_ == 22 ? elements_2() : elements_4();
    else if (section.starts_with("$") && !section.starts_with("$End"))
      skip(section.substr(1)); // without use here
    else
      text_.refuse("\"" + section + "\" stands outside of any section");
  }
  if (mesh_.x.empty() || (mesh_.elements.empty() && mesh_.others.empty()))
    text_.refuse("the file has no nodes or no elements", "sections \"$Nodes\" and \"$Elements\"",
                 "with physical groups gmsh writes only what is in one (Mesh.SaveAll = 1 writes all)");
  return mesh_;
}

void Reader::end(const std::string &section)
{
  text_.must_have("\"$" + section + "\"");
  if (text_.line() != "$End" + section)
    text_.refuse("the section is longer than it says", "\"$End" + section + "\"");
}

void Reader::skip(const std::string &section)
{
  do
    text_.must_have("\"$" + section + "\"");
  while (text_.line() != "$End" + section);
}

void Reader::format()
{
  text_.must_have("\"$MeshFormat\"");
  const double version = text_.number(0);
  if (version >= 2.15 && version < 3)
    version_ = 22;
  else if (version >= 4 && version < 4.05)
    version_ = 40;
  else if (version >= 4.05 && version < 5)
    version_ = 41;
  else
    text_.refuse("version " + text_.words()[0] + " of gmsh's format is not read", "2.2, 4.0 or 4.1",
                 "save with \"gmsh -format msh41\"");
  if (text_.integer(1) != 0)
    text_.refuse("the file is binary", "a text", "save with Mesh.Binary = 0");
  mesh_.format = version_ == 22 ? "gmsh 2.2" : version_ == 40 ? "gmsh 4.0" : "gmsh 4.1";
  end("MeshFormat");
}

void Reader::names()
{
  text_.must_have("\"$PhysicalNames\"");
  const std::int64_t n = text_.integer(0);
  for (std::int64_t k = 0; k < n; ++k)
  {
    text_.must_have("\"$PhysicalNames\"");
    const std::string &line  = text_.line();
    const std::size_t  first = line.find('"'), last = line.rfind('"');
    if (first == last)
      text_.refuse("a group has no name in quotes", "dimension, number and \"name\"");
    names_[{static_cast<int>(text_.integer(0)), text_.integer(1)}] = line.substr(first + 1, last - first - 1);
  }
  end("PhysicalNames");
}

void Reader::entities()
{
  text_.must_have("\"$Entities\"");
  std::array<std::int64_t, 4> count{};
  for (int dim = 0; dim < 4; ++dim)
    count[dim] = text_.integer(dim);
  for (int dim = 0; dim < 4; ++dim)
    for (std::int64_t k = 0; k < count[dim]; ++k)
    {
      text_.must_have("\"$Entities\"");
      const std::size_t  at = dim == 0 && version_ == 41 ? 4 : 7; // past tag and place or box
      const std::int64_t n  = text_.integer(at);
      for (std::int64_t g = 0; g < n; ++g)
        physical_[{dim, text_.integer(0)}].push_back(std::abs(text_.integer(at + 1 + g)));
    }
  end("Entities");
}

void Reader::node(std::int64_t tag, std::size_t first)
{
  if (!node_of_.emplace(tag, static_cast<std::uint32_t>(mesh_.x.size())).second)
    text_.refuse("there is a second node " + std::to_string(tag));
  mesh_.x.push_back({text_.number(first), text_.number(first + 1), text_.number(first + 2)});
}

void Reader::nodes_2()
{
  text_.must_have("\"$Nodes\"");
  const std::int64_t n = text_.integer(0);
  for (std::int64_t k = 0; k < n; ++k)
  {
    text_.must_have("\"$Nodes\"");
    node(text_.integer(0), 1);
  }
  end("Nodes");
}

void Reader::nodes_4()
{
  text_.must_have("\"$Nodes\"");
  const std::int64_t       blocks = text_.integer(0);
  std::vector<std::int64_t> tags;
  for (std::int64_t b = 0; b < blocks; ++b)
  {
    text_.must_have("\"$Nodes\"");
    const std::int64_t n = text_.integer(3);
    tags.clear();
    for (std::int64_t k = 0; k < n && version_ == 41; ++k)
    {
      text_.must_have("\"$Nodes\"");
      tags.push_back(text_.integer(0));
    }
    for (std::int64_t k = 0; k < n; ++k)
    {
      text_.must_have("\"$Nodes\"");
      version_ == 41 ? node(tags[k], 0) : node(text_.integer(0), 1);
    }
  }
  end("Nodes");
}

std::size_t Reader::group(Key key)
{
  const auto [at, fresh] = group_of_.try_emplace(key, mesh_.groups.size());
  if (fresh)
  {
    const auto name = names_.find(key);
    mesh_.groups.push_back({key.first, name == names_.end() ? std::to_string(key.second) : name->second,
                            static_cast<int>(key.second), {}});
  }
  return at->second;
}

void Reader::element(std::int64_t type, std::size_t first, const std::vector<std::int64_t> &groups)
{
  const Kind kind = kind_of(type);
  if (kind.dim == -2)
    ++mesh_.others[kind.name];
  if (kind.dim < 0)
    return;
  MeshFile::Element e;
  e.number = text_.integer(0);
  e.dim    = kind.dim;
  for (int a = 0; a < 1 << kind.dim; ++a)
  {
    const auto at = node_of_.find(text_.integer(first + a));
    if (at == node_of_.end())
      text_.refuse("element " + text_.words()[0] + " has a node " + text_.words()[first + a] + " that is not there");
    e.node[a] = at->second;
  }
  for (const std::int64_t g : groups)
    if (g != 0)
      mesh_.groups[group({kind.dim, g})].elements.push_back(static_cast<std::uint32_t>(mesh_.elements.size()));
  mesh_.elements.push_back(e);
}

void Reader::elements_2()
{
  text_.must_have("\"$Elements\"");
  const std::int64_t n = text_.integer(0);
  for (std::int64_t k = 0; k < n; ++k)
  {
    text_.must_have("\"$Elements\"");
    const std::int64_t tags = text_.integer(2);
    element(text_.integer(1), 3 + tags,
            tags > 0 ? std::vector<std::int64_t>{std::abs(text_.integer(3))} : std::vector<std::int64_t>{});
  }
  end("Elements");
}

void Reader::elements_4()
{
  text_.must_have("\"$Elements\"");
  const std::int64_t blocks = text_.integer(0);
  for (std::int64_t b = 0; b < blocks; ++b)
  {
    text_.must_have("\"$Elements\"");
    const bool         new_order = version_ == 41;
    const Key          entity{static_cast<int>(text_.integer(new_order ? 0 : 1)), text_.integer(new_order ? 1 : 0)};
    const std::int64_t type = text_.integer(2), n = text_.integer(3);
    for (std::int64_t k = 0; k < n; ++k)
    {
      text_.must_have("\"$Elements\"");
      element(type, 1, physical_[entity]);
    }
  }
  end("Elements");
}
} // namespace

MeshFile read_gmsh(const std::string &path)
{
  return Reader(path).read();
}
} // namespace ogive::fem
