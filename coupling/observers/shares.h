// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/observers/observer.h"

#include <limits>

namespace ogive::coupling
{
/// A part of the energy over the kinetic and elastic energy at the start.
class EnergyShare : public Observer
{
public:
  EnergyShare(const input::Observer &, const input::Scene &) {}
  void   row(const RowFrame &) final;
  double value() const override { return value_; }

protected:
  virtual double part(const RowFrame &) const = 0; ///< J

  std::vector<double> memory() const override { return {start_, value_}; }
  void                recall(const std::vector<double> &numbers) override;

private:
  double start_ = -1, value_ = std::numeric_limits<double>::quiet_NaN();
};

class KineticShare : public EnergyShare
{
public:
  using EnergyShare::EnergyShare;

protected:
  double part(const RowFrame &f) const override { return f.kinetic; }
};

class ElasticShare : public EnergyShare
{
public:
  using EnergyShare::EnergyShare;

protected:
  double part(const RowFrame &f) const override { return f.elastic; }
};

class PlasticShare : public EnergyShare
{
public:
  using EnergyShare::EnergyShare;

protected:
  double part(const RowFrame &f) const override { return f.plastic_work; }
};
} // namespace ogive::coupling
