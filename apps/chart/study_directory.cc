// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/study_directory.h"

#include "core/io/files.h"

#include <algorithm>
#include <filesystem>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

namespace ogive::chart
{
namespace fs = std::filesystem;

namespace
{
using Json = nlohmann::ordered_json;

/// Null where there is no such file or it cannot be understood.
Json read_json(const std::string &file)
{
  if (!fs::is_regular_file(file))
    return nullptr;
  const Json j = Json::parse(io::read_whole(file), nullptr, false);
  return j.is_object() ? j : Json(nullptr);
}

std::string text_in(const Json &j, const char *name)
{
  return j.is_object() && j.contains(name) && j.at(name).is_string() ? j.at(name).get<std::string>() : "";
}

double number_in(const Json &j, const char *name)
{
  return j.is_object() && j.contains(name) && j.at(name).is_number() ? j.at(name).get<double>() : 0;
}
} // namespace

StudyDirectory::~StudyDirectory()
{
  if (lock_ >= 0)
    ::close(lock_);
}

void StudyDirectory::look(const std::string &study, bool force) const
{
  std::error_code error;
  if (!fs::exists(path_, error))
    return;
  if (!fs::is_directory(path_, error))
    throw InputError({path_, 0, {}}, "cannot write results here: it is not a directory", "a directory",
                     "choose another with -o DIR");
  if (fs::is_empty(path_, error) || force)
    return;
  const std::string other = text_in(read_json(path_ + "/study.json"), "study");
  if (other != study)
    throw InputError({path_, 0, {}},
                     other.empty() ? "holds files that are not of this study" : "holds another study, \"" + other + "\"",
                     "a new or empty directory, or that of \"" + study + "\"",
                     "choose another with -o DIR, or replace the results with --force");
}

void StudyDirectory::take(const std::string &study)
{
  std::error_code error;
  fs::create_directories(path_ + "/rows", error);
  if (error)
    throw InputError({path_, 0, {}}, "cannot write results here: " + error.message(), "a directory that can be written",
                     "choose another with -o DIR");
  lock_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0 || ::flock(lock_, LOCK_EX | LOCK_NB) != 0)
    throw InputError({path_, 0, {}}, "another \"ogive chart\" works here", "a directory of its own",
                     "wait for it, or choose another with -o DIR");
  const Json known = read_json(path_ + "/study.json");
  if (known.is_object() && known.contains("files") && known.at("files").is_array())
    for (const Json &file : known.at("files"))
      before_.push_back(file.is_string() ? file.get<std::string>() : "");
  io::write_whole(path_ + "/study.json", Json({{"study", study}, {"files", before_}}).dump(2) + "\n");
}

std::optional<Outcome> StudyDirectory::recall(const std::string &name, const Identity &identity) const
{
  const std::string folder = row(name);
  const Json        record = read_json(folder + "/row.json");
  const std::string status = text_in(record, "status");
  if (status.empty() || text_in(record, "commit") != identity.commit || text_in(record, "scene") != identity.resolved)
    return {};
  Outcome o;
  o.reason = text_in(record, "reason");
  o.wall_s = number_in(record, "wall_s");
  if (status == describe(Status::failed))
    return o;
  if (status == describe(Status::too_long))
  {
    // with more time it may come to an end
    o.status = Status::too_long;
    return identity.limit_s > 0 && identity.limit_s <= number_in(record, "limit_s") ? std::optional(o) : std::nullopt;
  }
  const std::string summary = folder + "/summary.json";
  if (!fs::is_regular_file(summary) || commit_of_summary(summary) != identity.commit)
    return {};
  o.status = Status::done;
  read_summary(summary, o);
  return o;
}

void StudyDirectory::forget(const std::string &name) const
{
  std::error_code ignored;
  fs::create_directories(row(name), ignored);
  fs::remove(row(name) + "/row.json", ignored);
}

void StudyDirectory::record(const std::string &name, const Identity &identity, const Outcome &o) const
{
  const Json all = {{"row", name},
                    {"status", describe(o.status)},
                    {"reason", o.reason},
                    {"wall_s", o.wall_s},
                    {"limit_s", identity.limit_s},
                    {"commit", identity.commit},
                    {"scene", identity.resolved}};
  io::write_whole(row(name) + "/row.json", all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

void StudyDirectory::write(const std::string &name, const std::string &text)
{
  io::write_whole(path_ + "/" + name, text);
  written_.push_back(name);
}

void StudyDirectory::finish(const std::string &study)
{
  for (const std::string &old : before_)
    if (!old.empty() && old.find('/') == std::string::npos &&
        std::find(written_.begin(), written_.end(), old) == written_.end())
    {
      std::error_code ignored;
      fs::remove(path_ + "/" + old, ignored);
    }
  io::write_whole(path_ + "/study.json", Json({{"study", study}, {"files", written_}}).dump(2) + "\n");
}
} // namespace ogive::chart
