// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/balance.h"
#include "core/io/archive.h"
#include "coupling/coupler.h"

#include <string>
#include <vector>

namespace ogive::coupling
{
/// One line of the books of a run. J, kg, N s, N m s (of the modelled part, as
/// Balance says).
///
///   total = kinetic + elastic + plastic_work + viscosity_heat
///         + bulk_viscosity_heat + hourglass_fem + hourglass_sph + contact
///         + friction + conversion_heat + absorbed + wall_loss + eroded_energy
///
/// counts what the bodies and springs hold and what left them on known ways.
/// `thermal` is a part of plastic_work; interface_work and contact_loss are
/// numerical errors: they show in the drift, and the total has no part of them.
struct LedgerRow
{
  double kinetic = 0, elastic = 0, plastic_work = 0, thermal = 0;
  double viscosity_heat = 0, bulk_viscosity_heat = 0;
  double hourglass_fem = 0, hourglass_sph = 0;
  double contact = 0, contact_loss = 0, friction = 0;
  double interface_work = 0, conversion_heat = 0;
  double external_work = 0, absorbed = 0, wall_loss = 0;
  double eroded_energy = 0; ///< kinetic and internal energy of dead elements, springs that pressed them
  double total = 0;
  double drift = 0; ///< filled by Ledger::enter

  /// Dead elements count: what left with them flies on freely.
  double mass             = 0;
  Vec3   momentum         = Vec3::Zero();
  Vec3   angular_momentum = Vec3::Zero(); ///< about the origin
  Vec3   external_impulse = Vec3::Zero(); ///< given by walls, boundaries and symmetry planes

  double eroded_mass = 0, eroded_elements = 0;
  double gradient_fallbacks = 0; ///< particles without corrected gradient in the step before

  /// Each party's energy less what external and coupling forces gave it: stays
  /// as it was at the start if that solver keeps its books.
  double mesh_books = 0, particle_books = 0;

  double internal() const
  {
    return elastic + plastic_work + viscosity_heat + bulk_viscosity_heat + hourglass_fem + hourglass_sph;
  }

  /// Column names with units, e.g. "kinetic [J]", and values in their order.
  static std::vector<std::string> columns();
  std::vector<double>             values() const;
};

/// Adds up both solvers and the coupling layer; a solver that is absent gives
/// an empty Balance.
LedgerRow ledger_row(const Balance &fem, const Balance &sph, const CouplingBalance &);

/// The drift of a run:
///   drift = [(total - external_work) - (total - external_work)_0]/reference,
/// reference = the largest kinetic energy, internal energy or external work so
/// far.
class Ledger
{
public:
  /// The first row entered is the state that drift is measured from.
  void   enter(LedgerRow &row);
  double drift() const { return last_.drift; }
  double worst_drift() const { return worst_; }
  double most_fallbacks() const { return most_fallbacks_; } ///< of any row
  double reference() const { return reference_; } ///< the energy that drift is measured against, J

  const LedgerRow &first() const { return first_; }
  const LedgerRow &last() const { return last_; }

  /// Empty while |drift| <= limit and every entry is a number; else a sentence
  /// that names the drift and the part of the books with the largest error.
  std::string fault(double limit) const;

  void save(ArchiveWriter &, const std::string &prefix) const;
  void load(const ArchiveReader &, const std::string &prefix);

private:
  bool      begun_ = false;
  LedgerRow first_, last_;
  double    reference_ = 0, worst_ = 0, most_fallbacks_ = 0;
};
} // namespace ogive::coupling
