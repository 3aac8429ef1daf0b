// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/laws.h"
#include "core/materials/material.h"

namespace ogive::materials
{
/// A material put together from one law of each kind.
///
/// Points are worked through in chunks that stay in the first-level cache, in
/// stages: elastic trial, plastic return, pressure, damage, finish. Each stage
/// visits its law once a chunk and is a template on it inside, so that laws add
/// up in compiled code (3 + 5 + 4) instead of multiplying (3 x 5 x 4). All run on
/// whole registers but damage; the return passes over registers in which no
/// point can yield.
class ComposedMaterial final : public Material
{
public:
  explicit ComposedMaterial(const Parameters &);

  void   initialise(Points &, std::size_t begin, std::size_t end) const override;
  Status update(Points &, std::size_t begin, std::size_t end, const Increments &,
                std::size_t &bad) const override;

  const Parameters &parameters() const override { return parameters_; }
  double            sound_speed() const override;
  double            bulk_modulus() const override;
  double            shear_modulus() const override { return shear_; }

private:
  struct Chunk;

  template <bool softened>
  void trial(Chunk &, const Points &, const Increments &) const;
  template <class Strength>
  void flow(Chunk &, Points &, const Strength &) const;
  template <class Eos>
  void pressure(Chunk &, const Points &, const Eos &) const;
  template <class Damage>
  void damage(Chunk &, Points &, const Damage &) const;
  bool finish(Chunk &, Points &) const;

  Status first_fault(const Chunk &, const Points &, std::size_t &bad) const;

  Parameters  parameters_;
  AnyEos      eos_;
  AnyStrength strength_;
  AnyDamage   damage_;
  bool        solid_    = true;  ///< carries shear
  bool        can_fail_ = false;
  double      shear_    = 0;     ///< Pa
  double      rest_     = 0;     ///< bulk sound speed squared at rest
  double      tension_  = 0;     ///< cutoff, Pa; infinite without
  double      heating_  = 0;     ///< K per J/kg of plastic work
};
} // namespace ogive::materials
