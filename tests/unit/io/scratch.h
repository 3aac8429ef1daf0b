// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <unistd.h>

namespace ogive::test
{
/// An empty directory of its own for each test, removed at its end.
class Scratch : public ::testing::Test
{
protected:
  Scratch()
    : directory_(std::filesystem::temp_directory_path() /
                 ("ogive-" + std::to_string(::getpid()) + "-" +
                  ::testing::UnitTest::GetInstance()->current_test_info()->name()))
  {
    std::filesystem::create_directories(directory_);
  }
  ~Scratch() override { std::filesystem::remove_all(directory_); }

  std::string in(const std::string &name) const { return (directory_ / name).string(); }
  std::string directory() const { return directory_.string(); }

private:
  std::filesystem::path directory_;
};

inline std::string bytes_of(const std::string &path)
{
  std::ifstream      file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline void write_bytes(const std::string &path, const std::string &bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

/// The message of the `Error` that `action` throws.
template <class Error, class Action>
std::string message_of(const Action &action)
{
  try
    {
      action();
    }
  catch (const Error &e)
    {
      return e.what();
    }
  ADD_FAILURE() << "nothing of the expected kind was thrown";
  return {};
}

inline void expect_parts(const std::string &text, std::initializer_list<const char *> parts)
{
  for (const char *part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << '"' << part << "\" in: " << text;
}
} // namespace ogive::test
