// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/observers/body_observer.h"

namespace ogive::coupling
{
/// A patch test: how far the stress lies from the exact, uniform one of a body
/// that starts with velocity field "stretch" and goes on by its inertia. Root
/// mean square of the stress difference over the points that began farther than
/// the parameter (m) from every face of the box, over the exact stress. With
/// e = ln(1 + rate t) that is, along the stretch and across,
///   s_xx = 4/3 G e - p,  s_yy = s_zz = -2/3 G e - p,  p = K (exp(-e) - 1),
/// for as long as no wave from a face has come to those points.
/// Throws InputError unless the body is a linear elastic box with that field.
class PatchError : public BodyObserver
{
public:
  PatchError(const input::Observer &, const input::Scene &);

protected:
  double measure(const Sample &, double time) override;

private:
  bool inside(const Vec3 &x0) const;

  Vec3   lower_, upper_; ///< of the points that count
  int    dim_;
  double rate_, shear_, bulk_; ///< 1/s, Pa, Pa
};

/// Growth of the body along the direction over the parameter (the gauge length,
/// m) when its mean stress along that direction first falls below a tenth
/// of the greatest so far, as a testing machine would say. (Half would be reached
/// by the ringing of a fast start.) NaN while it holds.
class FractureStrain : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double              measure(const Sample &, double time) override;
  std::vector<double> memory() const override { return {BodyObserver::memory()[0], first_length_, greatest_}; }
  void                recall(const std::vector<double> &) override;

private:
  double first_length_ = std::numeric_limits<double>::quiet_NaN(), greatest_ = 0; ///< m, Pa
};
} // namespace ogive::coupling
