// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/listing.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>
#include <sstream>

namespace ogive::input
{
namespace
{
/// Counts lines while the JSON parser reads, so that a key knows its line.
class LineIterator
{
public:
  using iterator_category = std::input_iterator_tag;
  using value_type        = char;
  using difference_type   = std::ptrdiff_t;
  using pointer           = const char *;
  using reference         = const char &;

  LineIterator(const char *at, int *line)
    : at_(at)
    , line_(line)
  {}

  const char   &operator*() const { return *at_; }
  LineIterator &operator++()
  {
    *line_ += *at_ == '\n';
    ++at_;
    return *this;
  }
  LineIterator operator++(int)
  {
    LineIterator old = *this;
    ++*this;
    return old;
  }
  bool operator==(const LineIterator &o) const { return at_ == o.at_; }
  bool operator!=(const LineIterator &o) const { return at_ != o.at_; }

private:
  const char *at_;
  int        *line_;
};

/// Turns the parser's events into a listing.
class Events : public nlohmann::json_sax<nlohmann::json>
{
public:
  Events(Listing &listing, const int &line)
    : listing_(listing)
    , line_(line)
  {}

  bool null() override { return refuse("null is no value"); }
  bool boolean(bool v) override { return scalar(v ? "true" : "false"); }
  bool number_integer(number_integer_t v) override { return scalar(std::to_string(v)); }
  bool number_unsigned(number_unsigned_t v) override { return scalar(std::to_string(v)); }
  bool number_float(number_float_t, const string_t &text) override { return scalar(text); }
  bool string(string_t &v) override { return scalar(v); }
  bool binary(binary_t &) override { return refuse("binary data is no value"); }

  bool start_object(std::size_t) override
  {
    if (in_array_)
      return refuse("an array holds names or numbers, not objects");
    if (started_)
    {
      sections_.push_back(join_path(section(), key_));
      listing_.sections.push_back({section(), listing_.file, key_line_});
    }
    started_ = true;
    return true;
  }
  bool end_object() override
  {
    if (!sections_.empty())
      sections_.pop_back();
    return true;
  }
  bool key(string_t &k) override
  {
    key_      = k;
    key_line_ = line_;
    return true;
  }
  bool start_array(std::size_t) override
  {
    if (in_array_ || !started_)
      return refuse("an array stands for a list of names or numbers");
    in_array_ = true;
    list_.clear();
    return true;
  }
  bool end_array() override
  {
    in_array_ = false;
    return scalar(join(list_));
  }
  bool parse_error(std::size_t, const std::string &, const nlohmann::json::exception &e) override
  {
    const std::string text = e.what();
    const std::size_t at   = text.find("syntax error");
    throw InputError({listing_.file, line_, {}}, at == std::string::npos ? text : text.substr(at));
  }

private:
  std::string section() const { return sections_.empty() ? "" : sections_.back(); }

  bool refuse(const std::string &why)
  {
    throw InputError({listing_.file, line_, join_path(section(), key_)}, why, "a text or a number");
  }

  bool scalar(const std::string &v)
  {
    if (!started_)
      return refuse("the file holds no object");
    // such a text could not be written into a .prm file again
    if (v.find_first_of("#\n\\") != std::string::npos)
      return refuse("a text cannot hold \"#\", \"\\\" or a line break");
    if (in_array_)
      list_.push_back(v);
    else
      listing_.add({section(), key_, trim(v), listing_.file, key_line_});
    return true;
  }

  Listing                 &listing_;
  const int               &line_;
  std::vector<std::string> sections_, list_;
  std::string              key_;
  int                      key_line_ = 0;
  bool                     started_ = false, in_array_ = false;
};
} // namespace

Listing list_json(const std::string &file)
{
  std::ifstream in(file);
  if (!in)
    throw InputError("cannot read \"" + file + "\"");
  std::ostringstream buffer;
  buffer << in.rdbuf();
  const std::string text = buffer.str();

  Listing listing;
  listing.file = file;
  int    line  = 1;
  Events events(listing, line);
  nlohmann::json::sax_parse(LineIterator(text.data(), &line), LineIterator(text.data() + text.size(), &line), &events);
  return listing;
}
} // namespace ogive::input
