// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/mesh_file.h"
#include "fem/mesh_text.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <unordered_map>

/// The mesh of an Abaqus input file: *NODE, *ELEMENT, *ELSET, *SURFACE of one
/// part. Keywords without geometry (materials, steps) are passed over.
namespace ogive::fem
{
namespace
{
std::string upper(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

std::string bare(const std::string &text)
{
  const char *around = " \t\"";
  const auto  first  = text.find_first_not_of(around);
  return first == std::string::npos ? std::string() : text.substr(first, text.find_last_not_of(around) - first + 1);
}

/// What Abaqus calls a type of element.
struct Kind
{
  const char *name; ///< where it is refused
  int         dim;
};

Kind kind_of(const std::string &type)
{
  const auto is = [&](std::initializer_list<const char *> beginnings) {
    return std::any_of(beginnings.begin(), beginnings.end(), [&](const char *b) {
      return type.starts_with(b) &&
             (type.size() == std::string(b).size() || !std::isdigit(static_cast<unsigned char>(type[std::string(b).size()])));
    });
  };
  if (is({"C3D8"}))
    return {"", 3};
  if (is({"CPE4", "CPS4", "CAX4", "CGAX4", "S4", "M3D4", "R3D4", "SFM3D4"}))
    return {"", 2};
  if (is({"T2D2", "T3D2", "B21", "B31", "R2D2", "RAX2", "SAX1"}))
    return {"", 1};
  if (is({"C3D4"}))
    return {"tetrahedra", -1};
  if (is({"C3D6"}))
    return {"wedges", -1};
  if (is({"CPE3", "CPS3", "CAX3", "S3", "STRI3", "M3D3", "R3D3", "SFM3D3"}))
    return {"triangles", -1};
  if (is({"C3D10", "C3D15", "C3D20", "C3D27", "CPE6", "CPS6", "CAX6", "CPE8", "CPS8", "CAX8", "S8"}))
    return {"elements of second order", -1};
  return {"elements of a kind unknown here", -1};
}

class Reader
{
public:
  explicit Reader(const std::string &path)
    : text_(path, ",")
  {}

  MeshFile read();

private:
  /// "*ELSET, ELSET=top, GENERATE": the keyword and its parameters, upper case;
  /// values as they stand.
  struct Keyword
  {
    std::string                        name;
    std::map<std::string, std::string> parameters;
    std::string                        value(const std::string &key) const
    {
      const auto at = parameters.find(key);
      return at == parameters.end() ? std::string() : at->second;
    }
  };
  Keyword keyword();
  bool    data(); ///< the next line, if it holds data of the keyword
  void    check(const Keyword &);
  void    nodes();
  void    elements(const Keyword &);
  void    set(const Keyword &);
  void    surface(const Keyword &);
  void    faces(const std::vector<std::uint32_t> &of, const std::string &face, int group_dim, const std::string &name);

  std::vector<std::uint32_t>       &members(const std::string &set) { return sets_[upper(set)].members; }
  const std::vector<std::uint32_t> &known(const std::string &word);
  void                              add_groups();

  struct Set
  {
    std::string                name;
    std::vector<std::uint32_t> members;
  };
  MeshText                                        text_;
  MeshFile                                        mesh_;
  int                                             parts_ = 0;
  std::map<std::string, Set>                      sets_; // by name in upper case
  std::unordered_map<std::int64_t, std::uint32_t> node_of_, element_of_;
  std::set<std::int64_t>                          passed_over_; // elements of other kinds
  std::vector<std::uint32_t>                      single_;
};

Reader::Keyword Reader::keyword()
{
  std::string line = text_.line();
  while (line.ends_with(","))
  {
    text_.must_have("the keyword");
    line += text_.line();
  }
  Keyword result;
  for (std::size_t at = 0, k = 0; at <= line.size(); ++k)
  {
    const std::size_t end  = std::min(line.find(',', at), line.size());
    const std::string word = line.substr(at, end - at);
    const std::size_t is   = word.find('=');
    if (k == 0)
      result.name = upper(bare(word));
    else if (is == std::string::npos)
      result.parameters[upper(bare(word))];
    else
      result.parameters[upper(bare(word.substr(0, is)))] = bare(word.substr(is + 1));
    at = end + 1;
  }
  return result;
}

bool Reader::data()
{
  while (text_.next())
  {
    if (text_.line().starts_with("**"))
      continue;
    if (!text_.line().starts_with("*"))
      return true;
    text_.put_back();
    return false;
  }
  return false;
}

void Reader::check(const Keyword &k)
{
  if (k.name == "*PART" && ++parts_ > 1)
    text_.refuse("the file has a second part; numbers of nodes are no longer unique", "one part",
                 "write the input file without parts and assemblies, or one file a part");
  for (const char *unread : {"*INCLUDE", "*NGEN", "*NFILL", "*NCOPY", "*ELGEN", "*ELCOPY", "*SYSTEM", "*NMAP"})
    if (k.name == unread)
      text_.refuse("the keyword " + k.name + " is not read", "nodes and elements, each with its numbers");
  if (k.name == "*INSTANCE" && data())
    text_.refuse("the instance is moved from where its part stands", "an instance in place");
}

MeshFile Reader::read()
{
  mesh_.format = "Abaqus";
  while (text_.next())
  {
    if (!text_.line().starts_with("*") || text_.line().starts_with("**"))
      continue; // data of a keyword that was passed over, or a comment
    const Keyword k = keyword();
    check(k);
    if (k.name == "*NODE")
      nodes();
    else if (k.name == "*ELEMENT")
      elements(k);
    else if (k.name == "*ELSET")
      set(k);
    else if (k.name == "*SURFACE" && (k.value("TYPE").empty() || upper(k.value("TYPE")) == "ELEMENT"))
      surface(k);
  }
  if (mesh_.x.empty() || (mesh_.elements.empty() && mesh_.others.empty()))
    text_.refuse("the file has no nodes or no elements", "keywords *NODE and *ELEMENT");
  add_groups();
  return mesh_;
}

void Reader::nodes()
{
  while (data())
  {
    std::array<double, 3> x{};
    for (std::size_t i = 0; i < 3 && i + 1 < text_.words().size(); ++i)
      x[i] = text_.number(i + 1);
    if (!node_of_.emplace(text_.integer(0), static_cast<std::uint32_t>(mesh_.x.size())).second)
      text_.refuse("there is a second node " + text_.words()[0]);
    mesh_.x.push_back(x);
  }
}

void Reader::elements(const Keyword &k)
{
  const std::string type = upper(k.value("TYPE"));
  if (type.empty())
    text_.refuse("the elements have no type", "\"TYPE=\" and a type, such as C3D8R");
  const Kind        kind = kind_of(type);
  const std::string name = k.value("ELSET");
  while (data())
  {
    if (kind.dim < 0)
    {
      for (bool more = text_.line().ends_with(","); more && data();)
        more = text_.line().ends_with(",");
      ++mesh_.others[kind.name];
      passed_over_.insert(text_.integer(0));
      continue;
    }
    MeshFile::Element e;
    e.number = text_.integer(0);
    e.dim    = kind.dim;
    if (text_.words().size() != 1u + (1u << kind.dim))
      text_.refuse("an element of type " + type + " has " + std::to_string(text_.words().size() - 1) + " nodes",
                   std::to_string(1 << kind.dim));
    for (int a = 0; a < 1 << kind.dim; ++a)
    {
      const auto at = node_of_.find(text_.integer(1 + a));
      if (at == node_of_.end())
        text_.refuse("element " + text_.words()[0] + " has a node " + text_.words()[1 + a] + " that is not there");
      e.node[a] = at->second;
    }
    const auto index = static_cast<std::uint32_t>(mesh_.elements.size());
    if (!element_of_.emplace(e.number, index).second)
      text_.refuse("there is a second element " + text_.words()[0]);
    mesh_.elements.push_back(e);
    if (!name.empty())
    {
      sets_[upper(name)].name = name;
      members(name).push_back(index);
    }
  }
}

/// Elements that a word of a set or surface means: a number or another set.
const std::vector<std::uint32_t> &Reader::known(const std::string &word)
{
  if (const auto set = sets_.find(upper(bare(word))); set != sets_.end())
    return set->second.members;
  const bool number = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c); });
  single_.clear();
  if (!number)
    text_.refuse("there is no element set \"" + word + "\" above this line");
  const std::int64_t value = std::stoll(word);
  if (const auto at = element_of_.find(value); at != element_of_.end())
    single_.push_back(at->second);
  else if (!passed_over_.contains(value))
    text_.refuse("there is no element " + word + " above this line");
  return single_;
}

