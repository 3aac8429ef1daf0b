// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/observers/observer.h"

#include <limits>

namespace ogive::coupling
{
/// A quantity of all bodies measured by their kinetic energy at the start.
class ShareOfStart : public Observer
{
public:
  ShareOfStart(const input::Observer &, const input::Scene &) {}
  void   row(const RowFrame &) override;
  double value() const override { return value_; }

protected:
  virtual double      energy(const RowFrame &) const = 0; ///< J
  std::vector<double> memory() const override { return {start_, value_}; }
  void                recall(const std::vector<double> &numbers) override;

private:
  double start_ = -1, value_ = std::numeric_limits<double>::quiet_NaN();
};

class KineticEnergyKept : public ShareOfStart
{
public:
  using ShareOfStart::ShareOfStart;

protected:
  double energy(const RowFrame &frame) const override { return frame.kinetic; }
};

class ViscosityHeatShare : public ShareOfStart
{
public:
  using ShareOfStart::ShareOfStart;

protected:
  double energy(const RowFrame &frame) const override { return frame.viscosity_heat; }
};

/// NaN before anything has yielded.
class ViscosityToPlasticWork : public Observer
{
public:
  ViscosityToPlasticWork(const input::Observer &, const input::Scene &) {}
  void   row(const RowFrame &frame) override;
  double value() const override { return value_; }

protected:
  std::vector<double> memory() const override { return {value_}; }
  void                recall(const std::vector<double> &numbers) override { value_ = numbers.at(0); }

private:
  double value_ = std::numeric_limits<double>::quiet_NaN();
};
} // namespace ogive::coupling
