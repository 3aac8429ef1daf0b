// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/lane_math.h"
#include "core/materials/lanes.h"

#include <cmath>
#include <iterator>

namespace ogive::materials
{
/// x^n and ln x at points close to each other, as an iteration asks for them:
/// exact at an anchor, from there by series. Within `reach` of the anchor
/// (relative) the first term left out is under 1e-15 of the value. Lanes of a
/// register have anchors of their own: none sees its neighbours.
template <class T>
class Nearby
{
public:
  static constexpr int    terms = 9;
  static constexpr double reach = .025;

protected:
  using Mask = decltype(T(0) < T(0));

  /// Distance from the anchor over the anchor, where x is asked for. Lanes out
  /// of reach get a new anchor and the value exact(x) there.
  template <class Exact>
  T distance(const T &x, const Mask &asked, Exact &&exact)
  {
    using std::abs;
    const T    u   = (x - anchor_) * inverse_;
    const auto far = asked && !(abs(u) < T(reach));
    if (!any(far))
      return u;
    anchor_  = select(far, x, anchor_);
    inverse_ = select(far, T(1) / x, inverse_);
    value_   = select(far, exact(x), value_);
    return select(far, T(0), u);
  }

  T anchor_{0}, inverse_{HUGE_VAL}, value_{0};
};

/// The binomial coefficients of one exponent.
struct PowerSeries
{
  double exponent = 1;
  double c[Nearby<double>::terms] = {};

  explicit PowerSeries(double n = 1)
    : exponent(n)
  {
    c[0] = 1;
    for (int k = 1; k < Nearby<double>::terms; ++k)
      c[k] = c[k - 1] * (n - k + 1) / k;
  }
};

template <class T>
class NearbyPower : Nearby<T>
{
public:
  explicit NearbyPower(const PowerSeries &series)
    : series_(series)
  {}

  /// x^n for x > 0, in the lanes that are asked for.
  T operator()(const T &x, const typename Nearby<T>::Mask &asked)
  {
    const T u   = this->distance(x, asked, [this](const T &at) { return lane_power(at, series_.exponent); });
    return this->value_ * sum_series(series_.c, u);
  }

private:
  const PowerSeries &series_;
};

template <class T>
class NearbyLog : Nearby<T>
{
public:
  /// ln x for x > 0, in the lanes that are asked for.
  T operator()(const T &x, const typename Nearby<T>::Mask &asked)
  {
    const T u = this->distance(x, asked, [](const T &at) { return lane_log(at); });
    static constexpr double c[] = {1., -1. / 2, 1. / 3, -1. / 4, 1. / 5, -1. / 6, 1. / 7, -1. / 8};
    static_assert(std::size(c) == Nearby<T>::terms - 1);
    return this->value_ + u * sum_series(c, u);
  }
};
} // namespace ogive::materials
