// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/observers/body_observer.h"

namespace ogive::coupling
{
/// The inner wall of a shell (radii from its centre) or ring (from its axis; in
/// plane strain from its base). The innermost material, up to one spacing from
/// the wall, stands for it: as if incompressible, a point that began at r0 and
/// is at r has R^n = r^n - r0^n + R0^n of the wall with it, n = 3 for a shell, 2
/// for a ring. For the nodes of a mesh on the wall R = r.
class InnerWall : public BodyObserver
{
public:
  /// InputError for a body without an inner radius.
  InnerWall(const input::Observer &, const input::Scene &);

protected:
  double mean_radius(const Sample &) const;
  /// Greatest over least of the mean radii in the 26 directions of a cubic
  /// lattice (8 in the plane), those that hold material.
  double roundness(const Sample &) const;

private:
  struct Point
  {
    Vec3   from;        ///< radius vector at the start, m
    double mass, power; ///< kg, R^n
  };
  std::vector<Point> innermost(const Sample &) const;
  Vec3               radius_vector(const std::array<std::vector<double>, 3> &, std::size_t) const;
  double             root(double power) const;

  Vec3   base_, axis_;
  bool   spherical_;
  double inner_, depth_;
};

/// Least mean radius of the inner wall so far, m: where it first stops.
class StoppingRadius : public InnerWall
{
public:
  using InnerWall::InnerWall;

protected:
  double measure(const Sample &, double time) override;
};

/// When the mean radius of the inner wall was least, s.
class StoppingTime : public InnerWall
{
public:
  using InnerWall::InnerWall;

protected:
  double              measure(const Sample &, double time) override;
  std::vector<double> memory() const override { return {value(), least_}; }
  void                recall(const std::vector<double> &numbers) override;

private:
  double least_ = std::numeric_limits<double>::infinity();
};

/// Roundness of the inner wall when its mean radius was least.
class Roundness : public InnerWall
{
public:
  using InnerWall::InnerWall;

protected:
  double              measure(const Sample &, double time) override;
  std::vector<double> memory() const override { return {value(), least_}; }
  void                recall(const std::vector<double> &numbers) override;

private:
  double least_ = std::numeric_limits<double>::infinity();
};
} // namespace ogive::coupling
