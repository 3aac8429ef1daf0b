// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/observers/body_observer.h"

namespace ogive::coupling
{
/// The standing wave that a uniaxial bar starts with, v = q cos(k xi) along x,
/// k = n pi/L, xi from its lower end at the start.
class StandingWave
{
public:
  /// InputError at `entry` for a body that starts otherwise.
  StandingWave(const input::Body &, const input::Scene &, const std::string &entry);

  double wavelength() const { return wavelength_; }   ///< m
  double sound_speed() const { return sound_speed_; } ///< longitudinal, at rest, m/s

  /// Energy in the wave, J, from the projections q of the velocity on cos(k xi)
  /// (weighed by mass) and s of the axial stress on sin(k xi) (by volume):
  ///   1/2 q- q+ sum m cos^2 + s^2/(2 rho c^2) sum V sin^2.
  /// The sample has v of half a step ago, q-; q+ = q- + dt k s/rho is that of
  /// half a step later. In the leapfrog this sum stays as it is, where q-^2
  /// would swing by w dt/2.
  double energy(const Sample &, double dt) const;

private:
  double lower_, number_, wavelength_, sound_speed_, density_;
};

/// Energy that is left in the wave, over the energy that was in it at the start.
class WaveEnergy : public Observer
{
public:
  WaveEnergy(const input::Observer &, const input::Scene &);
  void   every_step(const StepFrame &frame) override { step_ = frame.length; }
  void   row(const RowFrame &) override;
  double value() const override { return value_; }

protected:
  /// From the share of the energy that is left.
  virtual double      measure(double kept, double) const { return kept; }
  const StandingWave &wave() const { return wave_; }

  std::vector<double> memory() const override { return {step_, start_, value_}; }
  void                recall(const std::vector<double> &numbers) override;

private:
  int          body_;
  StandingWave wave_;
  double       step_ = 0, start_ = -1, value_ = 1;
};

/// Share of the amplitude that a wavelength of travel takes away:
/// 1 - kept^(wavelength/(2 c t)).
class WaveAmplitudeLoss : public WaveEnergy
{
public:
  using WaveEnergy::WaveEnergy;

protected:
  double measure(double kept, double time) const override;
};

/// Kinetic energy of the waves shorter than four spacings, over all kinetic
/// energy at the start: cosine transform of the velocities of a uniaxial body
/// in the order of its particles at the start.
class OscillationNoise : public BodyObserver
{
public:
  OscillationNoise(const input::Observer &, const input::Scene &);

protected:
  double              measure(const Sample &, double time) override;
  std::vector<double> memory() const override { return {value(), start_}; }
  void                recall(const std::vector<double> &numbers) override;

private:
  double              start_ = -1;
  std::vector<double> cosines_; ///< of each short wave, one number a particle
};
} // namespace ogive::coupling
