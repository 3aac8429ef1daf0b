// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/parallel/ranks.h"

#include "core/base/error.h"

#include <mpi.h>

#include <algorithm>
#include <climits>
#include <cstdlib>
#include <numeric>

namespace ogive
{
namespace
{
Traffic traffic_so_far;

/// Counts the wall time from here to the end of the block.
struct Waiting
{
  double began = MPI_Wtime();
  Waiting() = default;
  Waiting(const Waiting &) = delete;
  Waiting &operator=(const Waiting &) = delete;
  ~Waiting() { traffic_so_far.waited_s += MPI_Wtime() - began; }
};

int count_of(std::size_t n)
{
  require(n <= INT_MAX, "one message holds at most 2^31 - 1 items");
  return static_cast<int>(n);
}

void end_mpi()
{
  int ended = 0;
  MPI_Finalized(&ended);
  if (!ended)
    MPI_Finalize();
}

void start_mpi()
{
  int started = 0;
  MPI_Initialized(&started);
  if (started)
    return;
  MPI_Init(nullptr, nullptr);
  std::atexit(end_mpi);
}

/// Up to this many numbers are gathered and added in the order of ranks; more go
/// down a tree to one rank and come back from there.
constexpr std::size_t few = 512;

template <class T>
void sum_alike(std::span<T> values, MPI_Comm comm, MPI_Datatype type, int size)
{
  const Waiting waiting;
  ++traffic_so_far.together;
  const int n = count_of(values.size());
  if (values.size() <= few)
  {
    std::vector<T> all(values.size() * size);
    MPI_Allgather(values.data(), n, type, all.data(), n, type, comm);
    std::copy_n(all.begin(), values.size(), values.begin());
    for (std::size_t k = values.size(); k < all.size(); ++k)
      values[k % values.size()] += all[k];
    return;
  }
  std::vector<T> total(values.size());
  MPI_Reduce(values.data(), total.data(), n, type, MPI_SUM, 0, comm);
  std::copy(total.begin(), total.end(), values.begin());
  MPI_Bcast(values.data(), n, type, 0, comm);
}
} // namespace

struct Ranks::Group
{
  MPI_Comm comm = MPI_COMM_WORLD;
  int      rank = 0, size = 1;
};

bool Ranks::started_together()
{
  for (const char *name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"})
    if (std::getenv(name))
      return true;
  return false;
}

Ranks Ranks::world()
{
  Ranks ranks;
  if (!started_together())
    return ranks;
  static const std::shared_ptr<const Group> group = [] {
    start_mpi();
    auto g = std::make_shared<Group>();
    MPI_Comm_rank(g->comm, &g->rank);
    MPI_Comm_size(g->comm, &g->size);
    return g;
  }();
  if (group->size > 1)
    ranks.group_ = group;
  return ranks;
}

int Ranks::rank() const
{
  return group_ ? group_->rank : 0;
}

int Ranks::size() const
{
  return group_ ? group_->size : 1;
}

double Ranks::sum(double x) const
{
  sum(std::span<double>(&x, 1));
  return x;
}

std::int64_t Ranks::sum(std::int64_t x) const
{
  sum(std::span<std::int64_t>(&x, 1));
  return x;
}

void Ranks::sum(std::span<double> values) const
{
  if (group_ && !values.empty())
    sum_alike(values, group_->comm, MPI_DOUBLE, group_->size);
}

void Ranks::sum(std::span<std::int64_t> values) const
{
  if (group_ && !values.empty())
    sum_alike(values, group_->comm, MPI_INT64_T, group_->size);
}

void Ranks::max(std::span<double> values) const
{
  if (!group_ || values.empty())
    return;
  const Waiting waiting;
  ++traffic_so_far.together;
  MPI_Allreduce(MPI_IN_PLACE, values.data(), count_of(values.size()), MPI_DOUBLE, MPI_MAX, group_->comm);
}

double Ranks::max(double x) const
{
  max(std::span<double>(&x, 1));
  return x;
}

double Ranks::min(double x) const
{
  return -max(-x);
}

std::int64_t Ranks::max(std::int64_t x) const
{
  if (group_)
  {
    const Waiting waiting;
    ++traffic_so_far.together;
    MPI_Allreduce(MPI_IN_PLACE, &x, 1, MPI_INT64_T, MPI_MAX, group_->comm);
  }
  return x;
}

bool Ranks::any(bool b) const
{
  return max(static_cast<std::int64_t>(b)) != 0;
}

bool Ranks::all(bool b) const
{
  return !any(!b);
}

Ranks::Least Ranks::least(double x) const
{
  Least own{x, rank()};
  if (group_)
  {
    const Waiting waiting;
    ++traffic_so_far.together;
    MPI_Allreduce(MPI_IN_PLACE, &own, 1, MPI_DOUBLE_INT, MPI_MINLOC, group_->comm);
  }
  return own;
}

std::int64_t Ranks::before(std::int64_t x) const
{
  const std::vector<std::int64_t> all = gather_one(x);
  return std::accumulate(all.begin(), all.begin() + rank(), std::int64_t(0));
}

std::vector<std::size_t> Ranks::starts_of(std::size_t n) const
{
  std::vector<std::uint64_t> counts{n};
  if (group_)
  {
    const Waiting       waiting;
    const std::uint64_t own = n;
    counts.resize(size());
    MPI_Allgather(&own, 1, MPI_UINT64_T, counts.data(), 1, MPI_UINT64_T, group_->comm);
  }
  std::vector<std::size_t> starts{0};
  for (const auto count : counts)
    starts.push_back(starts.back() + count);
  return starts;
}

void Ranks::gather_to(const void *own, std::size_t size, const std::vector<std::size_t> &starts, void *to) const
{
  const std::size_t n = starts[rank() + 1] - starts[rank()];
  if (!group_)
  {
    std::copy_n(static_cast<const char *>(own), n * size, static_cast<char *>(to));
    return;
  }
  const Waiting    waiting;
  std::vector<int> counts, at;
  for (std::size_t r = 0; r + 1 < starts.size(); ++r)
  {
    counts.push_back(count_of(starts[r + 1] - starts[r]));
    at.push_back(count_of(starts[r]));
  }
  MPI_Datatype item;
  MPI_Type_contiguous(count_of(size), MPI_BYTE, &item);
  MPI_Type_commit(&item);
  MPI_Allgatherv(own, counts[rank()], item, to, counts.data(), at.data(), item, group_->comm);
  MPI_Type_free(&item);
  ++traffic_so_far.together;
  traffic_so_far.bytes += n * size * (this->size() - 1);
}

void Ranks::broadcast_bytes(void *values, std::size_t n, int from) const
{
  if (!group_)
    return;
  const Waiting waiting;
  ++traffic_so_far.together;
  MPI_Bcast(values, count_of(n), MPI_BYTE, from, group_->comm);
}

std::vector<std::vector<char>> Ranks::swap_bytes(const std::vector<std::span<const char>> &to) const
{
  require(to.size() == static_cast<std::size_t>(size()), "one list for each rank");
  std::vector<std::vector<char>> from(to.size());
  if (!group_)
  {
    from[0].assign(to[0].begin(), to[0].end());
    return from;
  }
  const Waiting     waiting;
  std::vector<int>  sent, sent_at{0}, got(to.size()), got_at{0};
  std::vector<char> out;
  for (std::size_t r = 0; r < to.size(); ++r)
  {
    sent.push_back(count_of(to[r].size()));
    out.insert(out.end(), to[r].begin(), to[r].end());
    sent_at.push_back(count_of(out.size()));
    if (static_cast<int>(r) != rank() && !to[r].empty())
      ++traffic_so_far.messages, traffic_so_far.bytes += to[r].size();
  }
  MPI_Alltoall(sent.data(), 1, MPI_INT, got.data(), 1, MPI_INT, group_->comm);
  for (const int n : got)
    got_at.push_back(count_of(static_cast<std::size_t>(got_at.back()) + n));
  std::vector<char> in(got_at.back());
  MPI_Alltoallv(out.data(), sent.data(), sent_at.data(), MPI_BYTE, in.data(), got.data(), got_at.data(), MPI_BYTE,
                group_->comm);
  for (std::size_t r = 0; r < to.size(); ++r)
    from[r].assign(in.begin() + got_at[r], in.begin() + got_at[r + 1]);
  return from;
}

const Traffic &Ranks::traffic() const
{
  return traffic_so_far;
}

Traffic &Ranks::count()
{
  return traffic_so_far;
}

const void *Ranks::communicator() const
{
  return group_ ? &group_->comm : nullptr;
}
} // namespace ogive
