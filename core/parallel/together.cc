// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/parallel/together.h"

#include "core/base/error.h"

#include <mpi.h>

#include <array>
#include <cstdio>
#include <exception>
#include <optional>
#include <vector>

#include <unistd.h>

namespace ogive
{
namespace
{
/// An exception as it goes from rank to rank: a letter for its kind, then texts
/// that end with zero bytes. Empty: none.
std::string packed(const std::exception_ptr &error)
{
  if (!error)
    return {};
  const auto text = [](const std::string &s) { return s + '\0'; };
  try
  {
    std::rethrow_exception(error);
  }
  catch (const InputError &e)
  {
    return "I" + text(e.where().file) + text(std::to_string(e.where().line)) + text(e.where().entry) +
           text(e.complaint());
  }
  catch (const std::exception &e)
  {
    return "R" + text(e.what());
  }
  catch (...)
  {
    return "R" + text("an exception of an unknown kind");
  }
}

[[noreturn]] void throw_packed(const std::string &error)
{
  std::vector<std::string> texts;
  for (std::size_t at = 1, end; at < error.size(); at = end + 1)
  {
    end = error.find('\0', at);
    texts.push_back(error.substr(at, end - at));
  }
  if (error[0] == 'I')
    throw InputError({texts.at(0), std::stoi(texts.at(1)), texts.at(2)}, texts.at(3));
  throw RunError(texts.at(0));
}

std::exception_ptr caught_from(const std::function<void()> &f)
{
  try
  {
    f();
  }
  catch (...)
  {
    return std::current_exception();
  }
  return nullptr;
}

/// Of rank `from`, on all.
std::string broadcast_text(const Ranks &ranks, std::string text, int from)
{
  auto size = static_cast<std::int64_t>(text.size());
  ranks.broadcast(std::span(&size, 1), from);
  text.resize(static_cast<std::size_t>(size));
  if (size > 0)
    ranks.broadcast(std::span(text), from);
  return text;
}

void throw_alike(const Ranks &ranks, const std::exception_ptr &own, int from)
{
  const std::string error = broadcast_text(ranks, ranks.rank() == from ? packed(own) : std::string(), from);
  if (own)
    std::rethrow_exception(own);
  if (!error.empty())
    throw_packed(error);
}
} // namespace

void agreed(const Ranks &ranks, const std::function<void()> &f)
{
  if (ranks.alone())
    return f();
  const std::exception_ptr own   = caught_from(f);
  const auto               least = ranks.least(own ? 0. : 1.);
  if (least.value == 0)
    throw_alike(ranks, own, least.rank);
}

void on_first(const Ranks &ranks, const std::function<void()> &f)
{
  if (ranks.alone())
    return f();
  throw_alike(ranks, ranks.first() ? caught_from(f) : nullptr, 0);
}

std::string told_by_first(const Ranks &ranks, const std::function<std::string()> &f)
{
  std::string text;
  on_first(ranks, [&] { text = f(); });
  return ranks.alone() ? text : broadcast_text(ranks, text, 0);
}

namespace
{
/// Messages of a rank in trouble and the answer; no other code uses these tags.
constexpr int trouble_tag = 32001, answer_tag = 32002;

MPI_Comm communicator_of(const Ranks &ranks)
{
  return *static_cast<const MPI_Comm *>(ranks.communicator());
}

/// Whether `done` became true in time.
template <class Done>
bool within(double seconds, Done &&done)
{
  for (const double began = MPI_Wtime(); MPI_Wtime() - began < seconds; usleep(1000))
    if (done())
      return true;
  return done();
}

[[noreturn]] void abandon(const Ranks &ranks, const std::string &message, int failed)
{
  std::fprintf(stderr, "%s (rank %d of %d)\n", message.c_str(), ranks.rank(), ranks.size());
  std::fflush(nullptr);
  MPI_Abort(communicator_of(ranks), failed);
  std::_Exit(failed);
}

/// What the others came here with, by rank; none where one did not come.
using Endings = std::vector<std::optional<Ending>>;

bool collect(const Ranks &ranks, Endings &all)
{
  for (int arrived = 1; arrived != 0;)
  {
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, trouble_tag, communicator_of(ranks), &arrived, &status);
    if (arrived == 0)
      break;
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    std::string text(static_cast<std::size_t>(size), ' ');
    MPI_Recv(text.data(), size, MPI_BYTE, status.MPI_SOURCE, trouble_tag, communicator_of(ranks), MPI_STATUS_IGNORE);
    all[static_cast<std::size_t>(status.MPI_SOURCE)] = Ending{text.at(0), text.substr(1)};
  }
  for (const auto &one : all)
    if (!one)
      return false;
  return true;
}

/// The common status and message, or one of all.
Ending common(const Endings &all, int failed)
{
  Ending out   = *all[0];
  bool   alike = true;
  for (const auto &one : all)
  {
    out.status = one->status == out.status ? out.status : failed;
    alike      = alike && one->message == out.message;
  }
  if (alike)
    return out;
  out.message.clear();
  for (std::size_t r = 0; r < all.size(); ++r)
    out.message += (r > 0 ? "\n" : "") + all[r]->message + " (rank " + std::to_string(r) + ")";
  return out;
}

Ending end_first(const Ranks &ranks, const Ending &own, int failed, double patience_s)
{
  Endings all(static_cast<std::size_t>(ranks.size()));
  all[0] = own;
  if (!within(patience_s, [&] { return collect(ranks, all); }))
    abandon(ranks, own.message, failed);
  const Ending out = common(all, failed);
  for (int r = 1; r < ranks.size(); ++r)
    MPI_Send(&out.status, 1, MPI_INT, r, answer_tag, communicator_of(ranks));
  return out;
}
} // namespace

Ending end_together(const Ranks &ranks, const Ending &own, int failed, double patience_s)
{
  if (ranks.alone())
    return own;
  if (ranks.first())
    return end_first(ranks, own, failed, patience_s);
  const std::string text = static_cast<char>(own.status) + own.message;
  int               answer = failed;
  std::array<MPI_Request, 2> requests;
  MPI_Isend(text.data(), static_cast<int>(text.size()), MPI_BYTE, 0, trouble_tag, communicator_of(ranks), &requests[0]);
  MPI_Irecv(&answer, 1, MPI_INT, 0, answer_tag, communicator_of(ranks), &requests[1]);
  // the first rank may have begun to wait later than this one
  const bool answered = within(2 * patience_s, [&] {
    int done = 0;
    MPI_Testall(2, requests.data(), &done, MPI_STATUSES_IGNORE);
    return done != 0;
  });
  if (!answered)
    abandon(ranks, own.message, failed);
  return {answer, {}};
}
} // namespace ogive
