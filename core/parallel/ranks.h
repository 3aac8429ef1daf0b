// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace ogive
{
/// What ranks told each other so far, as one of them counts it.
struct Traffic
{
  std::uint64_t messages = 0; ///< sent from rank to rank
  std::uint64_t bytes    = 0; ///< in them
  std::uint64_t together = 0; ///< operations of all ranks together: sums, gathers
  double        waited_s = 0; ///< wall time spent in all of them, waiting included
};

/// The processes that share a run. A value: copies are the same group. Built by
/// default it is this process alone, without MPI. All functions but rank() and
/// size() are called by all ranks alike, in the same order.
class Ranks
{
public:
  Ranks() = default;
  /// All that mpirun started; alone if nothing did. The first call starts MPI,
  /// which then ends with the program.
  static Ranks world();
  /// Whether mpirun started this process.
  static bool started_together();

  int  rank() const;
  int  size() const;
  bool alone() const { return size() == 1; }
  bool first() const { return rank() == 0; }

  double        sum(double) const;
  double        min(double) const;
  double        max(double) const;
  std::int64_t  sum(std::int64_t) const;
  std::int64_t  max(std::int64_t) const;
  bool          any(bool) const;
  bool          all(bool) const;
  /// Sums entry by entry, in place. The result has the same bits on all ranks, and
  /// in every run on the same number of ranks.
  void sum(std::span<double>) const;
  void sum(std::span<std::int64_t>) const;
  void max(std::span<double>) const;
  /// Smallest value and the rank that has it; the lowest of several.
  struct Least
  {
    double value = 0;
    int    rank  = 0;
  };
  Least least(double) const;
  /// Sum over the ranks before this one.
  std::int64_t before(std::int64_t) const;

  /// Values of all ranks, rank after rank, on each of them; `first`, if given, gets
  /// where each rank's begin, and the total last (size() + 1 entries).
  template <class T>
  std::vector<T> gather(std::span<const T> own, std::vector<std::size_t> *first = nullptr) const
  {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> all;
    gather_bytes(own.data(), own.size(), sizeof(T), [&all](std::size_t n) {
      all.resize(n);
      return static_cast<void *>(all.data());
    }, first);
    return all;
  }
  template <class T>
  std::vector<T> gather(const std::vector<T> &own, std::vector<std::size_t> *first = nullptr) const
  {
    return gather(std::span<const T>(own), first);
  }
  /// One value of each rank.
  template <class T>
  std::vector<T> gather_one(const T &own) const
  {
    return gather(std::span<const T>(&own, 1));
  }

  /// Makes these of `from` those of all; sizes must agree.
  template <class T>
  void broadcast(std::span<T> values, int from) const
  {
    static_assert(std::is_trivially_copyable_v<T>);
    broadcast_bytes(values.data(), values.size() * sizeof(T), from);
  }

  /// to[r] goes to rank r; returns what each rank sent here, by rank.
  template <class T>
  std::vector<std::vector<T>> swap(const std::vector<std::vector<T>> &to) const;

  const Traffic &traffic() const; ///< of this process since it began
  /// The MPI_Comm of the group, for those rooms of core that speak MPI; none if alone.

  const void *communicator() const;

private:
  friend class Halo;
  template <class F>
  void gather_bytes(const void *own, std::size_t n, std::size_t size, F &&room, std::vector<std::size_t> *first) const
  {
    std::vector<std::size_t> starts = starts_of(n);
    void *const              to     = room(starts.back());
    gather_to(own, size, starts, to);
    if (first)
      *first = std::move(starts);
  }
  std::vector<std::size_t> starts_of(std::size_t n) const;
  void gather_to(const void *own, std::size_t size, const std::vector<std::size_t> &starts, void *to) const;
  void broadcast_bytes(void *, std::size_t, int from) const;
  std::vector<std::vector<char>> swap_bytes(const std::vector<std::span<const char>> &) const;

  static Traffic &count();

  struct Group;
  std::shared_ptr<const Group> group_; ///< none: alone
};

template <class T>
std::vector<std::vector<T>> Ranks::swap(const std::vector<std::vector<T>> &to) const
{
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<std::span<const char>> bytes;
  for (const auto &t : to)
    bytes.emplace_back(reinterpret_cast<const char *>(t.data()), t.size() * sizeof(T));
  const auto                  got = swap_bytes(bytes);
  std::vector<std::vector<T>> from(got.size());
  for (std::size_t r = 0; r < got.size(); ++r)
  {
    from[r].resize(got[r].size() / sizeof(T));
    std::copy(got[r].begin(), got[r].end(), reinterpret_cast<char *>(from[r].data()));
  }
  return from;
}
} // namespace ogive
