// SPDX-License-Identifier: LGPL-2.1-or-later
// Every value of every material file has a source of a known kind. Reads the
// files as lines of text: the reader proper has its own tests.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>

namespace
{
std::map<std::string, std::string> entries(const std::filesystem::path &file)
{
  std::map<std::string, std::string> all;
  std::ifstream                      in(file);
  std::string                        line, section;
  while (std::getline(in, line))
    {
      const auto start = line.find_first_not_of(' ');
      if (start == std::string::npos || line[start] == '#')
        continue;
      line = line.substr(start);
      if (line.rfind("subsection ", 0) == 0)
        section = line.substr(11) + "/";
      else if (line == "end")
        section.clear();
      else
        {
          const auto equals = line.find(" = ");
          EXPECT_EQ(line.rfind("set ", 0), 0u) << file << ": " << line;
          EXPECT_NE(equals, std::string::npos) << file << ": " << line;
          EXPECT_TRUE(all.emplace(section + line.substr(4, equals - 4), line.substr(equals + 3)).second)
            << file << ": twice " << line;
        }
    }
  EXPECT_TRUE(section.empty()) << file;
  return all;
}
} // namespace

TEST(Library, EveryValueHasASource)
{
  const std::set<std::string> kinds = {"exact", "test", "code", "handbook", "memory"};
  int                         files = 0;
  for (const auto &item :
       std::filesystem::directory_iterator(OGIVE_SOURCE_DIR "/core/materials/library"))
    {
      if (item.path().extension() != ".prm")
        continue;
      ++files;
      const auto all = entries(item.path());
      EXPECT_EQ(all.count("title"), 1u) << item.path();
      for (const auto &[name, value] : all)
        {
          if (name.rfind("Ranges/", 0) == 0 || name == "title" ||
              (name.size() > 4 && name.substr(name.size() - 4) == "/law"))
            continue;
          if (name.rfind("Sources/", 0) == 0)
            {
              EXPECT_EQ(all.count(name.substr(8)), 1u) << item.path() << ": source of no value " << name;
              EXPECT_EQ(kinds.count(value.substr(0, value.find(':'))), 1u) << item.path() << ": " << value;
            }
          else
            EXPECT_EQ(all.count("Sources/" + name), 1u) << item.path() << ": no source of " << name;
        }
    }
  EXPECT_GE(files, 16);
}

// Plastic modulus of Arne steel from its tangent modulus: H = E Et/(E - Et).
TEST(Library, ArnePlasticModulus)
{
  const auto all = entries(OGIVE_SOURCE_DIR "/core/materials/library/arne-tool-steel.prm");
  EXPECT_NEAR(std::stod(all.at("Strength/hardening modulus")), 204. * 15 / (204 - 15), 1e-6);
}
