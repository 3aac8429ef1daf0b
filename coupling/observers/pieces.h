// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/observers/body_observer.h"

namespace ogive::coupling
{
/// Number of connected pieces of a body. Particles hang together when they are
/// closer than 1.75 spacings: more than the diagonal of a lattice, less than the
/// gap that a missing layer leaves. Elements hang together by their nodes.
class Fragments : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double measure(const Sample &, double time) override;
};

/// Least distance of two particles over their spacing, of all rows so far. With
/// elements, of two nodes of one cell over their distance at the start.
class SmallestDistance : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double measure(const Sample &, double time) override;
};

/// Greatest distance, m, between a point and the mirror image of its partner:
/// the point that began at its image in the plane through `point` across the
/// direction. Of all bodies. NaN if any point began without a partner.
class SymmetryError : public Observer
{
public:
  SymmetryError(const input::Observer &, const input::Scene &);
  void   row(const RowFrame &) override;
  double value() const override { return value_; }

protected:
  std::vector<double> memory() const override { return {value_}; }
  void                recall(const std::vector<double> &numbers) override { value_ = numbers.at(0); }

private:
  Vec3 mirrored(const Vec3 &x) const { return x - 2 * (x - point_).dot(normal_) * normal_; }

  std::size_t n_bodies_;
  Vec3        normal_, point_;
  double      value_ = std::numeric_limits<double>::quiet_NaN();
};
} // namespace ogive::coupling
