// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace ogive::fem
{
/// The lines of a mesh file as words, with the number of the line for errors.
class MeshText
{
public:
  /// `separators`: what stands between words, beside blanks. Throws InputError
  /// if the file cannot be read.
  MeshText(std::string path, std::string separators = {});

  /// Goes to the next line that is not blank; false at the end of the file.
  bool next();
  /// The same, or InputError saying that the file ends within `what`.
  void must_have(const std::string &what);
  /// The next line() is this one again.
  void put_back() { again_ = true; }

  const std::string              &line() const { return line_; } ///< without blanks around it
  const std::vector<std::string> &words() const { return words_; }

  /// Word k of the line as a number. Throws InputError if it is none or missing.
  std::int64_t integer(std::size_t k) const;
  double       number(std::size_t k) const;

  [[noreturn]] void refuse(const std::string &wrong, const std::string &expected = {},
                           const std::string &suggestion = {}) const;

private:
  std::string              path_, separators_;
  std::ifstream            in_;
  int                      number_ = 0;
  bool                     again_  = false;
  std::string              line_;
  std::vector<std::string> words_;
};
} // namespace ogive::fem
