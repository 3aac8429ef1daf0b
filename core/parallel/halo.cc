// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/parallel/halo.h"

#include "core/base/error.h"

#include <mpi.h>

#include <algorithm>
#include <climits>
#include <utility>

namespace ogive
{
Halo::Halo(const Ranks &ranks, std::vector<std::vector<std::uint32_t>> give,
           std::vector<std::vector<std::uint32_t>> take)
  : ranks_(ranks)
{
  const auto n = static_cast<std::size_t>(ranks.size());
  require(give.size() == n && take.size() == n, "one list for each rank");
  std::vector<std::vector<std::int64_t>> sizes(n);
  for (std::size_t r = 0; r < n; ++r)
    sizes[r].push_back(static_cast<std::int64_t>(give[r].size()));
  const auto come = ranks.swap(sizes);
  for (std::size_t r = 0; r < n; ++r)
  {
    require(come[r].at(0) == static_cast<std::int64_t>(take[r].size()), "what ranks give and take must agree");
    require(static_cast<int>(r) != ranks.rank() || (give[r].empty() && take[r].empty()), "no rank gives to itself");
    if (give[r].empty() && take[r].empty())
      continue;
    given_ += give[r].size();
    taken_ += take[r].size();
    for (const std::uint32_t i : take[r])
      shared_.push_back(i);
    ranks_of_.push_back(static_cast<int>(r));
    sides_.push_back({std::move(give[r]), std::move(take[r])});
  }
  std::sort(shared_.begin(), shared_.end());
  shared_.erase(std::unique(shared_.begin(), shared_.end()), shared_.end());
}

template <class Pack, class Unpack>
void Halo::exchange(std::size_t width, Pack &&pack, Unpack &&unpack) const
{
  if (sides_.empty() || width == 0)
    return;
  Traffic     &traffic = Ranks::count();
  const double began   = MPI_Wtime();
  const auto   comm    = *static_cast<const MPI_Comm *>(ranks_.communicator());
  constexpr int tag    = 6277;
  out_.resize(given_ * width);
  in_.resize(taken_ * width);
  std::vector<MPI_Request> requests;
  requests.reserve(2 * sides_.size());
  const auto post = [&](auto &&call, double *at, std::size_t entries, int rank) {
    if (entries == 0)
      return;
    require(entries * width <= INT_MAX, "one message holds at most 2^31 - 1 numbers");
    call(at, static_cast<int>(entries * width), MPI_DOUBLE, rank, tag, comm, &requests.emplace_back());
  };
  double *in = in_.data();
  for (std::size_t k = 0; k < sides_.size(); in += sides_[k].take.size() * width, ++k)
    post(MPI_Irecv, in, sides_[k].take.size(), ranks_of_[k]);
  double *out = out_.data();
  for (std::size_t k = 0; k < sides_.size(); ++k)
  {
    double *to = out;
    for (const std::uint32_t i : sides_[k].give)
      to = pack(i, to);
    post(MPI_Isend, out, sides_[k].give.size(), ranks_of_[k]);
    traffic.messages += !sides_[k].give.empty();
    out = to;
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  traffic.bytes += out_.size() * sizeof(double);
  traffic.waited_s += MPI_Wtime() - began;
  unpack(static_cast<const double *>(in_.data()));
}

void Halo::copy(double *records, std::size_t stride, std::size_t first, std::size_t last) const
{
  const std::size_t width = last - first;
  exchange(
    width,
    [=](std::uint32_t i, double *to) { return std::copy_n(&records[i * stride + first], width, to); },
    [&](const double *from) {
      for (const Side &side : sides_)
        for (const std::uint32_t i : side.take)
          std::copy_n(std::exchange(from, from + width), width, &records[i * stride + first]);
    });
}

void Halo::copy(std::span<double *const> arrays) const
{
  exchange(
    arrays.size(),
    [=](std::uint32_t i, double *to) {
      for (double *const a : arrays)
        *to++ = a[i];
      return to;
    },
    [&](const double *from) {
      for (const Side &side : sides_)
        for (const std::uint32_t i : side.take)
          for (double *const a : arrays)
            a[i] = *from++;
    });
}

void Halo::sum(double *records, std::size_t stride, std::size_t first, std::size_t last) const
{
  add_in_order(last - first, [=](std::uint32_t i, std::size_t f) -> double & { return records[i * stride + first + f]; });
}

void Halo::sum(std::span<double *const> arrays) const
{
  add_in_order(arrays.size(), [=](std::uint32_t i, std::size_t f) -> double & { return arrays[f][i]; });
}

template <class At>
void Halo::add_in_order(std::size_t width, At &&at) const
{
  exchange(
    width,
    [&](std::uint32_t i, double *to) {
      for (std::size_t f = 0; f < width; ++f)
        *to++ = at(i, f);
      return to;
    },
    [&](const double *from) {
      // Own parts are set aside, so that each comes in at the place of its rank.
      own_.clear();
      for (const std::uint32_t i : shared_)
        for (std::size_t f = 0; f < width; ++f)
        {
          own_.push_back(at(i, f));
          at(i, f) = 0;
        }
      const auto add_own = [&] {
        const double *own = own_.data();
        for (const std::uint32_t i : shared_)
          for (std::size_t f = 0; f < width; ++f)
            at(i, f) += *own++;
      };
      bool added = false;
      for (std::size_t k = 0; k < sides_.size(); ++k)
      {
        if (!added && ranks_of_[k] > ranks_.rank())
        {
          add_own();
          added = true;
        }
        for (const std::uint32_t i : sides_[k].take)
          for (std::size_t f = 0; f < width; ++f)
            at(i, f) += *from++;
      }
      if (!added)
        add_own();
    });
}
} // namespace ogive
