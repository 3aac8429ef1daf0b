// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/observers/body_observer.h"

namespace ogive::coupling
{
/// Follows the displacement, along the direction, of what was nearest to the
/// point, through its passages of zero. It begins at zero with the run, so the
/// first period ends at the second passage after that.
class Oscillation : public BodyObserver
{
public:
  using BodyObserver::BodyObserver;

protected:
  double              measure(const Sample &, double time) final;
  std::vector<double> memory() const override;
  void                recall(const std::vector<double> &) override;

  /// Of the whole periods seen so far, NaN before the first.
  virtual double result() const = 0;

  int    periods() const { return passages_ / 2; }
  double last_end() const { return last_end_; } ///< of the last whole period, s
  double first_peak() const { return first_peak_; }
  double last_peak() const { return last_peak_; }

private:
  void enter(double time, double displacement);

  int    passages_ = 0;
  double side_ = 0, time_ = 0, displacement_ = 0; ///< of the row before
  double peak_       = 0;                         ///< of the period that runs, m
  double first_peak_ = 0, last_peak_ = 0, last_end_ = 0;
};

/// Mean over the whole periods seen. Passages are interpolated between rows.
class Period : public Oscillation
{
public:
  using Oscillation::Oscillation;

protected:
  double result() const override { return last_end() / periods(); }
};

/// 1 - (greatest displacement of the last whole period)/(that of the first).
class AmplitudeLoss : public Oscillation
{
public:
  using Oscillation::Oscillation;

protected:
  double result() const override { return 1 - last_peak() / first_peak(); }
};
} // namespace ogive::coupling