void Reader::set(const Keyword &k)
{
  const std::string name = k.value("ELSET");
  if (name.empty())
    text_.refuse("the set has no name", "\"ELSET=\" and a name");
  sets_[upper(name)].name = name;
  while (data())
  {
    std::vector<std::string> words = text_.words();
    if (k.parameters.contains("GENERATE"))
    {
      const std::int64_t first = text_.integer(0), last = text_.integer(1),
                         step = words.size() > 2 ? text_.integer(2) : 1;
      if (step < 1 || last < first)
        text_.refuse("no elements are generated", "first, last and step");
      words.clear();
      for (std::int64_t e = first; e <= last; e += step)
        words.push_back(std::to_string(e));
    }
    for (const std::string &word : words)
    {
      const std::vector<std::uint32_t> more = known(word);
      members(name).insert(members(name).end(), more.begin(), more.end());
    }
  }
}

void Reader::surface(const Keyword &k)
{
  const std::string name = k.value("NAME");
  if (name.empty())
    text_.refuse("the surface has no name", "\"NAME=\" and a name");
  int dim = 0;
  while (data())
  {
    const std::vector<std::uint32_t> of   = known(text_.words()[0]);
    const std::string                face = text_.words().size() > 1 ? upper(text_.words()[1]) : std::string();
    if (of.empty())
      continue;
    dim = mesh_.elements[of.front()].dim - 1;
    for (const std::uint32_t e : of)
      if (mesh_.elements[e].dim != dim + 1)
        text_.refuse("the set mixes elements of several dimensions", "faces of one kind of element");
    faces(of, face, dim, name);
  }
}

