// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/sample.h"
#include "core/input/scene.h"
#include "core/io/archive.h"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace ogive::coupling
{
/// What an observer sees at every step. Cheap: no copies of fields.
struct StepFrame
{
  double                  time = 0;     ///< end of the step, s
  std::span<const double> wall_force;   ///< of each rigid wall of the scene, N into the material
  double                  contact_force = 0; ///< sum of the normal forces of all body contacts, N
};

/// What an observer sees at every row of the history.
struct RowFrame
{
  double                                    time = 0;
  std::function<const Sample &(int body)>   sample;      ///< copied once a row, on demand
  double                                    kinetic = 0; ///< of all bodies, J
  double                                    elastic = 0; ///< J
  Vec3                                      angular_momentum = Vec3::Zero();
  double                                    plastic_work = 0; ///< J
};

/// A quantity of the summary. Holds only what it needs from the past, and that
/// goes into checkpoints.
class Observer
{
public:
  virtual ~Observer() = default;

  virtual void every_step(const StepFrame &) {}
  virtual void row(const RowFrame &) = 0;

  /// SI. NaN where nothing has been seen yet.
  virtual double value() const = 0;

  virtual void save(ArchiveWriter &, const std::string &prefix) const;
  virtual void load(const ArchiveReader &, const std::string &prefix);

protected:
  /// All numbers that must survive a restart.
  virtual std::vector<double> memory() const { return {}; }
  virtual void                recall(const std::vector<double> &) {}
};

/// Builds the observer of a quantity (core/input/quantities.h lists their
/// units and meanings; a test holds the two lists against each other).
/// Throws InputError for a quantity that nothing measures.
std::unique_ptr<Observer> make_observer(const input::Observer &, const input::Scene &);

/// Names of all quantities that make_observer knows.
std::vector<std::string> observable_quantities();
} // namespace ogive::coupling
