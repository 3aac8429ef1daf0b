// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/observers/body_observer.h"

namespace ogive::coupling
{
/// What stays of a deformation once the elastic part of it only rings: the mean
/// of a quantity over the second half of the time since it was greatest. While
/// it still grows that is its present value.
class Settled : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double              measure(const Sample &, double time) final;
  std::vector<double> memory() const override;
  void                recall(const std::vector<double> &) override;

  virtual double now(const Sample &) const = 0;

private:
  std::vector<double> times_, values_; ///< rows since the greatest value
};

/// Displacement along the direction of what was nearest to the point, m.
class TipDeflection : public Settled
{
public:
  using Settled::Settled;

protected:
  double now(const Sample &) const override;
};

/// The same over a length, the parameter.
class MidDeflection : public TipDeflection
{
public:
  using TipDeflection::TipDeflection;

protected:
  double now(const Sample &s) const override { return TipDeflection::now(s) / parameter(); }
};

/// The greatest displacement along the direction of what was nearest to the
/// point, m: elastic part included.
class GreatestDeflection : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double measure(const Sample &, double time) override;
};

/// Turn, rad, either way, of the material that began closer to the point than
/// the parameter, about the direction (in two dimensions out of the plane): the
/// rotation that fits its nodes best (mass weighted least squares).
class TipRotation : public Settled
{
public:
  TipRotation(const input::Observer &, const input::Scene &);

protected:
  double now(const Sample &) const override;

private:
  Vec3 axis_;
};

/// As TipRotation at the present time, with its sign and over whole turns.
class Twist : public BodyObserver
{
public:
  Twist(const input::Observer &, const input::Scene &);

protected:
  double measure(const Sample &, double time) override;

private:
  Vec3 axis_;
};
} // namespace ogive::coupling
