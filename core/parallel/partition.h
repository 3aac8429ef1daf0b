// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/parallel/ranks.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace ogive
{
/// Space shared among the ranks by recursive coordinate bisection of weighted
/// points (Zoltan): each rank has a box, the boxes fill space.
template <int dim>
class Partition
{
public:
  explicit Partition(const Ranks & = {});
  ~Partition();
  Partition(Partition &&) noexcept;
  Partition &operator=(Partition &&) noexcept;

  /// Cuts space anew so that the weights (cost, > 0) of the points of all ranks
  /// are even. Returns the new rank of each of this rank's points, which is at(x).
  /// Called by all ranks; the same points held alike give the same cuts.
  std::vector<int> cut(const std::array<std::span<const double>, dim> &x, std::span<const double> weight);

  /// Whose box a point lies in. After cut().
  int at(const std::array<double, dim> &x) const;
  /// All ranks whose boxes a box meets, ascending, this one too. After cut().
  void meets(const std::array<double, dim> &lower, const std::array<double, dim> &upper, std::vector<int> &ranks) const;
  /// The box of a rank, all x with lower < x <= upper: what cut() decided, to be
  /// kept or saved. After cut(), and not where this process is alone.
  void box(int rank, std::array<double, dim> &lower, std::array<double, dim> &upper) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

extern template class Partition<1>;
extern template class Partition<2>;
extern template class Partition<3>;
} // namespace ogive
