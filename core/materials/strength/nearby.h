// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>

namespace ogive::materials
{
/// x^n and ln x at points close to each other, as an iteration asks for them:
/// exact at an anchor, from there by series. Within `reach` of the anchor
/// (relative) the first term left out is under 1e-15 of the value.
class NearbyPower
{
public:
  static constexpr int    terms = 9;
  static constexpr double reach = .025;

  /// The binomial coefficients of one exponent.
  struct Series
  {
    double exponent = 1;
    double c[terms] = {};

    explicit Series(double n = 1)
      : exponent(n)
    {
      c[0] = 1;
      for (int k = 1; k < terms; ++k)
        c[k] = c[k - 1] * (n - k + 1) / k;
    }
  };

  explicit NearbyPower(const Series &series)
    : series_(series)
  {}

  /// x^n for x > 0.
  double operator()(double x)
  {
    const double u = (x - anchor_) * inverse_;
    if (!(std::abs(u) < reach))
      {
        anchor_  = x;
        inverse_ = 1 / x;
        return value_ = std::exp(series_.exponent * std::log(x));
      }
    double sum = series_.c[terms - 1];
    for (int k = terms - 2; k >= 0; --k)
      sum = series_.c[k] + u * sum;
    return value_ * sum;
  }

private:
  const Series &series_;
  double        anchor_ = 0, inverse_ = HUGE_VAL, value_ = 0;
};

/// See NearbyPower.
class NearbyLog
{
public:
  /// ln x for x > 0.
  double operator()(double x)
  {
    const double u = (x - anchor_) * inverse_;
    if (!(std::abs(u) < NearbyPower::reach))
      {
        anchor_  = x;
        inverse_ = 1 / x;
        return value_ = std::log(x);
      }
    double sum = 0;
    for (int k = NearbyPower::terms - 1; k >= 1; --k)
      sum = u * (1. / k - sum);
    return value_ + sum;
  }

private:
  double anchor_ = 0, inverse_ = HUGE_VAL, value_ = 0;
};
} // namespace ogive::materials
