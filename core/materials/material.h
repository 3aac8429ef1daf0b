// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/parameters.h"
#include "core/materials/points.h"

#include <cstddef>
#include <memory>

namespace ogive::materials
{
enum class Status
{
  ok,
  not_finite,      ///< a NaN or infinity went in or came out
  density_not_positive,
  sound_speed_imaginary
};
const char *describe(Status);

/// One EOS, one strength, one damage law, composed when the material is built:
/// virtual once per block of points, templates inside. Holds no history.
class Material
{
public:
  virtual ~Material() = default;

  /// Fills points [begin, end) with the undeformed state at rest: density,
  /// zero stress and energy, reference temperature, sound speed.
  virtual void initialise(Points &, std::size_t begin, std::size_t end) const = 0;

  /// Carries points [begin, end) over one step: rotates the stress
  /// (Hughes-Winget), adds the elastic increment, returns to the yield surface,
  /// updates damage, temperature, pressure and sound speed, and sets
  /// density to the new one. inc.* point at the entry of point `begin`.
  /// `energy` is read at t_{n-1/2} and not changed; the EOS sees it advanced
  /// by half the stress power of the step.
  /// Returns the first status that is not ok, with its index in `bad`.
  virtual Status update(Points &, std::size_t begin, std::size_t end, const Increments &inc,
                        std::size_t &bad) const = 0;

  virtual const Parameters &parameters() const = 0;
  double density() const { return parameters().density; }
  /// Longitudinal sound speed at rest, m/s.
  virtual double sound_speed() const = 0;
  /// Isentropic bulk modulus and shear modulus at rest, Pa.
  virtual double bulk_modulus() const  = 0;
  virtual double shear_modulus() const = 0;
};

/// Builds the composition. Throws InputError naming the missing or wrong entry
/// (without file and line: the reader adds them).
std::unique_ptr<const Material> make_material(const Parameters &);
} // namespace ogive::materials
