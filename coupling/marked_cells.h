// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace ogive::coupling
{
/// A box of space in cubic cells, some of which are marked: a quick answer to
/// whether anything is near a point, for as many points as a rank has.
template <int dim>
class MarkedCells
{
public:
  /// Cells at least `least` (m) wide; wider where there would be too many.
  MarkedCells(const Box<dim> &domain, double least) : domain_(domain), width_(least)
  {
    constexpr double most = 1 << 22;
    const Point<dim> extent = domain.upper - domain.lower;
    if (!(extent.array() >= 0).all() || !(least > 0))
      return;
    const auto count = [&] {
      double n = 1;
      for (int a = 0; a < dim; ++a)
        n *= std::floor(extent[a] / width_) + 1;
      return n;
    };
    while (count() > most)
      width_ *= 1.5;
    for (int a = 0; a < dim; ++a)
      n_[a] = static_cast<int>(extent[a] / width_) + 1;
    marked_.assign(static_cast<std::size_t>(count()), 0);
  }

  bool holds(const Point<dim> &p) const
  {
    return !marked_.empty() && (p.array() >= domain_.lower.array()).all() && (p.array() <= domain_.upper.array()).all();
  }
  /// Number of the cell of a point that the box holds.
  std::uint32_t cell(const Point<dim> &p) const
  {
    std::uint32_t c = 0;
    for (int a = dim - 1; a >= 0; --a)
      c = c * static_cast<std::uint32_t>(n_[a]) + static_cast<std::uint32_t>(place(a, p[a]));
    return c;
  }
  bool marked(const Point<dim> &p) const { return holds(p) && marked_[cell(p)]; }

  /// All cells that the box meets.
  void mark(const Box<dim> &box)
  {
    if (marked_.empty() || !box.meets(domain_))
      return;
    Eigen::Matrix<int, dim, 1> first, last;
    for (int a = 0; a < dim; ++a)
    {
      first[a] = place(a, box.lower[a]);
      last[a]  = place(a, box.upper[a]);
    }
    mark(first, last);
  }
  /// The cells of this number and all around them.
  void mark_around(std::uint32_t cell)
  {
    Eigen::Matrix<int, dim, 1> first, last;
    for (int a = 0; a < dim; ++a)
    {
      const int at = static_cast<int>(cell % static_cast<std::uint32_t>(n_[a]));
      cell /= static_cast<std::uint32_t>(n_[a]);
      first[a] = std::max(0, at - 1);
      last[a]  = std::min(n_[a] - 1, at + 1);
    }
    mark(first, last);
  }

private:
  int place(int a, double x) const
  {
    return static_cast<int>(std::clamp((x - domain_.lower[a]) / width_, 0., n_[a] - 1.));
  }
  void mark(const Eigen::Matrix<int, dim, 1> &first, const Eigen::Matrix<int, dim, 1> &last)
  {
    Eigen::Matrix<int, dim, 1> at = first;
    while (true)
    {
      std::size_t c = 0;
      for (int a = dim - 1; a >= 0; --a)
        c = c * static_cast<std::size_t>(n_[a]) + static_cast<std::size_t>(at[a]);
      marked_[c] = 1;
      int a      = 0;
      for (; a < dim && at[a] == last[a]; ++a)
        at[a] = first[a];
      if (a == dim)
        return;
      ++at[a];
    }
  }

  Box<dim>                   domain_;
  double                     width_ = 0;
  Eigen::Matrix<int, dim, 1> n_     = Eigen::Matrix<int, dim, 1>::Zero();
  std::vector<char>          marked_;
};
} // namespace ogive::coupling
