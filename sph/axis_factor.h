// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace ogive::sph
{
/// phi(r/h), the factor by which the ring 2 pi r of a particle near the axis is
/// counted in its stress forces: 0 on the axis, 1 far from it. With the ring
/// 2 pi r itself a uniform pressure would push the particles near the axis, where
/// the kernel smooths the kink of |r|. phi solves
///   int r' phi(r'/h) d/dr W1(r - r') dr' = phi(r/h),  W1 the kernel summed over z,
/// over the line of all r', |r'| for those beyond the axis: the in-plane force of
/// a uniform pressure then balances its hoop force everywhere. Hoop forces carry
/// it too, so that none is infinite on the axis.
class AxisFactor
{
public:
  /// Of the 2-D kernel of that name; InputError if there is none.
  explicit AxisFactor(const std::string &kernel);

  /// `zeta` = r/h >= 0.
  double operator()(double zeta) const
  {
    const double at = zeta * per_unit_;
    const auto   k  = static_cast<std::size_t>(std::min(at, 1e9));
    if (k + 1 >= phi_.size())
      return 1;
    return phi_[k] + (at - static_cast<double>(k)) * (phi_[k + 1] - phi_[k]);
  }

private:
  double              per_unit_ = 0; ///< nodes per unit of zeta
  std::vector<double> phi_;
};
} // namespace ogive::sph
