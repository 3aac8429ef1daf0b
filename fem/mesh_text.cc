// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/mesh_text.h"

#include <charconv>

namespace ogive::fem
{
namespace
{
std::string trimmed(const std::string &text)
{
  const char *blank = " \t\r\n";
  const auto  first = text.find_first_not_of(blank);
  return first == std::string::npos ? std::string() : text.substr(first, text.find_last_not_of(blank) - first + 1);
}
} // namespace

MeshText::MeshText(std::string path, std::string separators)
  : path_(std::move(path))
  , separators_(separators + " \t\r")
  , in_(path_)
{
  if (!in_)
    throw InputError({path_, 0, {}}, "the mesh file cannot be read");
}

bool MeshText::next()
{
  if (again_)
  {
    again_ = false;
    return true;
  }
  for (std::string raw; std::getline(in_, raw);)
  {
    ++number_;
    line_ = trimmed(raw);
    if (line_.empty())
      continue;
    words_.clear();
    for (std::size_t at = 0; (at = line_.find_first_not_of(separators_, at)) != std::string::npos;)
    {
      const std::size_t end = std::min(line_.find_first_of(separators_, at), line_.size());
      words_.push_back(line_.substr(at, end - at));
      at = end;
    }
    return true;
  }
  return false;
}

void MeshText::must_have(const std::string &what)
{
  if (!next())
    refuse("the file ends within " + what);
}

std::int64_t MeshText::integer(std::size_t k) const
{
  std::int64_t value = 0;
  if (k >= words_.size())
    refuse("the line has " + std::to_string(words_.size()) + " words", "at least " + std::to_string(k + 1));
  const std::string &w = words_[k];
  const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), value);
  if (error != std::errc() || end != w.data() + w.size())
    refuse("\"" + w + "\" is not a whole number");
  return value;
}

double MeshText::number(std::size_t k) const
{
  double value = 0;
  if (k >= words_.size())
    refuse("the line has " + std::to_string(words_.size()) + " words", "at least " + std::to_string(k + 1));
  const std::string &w     = words_[k];
  const char        *first = w.data() + (w.starts_with('+') ? 1 : 0);
  const auto [end, error]  = std::from_chars(first, w.data() + w.size(), value);
  if (error != std::errc() || end != w.data() + w.size())
    refuse("\"" + w + "\" is not a number");
  return value;
}

void MeshText::refuse(const std::string &wrong, const std::string &expected, const std::string &suggestion) const
{
  throw InputError({path_, number_, {}}, wrong, expected, suggestion);
}
} // namespace ogive::fem