/// Faces become elements of their own; those inside a body are passed over later.
void Reader::faces(const std::vector<std::uint32_t> &of, const std::string &face, int dim, const std::string &name)
{
  auto at = std::find_if(mesh_.groups.begin(), mesh_.groups.end(),
                         [&](const auto &g) { return g.name == name && g.dim == dim; });
  if (at == mesh_.groups.end())
    at = mesh_.groups.insert(at, {dim, name, 0, {}});
  const auto n = static_cast<int>(2 * (dim + 1));
  int        only = 0; // all
  if (!face.empty())
  {
    only = face.size() == 2 && face[0] == 'S' ? face[1] - '0' : 0;
    if (only < 1 || only > n)
      text_.refuse("\"" + face + "\" is no face of the element", "S1 to S" + std::to_string(n));
  }
  for (const std::uint32_t e : of)
    for (int f = 1; f <= n; ++f)
      if (only == 0 || f == only)
      {
        const auto        corners = faces_of(mesh_.elements[e])[f - 1];
        MeshFile::Element element;
        element.number = mesh_.elements[e].number;
        element.dim    = dim;
        std::copy(corners.begin(), corners.end(), element.node.begin());
        at->elements.push_back(static_cast<std::uint32_t>(mesh_.elements.size()));
        mesh_.elements.push_back(element);
      }
}

void Reader::add_groups()
{
  for (const auto &[key, set] : sets_)
    for (int dim = 1; dim <= 3; ++dim)
    {
      MeshFile::Group group{dim, set.name, 0, {}};
      for (const std::uint32_t e : set.members)
        if (mesh_.elements[e].dim == dim)
          group.elements.push_back(e);
      if (!group.elements.empty())
        mesh_.groups.push_back(std::move(group));
    }
}
} // namespace

MeshFile read_abaqus(const std::string &path)
{
  return Reader(path).read();
}
} // namespace ogive::fem
