// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/observers/body_observer.h"

#include <vector>

namespace ogive::coupling
{
/// Momentum over mass along the direction: of one body, or of all bodies if
/// none is named.
class MeanVelocity : public Observer
{
public:
  MeanVelocity(const input::Observer &, const input::Scene &);
  void   row(const RowFrame &) override;
  double value() const override { return value_; }

protected:
  std::vector<double> memory() const override { return {value_}; }
  void                recall(const std::vector<double> &numbers) override { value_ = numbers.at(0); }

private:
  std::vector<int> bodies_;
  Vec3             direction_;
  double           value_ = std::numeric_limits<double>::quiet_NaN();
};

class Displacement : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double measure(const Sample &, double time) override;
};

class Perforation : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double measure(const Sample &, double time) override;
};

class GaugeVelocity : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double measure(const Sample &, double time) override;
};

/// Displacement along the direction of what was nearest to the point, m.
class GaugeDisplacement : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double measure(const Sample &, double time) override;
};

/// From the first to the last force above a hundredth of the greatest one. The
/// greatest is known only afterwards, so a new greatest keeps the first moment.
class ContactTime : public Observer
{
public:
  ContactTime(const input::Observer &, const input::Scene &) {}
  void   every_step(const StepFrame &) override;
  void   row(const RowFrame &) override {}
  double value() const override;

protected:
  std::vector<double> memory() const override { return {greatest_, first_, last_}; }
  void                recall(const std::vector<double> &numbers) override;

private:
  double greatest_ = 0, first_ = -1, last_ = -1;
};

class AngularMomentumDrift : public Observer
{
public:
  AngularMomentumDrift(const input::Observer &, const input::Scene &) {}
  void   row(const RowFrame &) override;
  double value() const override { return value_; }

protected:
  std::vector<double> memory() const override;
  void                recall(const std::vector<double> &numbers) override;

private:
  bool   started_ = false;
  Vec3   start_   = Vec3::Zero();
  double value_   = 0;
};

class EnergyKept : public Observer
{
public:
  EnergyKept(const input::Observer &, const input::Scene &) {}
  void   row(const RowFrame &) override;
  double value() const override { return value_; }

protected:
  std::vector<double> memory() const override { return {start_, value_}; }
  void                recall(const std::vector<double> &numbers) override;

private:
  double start_ = -1, value_ = 1;
};
} // namespace ogive::coupling
